// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Features made by hand, as relations see them, and motions of the whole scene.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <string>
#include <vector>

#include "support/meshes.h"
#include "support/plugins.h"
#include "toposcope/geometry/lines.h"
#include "toposcope/geometry/point_sets.h"
#include "toposcope/relations.h"

namespace toposcope::test {

struct Feature {
  FittedShape shape;
  std::vector<Vec3> points;
};

inline Feature circle_feature(const Vec3& center, const Vec3& normal, double radius) {
  Feature feature;
  feature.shape.orientation = Orientation::plane_like;
  feature.shape.direction = normal.normalized();
  feature.shape.centroid = center;
  feature.shape.parameters = {{"center", 3, {}}, {"normal", 3, {}}, {"radius", 1, {radius}}};
  feature.shape.measures = {{"radius", radius, 0}};
  return feature;
}

inline Feature segment_feature(const Vec3& from, const Vec3& to) {
  Feature feature;
  feature.shape.orientation = Orientation::line_like;
  feature.shape.direction = (to - from).normalized();
  feature.shape.centroid = (from + to) / 2;
  feature.shape.parameters = {{"endpoints", 3, {}}, {"closed", 1, {0}}};
  return feature;
}

inline Feature points_feature(std::vector<Vec3> points) {
  Feature feature = segment_feature(Vec3::Zero(), Vec3::UnitX());
  feature.shape.orientation = Orientation::plane_like;
  feature.points = std::move(points);
  return feature;
}

/// x -> rotation * (scale * x) + translation
struct Motion {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  double scale = 1;
  Vec3 translation = Vec3::Zero();
  Vec3 operator()(const Vec3& x) const { return rotation * (scale * x) + translation; }
};

inline Motion some_motion(std::uint64_t seed) {
  return {random_rotation(seed), std::pow(10.0, static_cast<double>(seed % 7) - 3), Vec3(3, -5, 7)};
}

inline Feature moved(Feature feature, const Motion& motion) {
  FittedShape& shape = feature.shape;
  shape.direction = motion.rotation * shape.direction;
  shape.centroid = motion(shape.centroid);
  shape.centroid_sd *= motion.scale;
  for (Measure& measure : shape.measures) measure.value *= motion.scale;
  for (auto* list : {&feature.points, &shape.outline})
    for (Vec3& point : *list) point = motion(point);
  return feature;
}

/// Tests the relation in a scene whose object box is 4 x 3 x 2 and whose mean edge is 0.1, moved as a whole.
inline RelationResult relate(const RelationTester& relation, const Feature& first, const Feature& second,
                             const Motion& motion = {}, const Options& arguments = {}) {
  const Feature a = moved(first, motion), b = moved(second, motion);
  const auto operand = [](const Feature& f) {
    return RelationOperand{&f.shape, f.points, f.points.empty() ? Box{} : oriented_box(f.points)};
  };
  const RelationOperand operands[] = {operand(a), operand(b)};
  Box box;
  box.sides = {4 * motion.scale, 3 * motion.scale, 2 * motion.scale};
  return relation.test({operands, box, 0.1 * motion.scale}, arguments, context());
}

/// The same of any number of features.
inline RelationResult relate_all(const std::string& id, const std::vector<Feature>& features,
                                 const Settings& settings = {}, const Motion& motion = {}) {
  const Arguments arguments(PluginKind::relations, id, settings);
  std::vector<Feature> there;
  for (const Feature& feature : features) there.push_back(moved(feature, motion));
  std::vector<RelationOperand> operands;
  for (const Feature& feature : there) operands.push_back({&feature.shape, feature.points, {}});
  Box box;
  box.sides = {4 * motion.scale, 3 * motion.scale, 2 * motion.scale};
  return relation(id)->test({operands, box, 0.1 * motion.scale}, arguments.options(), context());
}

/// A rotated, scaled, translated scene gets the same verdict. \pre the settings hold no length
inline void expect_pose_does_not_matter(const std::string& id, const std::vector<Feature>& features,
                                        const Settings& settings = {}) {
  const RelationResult here = relate_all(id, features, settings);
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const Motion motion = some_motion(seed);
    const RelationResult there = relate_all(id, features, settings, motion);
    EXPECT_NEAR(there.residual / motion.scale, here.residual, 1e-9) << "seed " << seed;
    EXPECT_NEAR(there.tolerance / motion.scale, here.tolerance, 1e-9);
    EXPECT_NEAR(there.slack / motion.scale, here.slack, 1e-9);
    EXPECT_NEAR(there.clutter_density * std::pow(motion.scale, here.dof) / here.clutter_density, 1, 1e-9);
  }
}

