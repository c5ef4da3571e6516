// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <limits>
#include <span>
#include <vector>

#include "toposcope/geometry/large_array.h"
#include "toposcope/mesh_view.h"

namespace toposcope {

struct Neighbour {
  Vec3 offset;  ///< from p
  Index vertex;
};

/// Vertices that a walk from p reaches without leaving the ball.
class Neighbourhood {
 public:
  struct Limits {
    double reach;             ///< radius of the ball, in mean edges around the vertex
    double last_step;         ///< of the radius: from farther out the walk goes no further
    std::size_t most_points;  ///< where a mesh is much finer here than on average, the nearest by steps
  };
  Neighbourhood(const MeshView& mesh, const Limits& limits)
      : mesh_(mesh),
        limits_(limits),
        reached_from_(large_array<Index>(mesh.vertex_count(), std::numeric_limits<Index>::max())) {}

  /// p itself not among them.
  std::span<const Neighbour> around(Index p) {
    const Vec3 here = mesh_.positions[p];
    const auto ring = mesh_.one_ring(p);
    reached_from_[p] = p;
    make_room(0, ring.size());
    std::size_t count = 0;
    double edges = 0;
    for (Index q : ring) {
      reached_[count] = {mesh_.positions[q] - here, q};
      reached_from_[q] = p;
      edges += reached_[count++].offset.norm();
    }
    if (count == 0) return {};
    radius_ = limits_.reach * std::max(mesh_.mean_edge, edges / static_cast<double>(count));
    const double squared = radius_ * radius_, squared_turn = limits_.last_step * limits_.last_step * squared;
    for (std::size_t i = 0; i < count && count < limits_.most_points; ++i) {
      if (reached_[i].offset.squaredNorm() > squared_turn) continue;
      const auto next = mesh_.one_ring(reached_[i].vertex);
      if (next.size() > limits_.most_points)
        continue;  // the hub of a wheel: to go through it from every spoke is without end
      make_room(count, next.size());
      for (Index q : next) {
        if (reached_from_[q] == p) continue;
        reached_from_[q] = p;
        const Vec3 offset = mesh_.positions[q] - here;
        reached_[count] = {offset, q};
        count += offset.squaredNorm() <= squared;
      }
    }
    return {reached_.data(), count};
  }

  /// Of the last ball, in the mesh's unit.
  double radius() const { return radius_; }

 private:
  void make_room(std::size_t count, std::size_t more) {
    if (reached_.size() < count + more) reached_.resize(count + more);
  }

  const MeshView& mesh_;
  Limits limits_;
  double radius_ = 0;
  std::vector<Neighbour> reached_;
  std::vector<Index> reached_from_;
};

}  // namespace toposcope
