// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include "commands.h"
#include "export/export.h"
#include "io/mesh_io.h"
#include "options.h"
#include "output.h"
#include "session.h"
#include "stored_results.h"

namespace toposcope::cli {
namespace {

struct ExportOptions : ResultOptions {
  std::vector<std::string> formats = {"gltf", "vtp", "slicer"};
};

/// \return the file's name and what is in it
std::pair<std::string, std::string> exported(const LabelledMesh& labelled, const std::string& format) {
  if (format == "gltf") return {"features.glb", to_gltf(labelled, program_name())};
  if (format == "vtp") return {"features.vtp", to_vtp(labelled)};
  return {"features.mrk.json", to_slicer_markups(labelled)};
}

int export_results(const ExportOptions& options) {
  return for_each_result(options.results, options.mesh, [&](const fs::path& given) {
    const fs::path folder = result_folder(given);
    const LabelledMesh labelled = read_labelled_mesh(folder / "result.json", options.mesh);
    for (const std::string& format : options.formats) {
      const auto [name, content] = exported(labelled, format);
      write_file(folder / name, content);
      if (!options.quiet) say("{}\n", (folder / name).string());
    }
  });
}

}  // namespace

void add_export(CLI::App& app, int& code) {
  CLI::App& command = *app.add_subcommand("export", "results as files for Blender, ParaView, 3D Slicer and others");
  const auto options = std::make_shared<ExportOptions>();
  command
      .add_option("--format", options->formats, "gltf (features.glb), vtp (features.vtp), slicer (features.mrk.json)")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(CLI::IsMember({"gltf", "vtp", "slicer"}))
      ->capture_default_str();
  add_results(command, *options);
  command.callback([options, &code] { code = export_results(*options); });
}

}  // namespace toposcope::cli