/// The same verdict for exchanged features and for a rotated, scaled, translated scene. `dimension` of the residual.
inline void expect_invariant(const RelationTester& relation, const Feature& first, const Feature& second, int dimension,
                             double tolerance = 1e-9) {
  const RelationResult here = relate(relation, first, second);
  const RelationResult exchanged = relate(relation, second, first);
  ASSERT_TRUE(here.applicable) << here.why;
  EXPECT_NEAR(exchanged.residual, here.residual, tolerance);
  EXPECT_NEAR(exchanged.sd, here.sd, tolerance);
  EXPECT_NEAR(exchanged.clutter_density, here.clutter_density, tolerance);
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const Motion motion = some_motion(seed);
    const double unit = std::pow(motion.scale, dimension);
    const RelationResult there = relate(relation, first, second, motion);
    EXPECT_NEAR(there.residual / unit, here.residual, tolerance) << "seed " << seed;
    EXPECT_NEAR(there.tolerance / unit, here.tolerance, tolerance);
    EXPECT_NEAR(there.sd / unit, here.sd, tolerance);
    EXPECT_NEAR(there.clutter_density * std::pow(unit, here.dof), here.clutter_density, tolerance);
  }
}

/// Uniform over the unit sphere; a function of `index`, equidistributed.
inline Vec3 sphere_direction(std::size_t index, std::size_t count) {
  const double z = 1 - (2 * static_cast<double>(index) + 1) / static_cast<double>(count);
  const double angle = pi * (3 - std::sqrt(5.0)) * static_cast<double>(index);
  const double r = std::sqrt(1 - z * z);
  return {r * std::cos(angle), r * std::sin(angle), z};
}

/// Holds the reported density, integrated from 0 to r, against the part of unrelated directions with residual below r.
inline void expect_density_of_random_directions(const RelationTester& relation, const Feature& fixed, bool line_like) {
  constexpr std::size_t count = 20000;
  std::vector<double> residuals;
  const auto feature = [&](const Vec3& direction) {
    return line_like ? segment_feature(Vec3::Zero(), direction) : circle_feature(Vec3::Zero(), direction, 1);
  };
  for (std::size_t i = 0; i < count; ++i)
    residuals.push_back(relate(relation, fixed, feature(sphere_direction(i, count))).residual);
  std::sort(residuals.begin(), residuals.end());
  // The integral of the density over the residuals, by the trapezium rule between directions on one meridian.
  const Vec3 normal = fixed.shape.direction, side = any_perpendicular(normal);
  std::vector<RelationResult> meridian;
  for (int i = 0; i <= 900; ++i) {
    const double angle = pi / 2 * i / 900;
    meridian.push_back(relate(relation, fixed, feature(std::cos(angle) * normal + std::sin(angle) * side)));
  }
  std::sort(meridian.begin(), meridian.end(),
            [](const RelationResult& a, const RelationResult& b) { return a.residual < b.residual; });
  const auto density = [](const RelationResult& r) { return r.clutter_density * std::pow(r.residual, r.dof - 1); };
  double integral = 0;
  for (std::size_t i = 1; i < meridian.size(); ++i) {
    integral +=
        (meridian[i].residual - meridian[i - 1].residual) * (density(meridian[i]) + density(meridian[i - 1])) / 2;
    const auto below = std::lower_bound(residuals.begin(), residuals.end(), meridian[i].residual);
    EXPECT_NEAR(static_cast<double>(below - residuals.begin()) / count, integral, 2e-3);
  }
}

}  // namespace toposcope::test
