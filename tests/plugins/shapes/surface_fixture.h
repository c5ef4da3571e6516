// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// What the tests of surfaces (sphere, cylinder, cone, torus) share.

#include <gtest/gtest.h>

#include <thread>

#include "shape_fixture.h"
#include "toposcope/geometry/lines.h"
#include "toposcope/geometry/point_sets.h"

namespace toposcope::test {

/// Points spread evenly over a surface by chance, each standing for its part of the area.
/// \param point  draws a point of the surface and says what its chance is, at most 1
template <class Draw>
PointSets surface_points(std::size_t count, double area, double noise, std::uint64_t seed, const Draw& draw) {
  Random random(seed);
  PointSets sets;
  sets.mean_edge = std::sqrt(area / static_cast<double>(count));
  while (sets.points.size() < count) {
    const auto [point, normal, chance] = draw(random);
    if (random.uniform() < chance) sets.points.push_back(point + noise * random.normal() * normal);
  }
  return sets;
}

struct SurfacePoint {
  Vec3 point, normal;
  double chance = 1;
};

/// A cap around the z axis, up to `cap` from the pole.
inline PointSets sphere_points(double radius, double cap, std::size_t count, double noise = 0, std::uint64_t seed = 1) {
  return surface_points(count, 2 * pi * radius * radius * (1 - std::cos(cap)), noise, seed, [&](Random& random) {
    const double z = 1 - (1 - std::cos(cap)) * random.uniform(), angle = 2 * pi * random.uniform();
    const double across = std::sqrt(std::max(0.0, 1 - z * z));
    const Vec3 n(across * std::cos(angle), across * std::sin(angle), z);
    return SurfacePoint{radius * n, n};
  });
}

/// About the z axis, its middle at the origin.
inline PointSets cylinder_points(double radius, double length, double turn, std::size_t count, double noise = 0,
                                 std::uint64_t seed = 1) {
  return surface_points(count, turn * radius * length, noise, seed, [&](Random& random) {
    const double angle = turn * random.uniform(), z = length * (random.uniform() - 0.5);
    const Vec3 n(std::cos(angle), std::sin(angle), 0);
    return SurfacePoint{radius * n + Vec3(0, 0, z), n};
  });
}

/// About the z axis, its apex at the origin, from `low` to `high` along the axis.
inline PointSets cone_points(double half_angle, double low, double high, double turn, std::size_t count,
                             double noise = 0, std::uint64_t seed = 1) {
  const double c = std::cos(half_angle), s = std::sin(half_angle);
  const double area = turn / 2 * s * (high * high - low * low) / (c * c);
  return surface_points(count, area, noise, seed, [&](Random& random) {
    const double angle = turn * random.uniform(), z = low + (high - low) * random.uniform();
    const Vec3 out(std::cos(angle), std::sin(angle), 0);
    return SurfacePoint{z * s / c * out + Vec3(0, 0, z), c * out - Vec3(0, 0, s), z / high};
  });
}

/// About the z axis, its centre at the origin; `turn` of the ring, `around` of the tube (2 pi: all of it, from
/// outside).
inline PointSets torus_points(double major, double minor, double turn, double around, std::size_t count,
                              double noise = 0, std::uint64_t seed = 1) {
  const double area = turn * minor * (major * around + 2 * minor * std::sin(around / 2));
  return surface_points(count, area, noise, seed, [&](Random& random) {
    const double angle = turn * random.uniform(), tube = around * (random.uniform() - 0.5);
    const Vec3 out(std::cos(angle), std::sin(angle), 0);
    const Vec3 n = std::cos(tube) * out + Vec3(0, 0, std::sin(tube));
    return SurfacePoint{major * out + minor * n, n, (major + minor * std::cos(tube)) / (major + minor)};
  });
}

/// `part` of all points in a box around them, anywhere.
inline PointSets with_outliers(PointSets sets, double part, std::uint64_t seed) {
  Random random(seed + 1000);
  const Box box = oriented_box(sets.points);
  const auto count = static_cast<std::size_t>(part / (1 - part) * static_cast<double>(sets.points.size()));
  for (std::size_t i = 0; i < count; ++i) {
    Vec3 point = box.center;
    for (std::size_t k = 0; k < 3; ++k)
      point += box.axes[k] * (1.4 * (random.uniform() - 0.5) * std::max(box.sides[k], box.a() / 2));
    sets.points.push_back(point);
  }
  return sets;
}

inline int dimension_of(const std::string& measure) {
  return measure == "area" ? 2 : measure == "coverage" || measure == "half_angle" ? 0 : 1;
}

/// The same fit of points that are turned, scaled, shifted and shuffled.
inline void expect_pose_scale_and_order_do_not_matter(const ShapeFitter& fitter, const PointSets& sets) {
  const FittedShape base = fit(fitter, sets);
  ASSERT_TRUE(base.summary.usable()) << base.summary.message;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    Random random(seed);
    const Eigen::Matrix3d rotation = random.rotation();
    const double scale = std::exp(3 * random.normal());
    const Vec3 shift = random.normal3(20 * scale);
    const FittedShape moved = fit(fitter, transformed(shuffled(sets, seed), rotation, scale, shift));
    ASSERT_TRUE(moved.summary.usable()) << moved.summary.message;
    for (const Measure& here : base.measures) {
      const double unit = std::pow(scale, dimension_of(here.name));
      EXPECT_NEAR(measure(moved, here.name).value / unit, here.value, 1e-6 * here.value) << here.name << seed;
      EXPECT_NEAR(measure(moved, here.name).sd / unit, here.sd, 1e-4 * here.sd) << here.name << seed;
    }
    EXPECT_LT((moved.centroid - rotation * (scale * base.centroid) - shift).norm(),
              1e-6 * scale * base.centroid_sd + 1e-6 * scale);
    EXPECT_EQ(moved.orientation, base.orientation);
    if (base.orientation != Orientation::none) {
      EXPECT_LT(line_angle(moved.direction, rotation * base.direction), 1e-6);
    }
    EXPECT_NEAR(moved.rms / scale, base.rms, 1e-6 * base.rms);
    EXPECT_NEAR(moved.explained, base.explained, 1e-6 * base.explained);
    EXPECT_NEAR(moved.unexplained, base.unexplained, 1e-6 * base.explained);
    EXPECT_NEAR(moved.centroid_sd / scale, base.centroid_sd, 1e-4 * base.centroid_sd);
    EXPECT_NEAR(moved.direction_sd, base.direction_sd, 1e-4 * base.direction_sd);
  }
}

