// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <chrono>
#include <set>

#include "base/errors.h"
#include "commands.h"
#include "io/mesh_io.h"
#include "model/read_model.h"
#include "resources.h"
#include "result/result.h"
#include "session.h"

namespace toposcope::cli {
namespace {

/// Two meshes of one stem would write over each other.
void refuse_same_stem(const std::vector<fs::path>& meshes) {
  std::set<std::string> stems;
  for (const fs::path& mesh : meshes)
    if (!stems.insert(mesh.stem().string()).second)
      throw UsageError("two meshes are named '" + mesh.stem().string() +
                       "': their results would have the same folder below --out; run them apart");
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error || !fs::is_directory(folder))
    throw UsageError(folder.string() + ": cannot make this folder; name another with --out");
}

}  // namespace

int run(const RunOptions& options) {
  if (!options.out.empty()) {
    refuse_same_stem(options.meshes);
    make_folder(options.out);
  }
  Session session(options);
  const Model model = read_model(find_resource("models", options.model), &session.host().catalog());
  const Stations stations = session.stations(model);

  return for_each_mesh(options.meshes, session, [&](const fs::path& path) {
    const auto start = std::chrono::steady_clock::now();
    const Mesh mesh = read_mesh(path);
    const double read_ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    const Analysis analysis = analyze(mesh, model, stations, {}, session.context());
    Result result = explain(analysis, model, path.string(), stations, session.context());
    result.timings.insert(result.timings.begin(), {"read", read_ms});
    if (!options.out.empty()) {
      const fs::path folder = options.out / path.stem();
      make_folder(folder);
      write_labels(folder / "labels.ply", mesh, result);
      write_file(folder / "result.json", to_json(result));
    }
    session.status("");
    if (options.json)
      fmt::print("{}", to_json_line(result));
    else if (!options.quiet)
      fmt::print("{}\n", to_text(result));
    if (!options.out.empty() && !options.quiet && !options.json)
      fmt::print("  coloured mesh: {}\n  result:        {}\n\n", (options.out / path.stem() / "labels.ply").string(),
                 (options.out / path.stem() / "result.json").string());
    std::fflush(stdout);
  });
}

}  // namespace toposcope::cli
