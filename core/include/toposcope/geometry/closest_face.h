// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <span>
#include <vector>

#include "toposcope/context.h"
#include "toposcope/geometry/half_edges.h"

namespace toposcope {

/// The point of triangle abc that is closest to x, by its barycentric coordinates; degenerate triangles are segments
/// or points.
struct TrianglePoint {
  Vec3 point = Vec3::Zero();                  ///< on the triangle
  std::array<double, 3> weights = {1, 0, 0};  ///< of a, b, c; 0 exactly on the side or corner opposite
};
TrianglePoint closest_on_triangle(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& x);

/// Nearest face of a set of triangles: a tree of axis-aligned boxes. Immutable; safe in any thread. The spans that it
/// is made from must outlive it.
class ClosestFace {
 public:
  /// Builds the tree. \pre indices of the triangles are of the positions
  ClosestFace(std::span<const Vec3> positions, std::span<const Triangle> triangles);

  /// What is nearest to a point.
  struct Hit {
    Index face = no_index;        ///< of the triangles, from 0
    Vec3 point = Vec3::Zero();    ///< the nearest point of that face
    double squared_distance = 0;  ///< square of the mesh unit
  };
  /// Of faces equally near the one of least index. \pre at least one triangle
  Hit operator()(const Vec3& x) const;

 private:
  struct Node {
    Vec3 low, high;
    Index first, count;  // leaf: faces order_[first, first + count); inner (count 0): children first and first + 1
  };
  void build(Index node, Index first, Index count, std::vector<Vec3>& centers);

  std::span<const Vec3> positions_;
  std::span<const Triangle> triangles_;
  std::vector<Index> order_;
  std::vector<Node> nodes_;
};

/// For each triangle of a mesh made from `input`, the face of the input nearest to its centre.
std::vector<Index> nearest_faces(const MeshView& input, std::span<const Vec3> positions,
                                 std::span<const Triangle> triangles, Context& context);

}  // namespace toposcope
