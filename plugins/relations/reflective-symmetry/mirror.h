// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Mirror planes between two point sets: nearest neighbours, residual and refinement. Mesh units throughout.

#include <limits>
#include <span>
#include <vector>

#include "toposcope/types.h"

namespace toposcope::mirror {

/// The plane normal.(x - point) = 0, normal of unit length.
struct Plane {
  Vec3 normal = Vec3::UnitX();
  Vec3 point = Vec3::Zero();
};

Vec3 mean(std::span<const Vec3> points);

/// Points in the order of their coordinate along an axis: the nearest one is found by walking outwards from the
/// query's own coordinate, which for edge-like sets ends after a few steps. Faster here than a tree.
class SortedPoints {
 public:
  /// Equal coordinates are told apart by position, so that the order of the points does not matter.
  SortedPoints(std::span<const Vec3> points, const Vec3& axis);

  std::size_t size() const { return entries_.size(); }
  const Vec3& operator[](std::size_t i) const { return entries_[i].point; }

  /// At most `limit` of the points, at even ranks; `phase` 0.5 takes the middle of each part, 0 its beginning.
  /// Mirrored sets, sorted along mirrored axes, give mirrored samples.
  SortedPoints thinned(std::size_t limit, double phase) const;

  /// \return the point nearest to `x`, its squared distance in `squared`
  const Vec3& nearest(const Vec3& x, double& squared) const;

 private:
  struct Entry {
    double key;
    Vec3 point;
  };
  explicit SortedPoints(const Vec3& axis) : axis_(axis) {}
  Vec3 axis_;
  std::vector<Entry> entries_;
};

/// Mean squared distance from the queries to the nearest of the targets.
double mean_squared(const SortedPoints& queries, const SortedPoints& targets);

/// A plane and the mean squared distance that it leaves, both ways with equal weight.
struct Refined {
  Plane plane;
  double mean_squared = std::numeric_limits<double>::infinity();
};

/// What is mirrored of a feature, and among what the images' nearest neighbours are sought.
struct Side {
  const SortedPoints& queries;
  const SortedPoints& targets;
};

/// Gauss-Newton steps on the plane, the pairs found anew before each (iterated closest points); stops as soon as a step
/// no longer pays. Returns the best plane met.
Refined refine(Plane plane, const Side& first, const Side& second, int steps);

}  // namespace toposcope::mirror
