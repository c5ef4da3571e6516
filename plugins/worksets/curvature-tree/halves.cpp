// SPDX-License-Identifier: BSD-3-Clause
#include "halves.h"

#include <algorithm>
#include <limits>

#include "toposcope/geometry/point_sets.h"

namespace component_tree {
namespace {

using toposcope::MeshView;
using toposcope::Vec3;

// Of variances along and across: a rectangle twice as long as wide has 2.9.
constexpr double long_ring = 3;

class RingCutter {
 public:
  RingCutter(const MeshView& mesh, Index min_vertices)
      : mesh_(mesh), min_vertices_(min_vertices), mark_(mesh.vertex_count(), 0) {}

  void cut(std::span<const Index> set, double saliency, Components& halves) {
    for (const Index v : set) mark_[v] = 1;
    if (encloses_something(set)) {
      points_.clear();
      for (const Index v : set) points_.push_back(mesh_.positions[v]);
      const toposcope::PrincipalAxes axes = toposcope::principal_axes(points_);
      if (axes.variance[0] > long_ring * axes.variance[1]) cut_across(set, axes.axes[0], saliency, halves);
    }
    for (const Index v : set) mark_[v] = 0;
  }

 private:
  /// Euler's characteristic of the vertices, edges and triangles within the set: 1 for a disk, less with holes.
  bool encloses_something(std::span<const Index> set) const {
    std::ptrdiff_t corners = 0, ends = 0;
    for (const Index v : set) {
      for (const Index q : mesh_.one_ring(v)) ends += mark_[q] != 0 ? 1 : 0;
      for (const Index f : mesh_.faces_of(v)) {
        const auto& t = mesh_.triangles[f];
        corners += mark_[t[0]] != 0 && mark_[t[1]] != 0 && mark_[t[2]] != 0 ? 1 : 0;
      }
    }
    return std::ssize(set) - ends / 2 + corners / 3 < 1;
  }

  void cut_across(std::span<const Index> set, const Vec3& along, double saliency, Components& halves) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const Index v : set) {
      low = std::min(low, mesh_.positions[v].dot(along));
      high = std::max(high, mesh_.positions[v].dot(along));
    }
    const double middle = (low + high) / 2;
    for (const bool upper : {false, true}) {
      half_.clear();
      for (const Index v : set)
        if ((mesh_.positions[v].dot(along) > middle) == upper) half_.push_back(v);
      if (half_.size() < min_vertices_ || !connected()) continue;
      halves.vertices.insert(halves.vertices.end(), half_.begin(), half_.end());
      halves.offsets.push_back(halves.vertices.size());
      halves.saliency.push_back(saliency);
    }
  }

  /// Whether all of `half_` is reached from its first vertex.
  bool connected() {
    for (const Index v : half_) mark_[v] = 2;
    reached_.assign(1, half_.front());
    mark_[half_.front()] = 1;
    for (std::size_t i = 0; i < reached_.size(); ++i)
      for (const Index q : mesh_.one_ring(reached_[i]))
        if (mark_[q] == 2) {
          mark_[q] = 1;
          reached_.push_back(q);
        }
    for (const Index v : half_) mark_[v] = 1;
    return reached_.size() == half_.size();
  }

  const MeshView& mesh_;
  std::size_t min_vertices_;
  std::vector<char> mark_;  // 1: in the set at hand; 2: in the half at hand, not reached
  std::vector<Vec3> points_;
  std::vector<Index> half_, reached_;
};

}  // namespace

Components halves_of_rings(const MeshView& mesh, const Components& components, Index min_vertices) {
  RingCutter cutter(mesh, min_vertices);
  Components halves;
  for (std::size_t i = 0; i < components.size(); ++i) cutter.cut(components[i], components.saliency[i], halves);
  return halves;
}

}  // namespace component_tree
