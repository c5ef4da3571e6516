// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "compare/comparison.h"
#include "evaluation/evaluation.h"
#include "scene/scene.h"

namespace toposcope {

/// A mesh as the index shows it.
struct MeshCard {
  std::string thumbnail;  ///< a PNG file; empty: none
  std::string report;     ///< from the index's folder; empty: none
};

/// How one labeler labels one mesh, to be looked at beside the others.
struct LabelerView {
  std::string name;
  Scene scene;
};

// The document "toposcope.index/1" (schemas/index.schema.json), on one line: many meshes or labelers on one page.

/// \param cards  per evaluation and mesh
std::string evaluation_index(const std::vector<Evaluation>& evaluations,
                             const std::vector<std::vector<MeshCard>>& cards, const std::string& program);

/// \param cards  per mesh \param views  of one mesh or several; small
std::string comparison_index(const std::vector<Comparison>& comparisons, const std::vector<MeshCard>& cards,
                             const std::vector<LabelerView>& views, const std::string& program);

}  // namespace toposcope
