// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// What the tests of the shape fitters share: point sets with known answers, and fits of them.

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "support/plugins.h"
#include "toposcope/geometry/point_sets.h"
#include "toposcope/geometry/shape_parameters.h"
#include "toposcope/shapes.h"

namespace toposcope::test {

/// Seeded normal and uniform numbers, the same on every platform.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  double uniform() { return (static_cast<double>(engine_() >> 11) + 0.5) * 0x1p-53; }
  double normal() { return std::sqrt(-2 * std::log(uniform())) * std::cos(2 * pi * uniform()); }
  Vec3 normal3(double sd) {
    const double x = normal(), y = normal(), z = normal();
    return sd * Vec3(x, y, z);
  }
  Eigen::Matrix3d rotation() {
    const Vec3 a = normal3(1);
    return Eigen::Quaterniond(normal(), a.x(), a.y(), a.z()).normalized().toRotationMatrix();
  }
  std::mt19937_64& engine() { return engine_; }

 private:
  std::mt19937_64 engine_;
};

struct PointSets {
  std::vector<Vec3> points;
  double mean_edge = 1;
  std::vector<Index> offsets;                          ///< empty: one set
  std::vector<double> integrated_mean_curvature = {};  ///< empty: not known
};

inline std::vector<Index> offsets_of(const PointSets& sets) {
  if (!sets.offsets.empty()) return sets.offsets;
  return {0, static_cast<Index>(sets.points.size())};
}

inline std::vector<Box> set_boxes(const PointSets& sets) {
  const std::vector<Index> offsets = offsets_of(sets);
  std::vector<Box> boxes;
  for (std::size_t k = 0; k + 1 < offsets.size(); ++k) {
    const auto set = std::span(sets.points).subspan(offsets[k], offsets[k + 1] - offsets[k]);
    boxes.push_back(set.empty() ? Box{} : oriented_box(set));
  }
  return boxes;
}

inline Interval bounds(const ShapeFitter& fitter, std::string_view measure, const PointSets& sets,
                       const Options& arguments = {}) {
  return fitter.bounds(measure, set_boxes(sets), arguments);
}

inline FittedShape fit(const ShapeFitter& fitter, const PointSets& sets, const Options& arguments = {}) {
  const std::vector<Index> offsets = offsets_of(sets);
  const std::vector<Box> boxes = set_boxes(sets);
  const Box box = sets.points.empty() ? Box{} : oriented_box(sets.points);
  // Each point stands for a square of a mean edge.
  const std::vector<double> areas(sets.points.size(), sets.mean_edge * sets.mean_edge);
  return fitter.fit({sets.points, areas, offsets, boxes, box, box, sets.mean_edge, sets.integrated_mean_curvature},
                    arguments, context());
}

inline PointSets transformed(PointSets sets, const Eigen::Matrix3d& rotation, double scale, const Vec3& shift) {
  for (Vec3& point : sets.points) point = rotation * (scale * point) + shift;
  sets.mean_edge *= scale;
  return sets;
}

inline PointSets shuffled(PointSets sets, std::uint64_t seed) {
  Random random(seed);
  for (std::size_t i = sets.points.size(); i > 1; --i)
    std::swap(sets.points[i - 1], sets.points[random.engine()() % i]);
  return sets;
}

inline const Measure& measure(const FittedShape& shape, const std::string& name) {
  for (const Measure& m : shape.measures)
    if (m.name == name) return m;
  throw std::out_of_range("no measure " + name);
}

/// Mean square of errors divided by their standard deviations: about 1 where the deviations are right.
class Calibration {
 public:
  void add(double error, double sd) { sum_ += error * error / (sd * sd), ++count_; }
  double variance() const { return sum_ / count_; }

 private:
  double sum_ = 0;
  int count_ = 0;
};

}  // namespace toposcope::test
