// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string_view>

#include "toposcope/context.h"
#include "toposcope/mesh_view.h"

namespace toposcope {

/// Takes the working sets as they are found; copies what it is given. Not thread-safe: one call at a time, and in an
/// order that does not depend on threads, since sets are numbered as they come.
class WorkingSetSink {
 public:
  virtual ~WorkingSetSink() = default;
  /// \param type      one of the types that the plugin's descriptor provides
  /// \param vertices  of the classified mesh: a connected set, any order, no repeats, not empty
  /// \param saliency  how clearly the set stands out of its surroundings, 0 to 1 (1 where the classifier
  ///                  does not grade)
  /// \throw std::exception  an unknown type, no vertex, a saliency out of range: let it pass. Repeats, vertices out of
  ///        range and sets that are not connected are refused once `classify` has returned
  virtual void add(std::string_view type, std::span<const Index> vertices, double saliency) = 0;
};

/// Finds the candidate sets of mesh points (dissertation 3.4.1, 4.3). Sets may overlap: two features never
/// share a vertex, so the labelling chooses among them.
class WorkingSetClassifier {
 public:
  virtual ~WorkingSetClassifier() = default;
  /// Cancelled, it returns early with the sets found so far.
  /// \throw std::exception  a mesh that it cannot work on; the run ends with its words
  virtual void classify(const MeshView& mesh, Context& context, WorkingSetSink& sink) const = 0;
};

}  // namespace toposcope
