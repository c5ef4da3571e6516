// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include "commands.h"
#include "export/export.h"
#include "io/mesh_io.h"
#include "session.h"
#include "stored_results.h"

namespace toposcope::cli {
namespace {

/// \return the file's name and what is in it
std::pair<std::string, std::string> exported(const LabelledMesh& labelled, const std::string& format) {
  if (format == "gltf") return {"features.glb", to_gltf(labelled, program_name())};
  if (format == "vtp") return {"features.vtp", to_vtp(labelled)};
  return {"features.mrk.json", to_slicer_markups(labelled)};
}

}  // namespace

int export_results(const ExportOptions& options) {
  return for_each_result(options.results, options.mesh, [&](const fs::path& folder) {
    const LabelledMesh labelled = read_labelled_mesh(folder / "result.json", options.mesh);
    for (const std::string& format : options.formats) {
      const auto [name, content] = exported(labelled, format);
      write_file(folder / name, content);
      if (!options.quiet) fmt::print("{}\n", (folder / name).string());
    }
  });
}

}  // namespace toposcope::cli
