// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "toposcope/filters.h"

namespace toposcope {

/// Collapses edges, the shorter ones first, until at most `faces` are left: a quick first step before a mesh is
/// normalised, several times faster than that is. The cost of a collapse is the edge's length and ten times the root
/// mean square distance of the point from the planes of the faces that it stands for (Garland and Heckbert 1997).
/// Vertices keep their places, the border stays, no face turns over, and the topology is kept.
class Thin final : public MeshFilter {
 public:
  explicit Thin(Index faces) : faces_(faces) {}
  /// \throw std::invalid_argument  not an oriented manifold with border
  void apply(const MeshView& mesh, Context& context, MeshSink& sink) const override;

 private:
  Index faces_;
};

}  // namespace toposcope