inline void expect_same_bits_on_another_thread(const ShapeFitter& fitter, const PointSets& sets) {
  const FittedShape one = fit(fitter, sets);
  FittedShape two;
  std::thread([&] { two = fit(fitter, sets); }).join();
  ASSERT_TRUE(one.summary.usable());
  for (const ShapeParameter& each : one.parameters) EXPECT_EQ(parameter_values(two, each.name), each.values);
  EXPECT_EQ(one.covariance, two.covariance);
}

/// Points that no surface is determined by, or none of `id` but something flat.
inline void expect_degenerate_points_are_refused(const ShapeFitter& fitter) {
  PointSets line, spot, plane;
  for (int i = 0; i < 50; ++i) line.points.push_back(Vec3(1, 2, 3) + i * Vec3(0.3, -0.1, 0.7));
  for (int i = 0; i < 50; ++i) spot.points.push_back(Vec3(1, 2, 3));
  for (int i = 0; i < 100; ++i) plane.points.push_back(Vec3(i % 10, i / 10, 0.1 * (i % 10) + 3));
  const PointSets three{{Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)}, 1, {}};
  const std::pair<PointSets, const char*> all[] = {
      {line, "line"}, {spot, "spot"}, {plane, "plane"}, {three, "fewer"}, {PointSets{}, "fewer"}};
  for (const auto& [sets, word] : all) {
    const FittedShape fitted = fit(fitter, sets);
    EXPECT_EQ(fitted.summary.termination, Termination::degenerate);
    EXPECT_NE(fitted.summary.message.find(word), std::string::npos) << fitted.summary.message;
  }
  // Flat but for noise: with any luck many surfaces of great radius fit.
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Random random(seed);
    PointSets flat;
    for (int i = 0; i < 200; ++i)
      flat.points.push_back(Vec3(14 * random.uniform(), 14 * random.uniform(), 0.1 * random.normal()));
    const FittedShape fitted = fit(fitter, flat);
    EXPECT_FALSE(fitted.summary.usable()) << seed;
    EXPECT_FALSE(fitted.summary.message.empty());
  }
}

/// Outline on the surface and in steps of an edge, distances as by brute force over `samples` of the whole surface,
/// measures within bounds.
inline void expect_sound(const ShapeFitter& fitter, const PointSets& sets, const std::vector<Vec3>& samples,
                         double spacing) {
  const FittedShape fitted = fit(fitter, sets);
  ASSERT_TRUE(fitted.summary.usable()) << fitted.summary.message;
  for (const Measure& each : fitted.measures) {
    const Interval range = bounds(fitter, each.name, sets);
    EXPECT_LE(range.low, each.value) << each.name;
    EXPECT_GE(range.high, each.value) << each.name;
  }
  ASSERT_GT(fitted.outline.size(), 20U);
  EXPECT_LE(fitted.outline.size(), 512U);
  const double size = oriented_box(sets.points).diagonal();
  for (std::size_t i = 0; i < fitted.outline.size(); ++i) {
    EXPECT_NEAR(fitter.distance(fitted, fitted.outline[i]), 0, 1e-9 * size);
    if (i > 0) {
      EXPECT_LE((fitted.outline[i] - fitted.outline[i - 1]).norm(), sets.mean_edge * 1.0001);
    }
  }
  Random random(17);
  for (int i = 0; i < 60; ++i) {
    const Vec3 query = fitted.centroid + random.normal3(size / 3);
    double least = 1e300;
    for (const Vec3& sample : samples) least = std::min(least, (sample - query).norm());
    const double distance = fitter.distance(fitted, query);
    EXPECT_LE(distance, least + 1e-9 * size);
    EXPECT_GE(distance, std::sqrt(std::max(0.0, least * least - spacing * spacing)) - spacing * spacing / size);
  }
}

inline void expect_calibrated(const Calibration& calibration, const char* what) {
  EXPECT_GT(calibration.variance(), 0.6) << what;
  EXPECT_LT(calibration.variance(), 1.6) << what;
}

}  // namespace toposcope::test
