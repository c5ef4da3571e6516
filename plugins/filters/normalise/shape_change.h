// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <span>
#include <vector>

#include "toposcope/geometry/half_edges.h"

namespace toposcope::normalise {

/// A triangle as it is or as an operation would make it.
struct Facet {
  std::array<Vec3, 3> corner;
  std::array<Index, 3> vertex;
  std::array<bool, 3> curve;  ///< whether the side from this corner lies on a crease or the boundary
  Index face;                 ///< its place in the mesh
};

/// The accumulated shape change of every face. Johnson and Hebert add up bounds of the changes that operations make;
/// here every face carries the samples of the input that it stands for, and the change is their distance from it, so
/// that it neither grows with the number of operations nor is a bound only. Samples of creases and boundaries are
/// measured from the edges that stand for them.
class ShapeChange {
 public:
  /// A sample of the input that lies on this face.
  void add(const Vec3& point, bool on_curve, Index face);
  void reserve_faces(Index count);

  double squared(Index face) const { return squared_[face]; }

  /// Takes the samples of these faces in hand.
  void lift(std::span<const Index> faces);
  /// The greatest squared distance from a sample in hand to the facets; infinite as soon as it exceeds `limit`.
  double measure(std::span<const Facet> facets, double limit);
  /// Gives the samples in hand to the facets, as last measured. \pre measure() was finite
  void settle(std::span<const Index> old_faces, std::span<const Facet> facets);

 private:
  struct Sample {
    Vec3 point;
    Index next;  // of the same face
    bool on_curve;
  };
  struct Held {
    Index sample;
    Index facet;
    double squared;
  };
  std::vector<Sample> samples_;
  std::vector<Index> first_;     // sample of each face
  std::vector<double> squared_;  // of each face
  std::vector<Held> held_;
  std::vector<Vec3> normals_;
};

}  // namespace toposcope::normalise
