// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string_view>

#include "toposcope/context.h"
#include "toposcope/mesh_view.h"

namespace toposcope {

/// Takes the working sets as they are found; copies what it is given.
class WorkingSetSink {
 public:
  virtual ~WorkingSetSink() = default;
  /// \param type      one of the types that the plugin's descriptor provides
  /// \param vertices  a connected set of vertices, any order, no repeats, not empty
  /// \param saliency  how clearly the set stands out of its surroundings, 0 to 1 (1 where the classifier
  ///                  does not grade)
  virtual void add(std::string_view type, std::span<const Index> vertices, double saliency) = 0;
};

/// Finds the candidate sets of mesh points (dissertation 3.4.1, 4.3). Sets may overlap: two features never
/// share a vertex, so the labelling chooses among them.
class WorkingSetClassifier {
 public:
  virtual ~WorkingSetClassifier() = default;
  virtual void classify(const MeshView& mesh, Context& context, WorkingSetSink& sink) const = 0;
};

}  // namespace toposcope
