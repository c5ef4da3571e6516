// SPDX-License-Identifier: BSD-3-Clause
// One feature lies inside another: within its outline as seen along its normal, or within its box.

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "toposcope/geometry/lines.h"
#include "toposcope/geometry/point_sets.h"
#include "toposcope/plugin.h"

namespace {

using namespace toposcope;

constexpr std::size_t most_points = 48;  // of an outline; of a circle's radius that leaves out 0.2 %

/// Evenly chosen points of the outline; the centroid where there is none.
std::vector<Vec3> outline_of(const FittedShape& shape) {
  std::vector<Vec3> points;
  const std::size_t stride = (shape.outline.size() + most_points - 1) / most_points;
  for (std::size_t i = 0; i < shape.outline.size(); i += stride) points.push_back(shape.outline[i]);
  if (points.empty()) points.push_back(shape.centroid);
  return points;
}

/// A plane-like shape's outline as it is seen along the normal.
class Shadow {
 public:
  explicit Shadow(const FittedShape& shape) : center_(shape.centroid), normal_(shape.direction) {
    const std::vector<Vec3> points = outline_of(shape);
    for (const Index i : convex_outline(points, normal_)) corners_.push_back(onto(points[i]));
    for (std::size_t i = 0; i < corners_.size(); ++i)
      area_ += normal_.dot((corners_[i] - center_).cross(next(i) - center_)) / 2;
  }
  double area() const { return area_; }
  /// How far a point lies outside.
  double beyond(const Vec3& point) const {
    const Vec3 seen = onto(point);
    bool inside = true;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < corners_.size(); ++i) {
      inside = inside && normal_.dot((next(i) - corners_[i]).cross(seen - corners_[i])) >= 0;
      least = std::min(least, (closest_on_segment(corners_[i], next(i), seen).point - seen).norm());
    }
    return inside ? 0 : least;
  }

 private:
  Vec3 onto(const Vec3& point) const { return point - (point - center_).dot(normal_) * normal_; }
  const Vec3& next(std::size_t i) const { return corners_[(i + 1) % corners_.size()]; }
  Vec3 center_, normal_;
  std::vector<Vec3> corners_;
  double area_ = 0;
};

double beyond(const Box& box, const Vec3& point) {
  double squared = 0;
  for (std::size_t k = 0; k < 3; ++k)
    squared += std::pow(std::max(0.0, std::abs((point - box.center).dot(box.axes[k])) - box.sides[k] / 2), 2);
  return std::sqrt(squared);
}

class Inside final : public RelationTester {
 public:
  explicit Inside(const Options& options) : tolerance_rel_(options.real("tolerance_rel")) {}

  RelationResult test(const RelationInput& input, const Options& /*arguments*/, Context& /*context*/) const override {
    const FittedShape& inner = *input.features[0].shape;
    const FittedShape& outer = *input.features[1].shape;
    RelationResult result;
    result.sd = std::hypot(inner.centroid_sd, outer.centroid_sd);
    double size = 0;
    if (outer.orientation == Orientation::plane_like) {
      const Shadow shadow(outer);
      size = std::sqrt(std::max(0.0, shadow.area()) / pi);
      for (const Vec3& point : outline_of(inner)) result.residual = std::max(result.residual, shadow.beyond(point));
      const double height = (inner.centroid - outer.centroid).dot(outer.direction);
      result.sd = std::hypot(result.sd, height * std::min(outer.direction_sd, pi / 2));
      result.tolerance = tolerance_rel_ * size;
      result.slack = size;
      // An unrelated feature lies anywhere in a disk as wide as the object is long.
      result.clutter_density = std::min(1.0, std::pow(2 * size / input.object_box.a(), 2)) / size;
    } else {
      const Box& box = input.features[1].box;
      size = box.a() / 2;
      for (const Vec3& point : outline_of(inner)) result.residual = std::max(result.residual, beyond(box, point));
      result.tolerance = tolerance_rel_ * size;
      result.slack = box.c() / 2 + result.tolerance;
      double part = 1;  // of the object's box
      for (std::size_t k = 0; k < 3; ++k)
        part *=
            std::min(1.0, (box.sides[k] + 2 * result.tolerance) / (input.object_box.sides[k] + 2 * result.tolerance));
      result.clutter_density = part / result.slack;
    }
    if (size > 0) return result;
    RelationResult none;
    none.applicable = false;
    none.why = "the second feature has no extent that the first could lie in";
    return none;
  }

 private:
  double tolerance_rel_;  // of the second feature's size
};

constexpr OptionSpec options[] = {
    {"tolerance_rel", OptionType::real, "sizes", "0.1", "0.0001", "10",
     "how far the first feature may stick out, as part of the second's size"},
};

}  // namespace

TOPOSCOPE_PLUGIN(
    RelationTester, Inside,
    {.id = "inside",
     .version = "1.0.0",
     .summary = "The first feature lies inside the second: within its outline along its normal, or its box",
     .unit = "length",
     .min_arity = 2,
     .max_arity = 2,
     .ordered = true,
     .options = options})
