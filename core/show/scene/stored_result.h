// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <vector>

#include "result/read_result.h"
#include "scene/scene.h"

namespace toposcope {

/// A result and the whole mesh that it speaks of.
struct LabelledMesh {
  StoredResult result;
  Mesh mesh;
  std::vector<std::uint8_t> labels;  ///< one per triangle: 0 none, 1 + i feature i
  std::vector<FoundFeature> found;   ///< drawn

  /// Of a feature that the result names.
  std::size_t number_of(const std::string& feature) const;
};

/// \param file  result.json
/// \param mesh  where the mesh is now; empty: where the result says
/// \throw UsageError, MeshError  the mesh is not there, or is another one
LabelledMesh read_labelled_mesh(const std::filesystem::path& file, const std::filesystem::path& mesh = {});

/// \throw UsageError  the scene is of another run than the result
void require_of_result(const Scene& scene, const std::filesystem::path& scene_file, const StoredResult& result,
                       const std::filesystem::path& result_file);

/// What a result and its mesh alone show: without candidates and working sets, which only a run knows.
Scene scene_of(const LabelledMesh& labelled, const Truth* truth);

}  // namespace toposcope
