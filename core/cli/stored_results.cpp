// SPDX-License-Identifier: BSD-3-Clause
#include "stored_results.h"

#include "base/errors.h"
#include "base/text_file.h"
#include "failure.h"
#include "output.h"
#include "session.h"

namespace toposcope::cli {

fs::path result_folder(const fs::path& given) {
  std::error_code ignored;
  const fs::path folder = fs::is_directory(given, ignored) ? given : given.parent_path();
  if (!fs::exists(given, ignored) || !fs::is_regular_file(folder / "result.json", ignored))
    throw UsageError(given.string() + ": no result.json there; give a folder that toposcope run --out wrote, as in " +
                     "results/cup");
  return folder;
}

Scene stored_scene(const fs::path& folder, const fs::path& mesh) {
  const fs::path file = folder / "scene.json", result_file = folder / "result.json";
  std::error_code ignored;
  if (fs::exists(fs::symlink_status(file, ignored))) {
    Scene scene = read_scene(read_text_file(file, "scene"), file.string());
    require_of_result(scene, file, read_result(result_file), result_file);
    if (!mesh.empty()) read_labelled_mesh(result_file, mesh);  // the scene has it, but one that is named must be it
    return scene;
  }
  const LabelledMesh labelled = read_labelled_mesh(result_file, mesh);
  const fs::path truth_file = truth_beside(mesh.empty() ? labelled.result.mesh : mesh);
  std::optional<Truth> truth;
  if (!truth_file.empty()) truth = read_truth(truth_file);
  return scene_of(labelled, truth ? &*truth : nullptr);
}

bool is_mesh_file(const fs::path& given) {
  std::error_code ignored;
  return fs::is_regular_file(given, ignored) && given.extension() != ".json" && given.extension() != ".html" &&
         given.filename() != "labels.ply";
}

Scene mesh_scene(const fs::path& file) {
  const Mesh mesh = read_repaired_mesh(file).mesh;
  const fs::path truth_file = truth_beside(file);
  std::optional<Truth> truth;
  if (!truth_file.empty()) truth = read_truth(truth_file);
  Scene scene =
      make_scene(mesh, std::vector<std::uint8_t>(mesh.view().face_count(), 0), "", {}, {}, truth ? &*truth : nullptr);
  scene.title = file.filename().string();
  return scene;
}

int for_each_result(const std::vector<fs::path>& results, const fs::path& mesh,
                    const std::function<void(const fs::path& given)>& body) {
  if (!mesh.empty() && results.size() > 1)
    throw UsageError("--mesh names the mesh of one result, and " + std::to_string(results.size()) +
                     " are given; take them one by one");
  int code = 0;
  std::vector<std::string> failed;
  for (const fs::path& given : results) try {
      body(given);
    } catch (...) {
      const Failure failure = present_failure();
      complain(failure.message);
      failed.push_back(given.string());
      if (code == 0) code = failure.exit_code;
    }
  if (!failed.empty() && results.size() > 1) complain(not_done(results.size(), "results", failed));
  return code;
}

}  // namespace toposcope::cli
