// SPDX-License-Identifier: BSD-3-Clause
#include "shape_change.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

#include "toposcope/geometry/closest_face.h"
#include "toposcope/geometry/lines.h"

namespace toposcope::normalise {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

double to_curves(const Facet& facet, const Vec3& x) {
  double least = infinite;
  for (std::size_t k = 0; k < 3; ++k)
    if (facet.curve[k])
      least =
          std::min(least, (closest_on_segment(facet.corner[k], facet.corner[(k + 1) % 3], x).point - x).squaredNorm());
  return least;
}

}  // namespace

void ShapeChange::reserve_faces(Index count) {
  if (count > first_.size()) {
    first_.resize(count, no_index);
    squared_.resize(count, 0);
  }
}

void ShapeChange::add(const Vec3& point, bool on_curve, Index face) {
  samples_.push_back({point, first_[face], on_curve});
  first_[face] = static_cast<Index>(samples_.size() - 1);
}

void ShapeChange::lift(std::span<const Index> faces) {
  held_.clear();
  for (Index f : faces)
    for (Index s = first_[f]; s != no_index; s = samples_[s].next) held_.push_back({s, 0, infinite});
}

double ShapeChange::measure(std::span<const Facet> facets, double limit) {
  normals_.clear();
  for (const Facet& t : facets)
    normals_.push_back((t.corner[1] - t.corner[0]).cross(t.corner[2] - t.corner[0]).stableNormalized());
  double greatest = 0;
  for (Held& held : held_) {
    const Sample& sample = samples_[held.sample];
    held.squared = infinite;
    for (Index i = 0; i < facets.size(); ++i) {
      double d;
      if (sample.on_curve) {
        d = to_curves(facets[i], sample.point);
      } else {
        const auto& [a, b, c] = facets[i].corner;
        const double height = normals_[i].dot(sample.point - a);
        if (height * height >= held.squared) continue;  // its plane is already farther
        d = (closest_on_triangle(a, b, c, sample.point).point - sample.point).squaredNorm();
      }
      if (d < held.squared) {
        held.squared = d;
        held.facet = i;
      }
    }
    greatest = std::max(greatest, held.squared);
    if (greatest > limit) return infinite;
  }
  return greatest;
}

void ShapeChange::settle(std::span<const Index> old_faces, std::span<const Facet> facets) {
  for (Index f : old_faces) {
    first_[f] = no_index;
    squared_[f] = 0;
  }
  for (const Held& held : held_) {
    const Index f = facets[held.facet].face;
    samples_[held.sample].next = first_[f];
    first_[f] = held.sample;
    squared_[f] = std::max(squared_[f], held.squared);
  }
}

}  // namespace toposcope::normalise
