// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <map>

#include "line_group_fixture.h"
#include "toposcope/geometry/lines.h"

namespace toposcope::test {
namespace {

const std::map<std::string, Corners> open_shapes = {
    {"U", {{0, 0, 0}, {10, 0, 0}, {10, 4, 0}, {0, 4, 0}}},
    {"wide U", {{0, 0, 0}, {0, 3, 0}, {11, 3, 0}, {11, 0, 0}}},
    {"swept wing", {{0, 0, 0}, {10, 3, 0.5}, {11, 5, 0.6}, {2, 6, 0.1}}},
    {"delta wing", {{0, 0, 0}, {6, 7, 0}, {7, 7, 0}, {7, 0.5, 0}}},
    {"uneven U", {{4, 0, 0}, {10, 0, 0}, {10, 4, 0}, {0, 4, 0}}},
    {"Z", {{0, 5, 0}, {8, 5, 0}, {0, 0, 0}, {8, 0, 0}}},
    {"stairs", {{0, 0, 0}, {6, 0, 0}, {6, 4, 0}, {12, 4, 0}}},
    {"corner of a box", {{5, 0, 0}, {0, 0, 0}, {0, 4, 0}, {0, 4, 6}}},
    {"L", {{0, 5, 0}, {0, 0, 0}, {9, 0, 0}}},
    {"V", {{-3, 7, 1}, {0, 0, 0}, {4, 6, 0}}},
    {"W", {{0, 5, 0}, {2, 0, 0}, {4, 4, 0}, {6, 0, 0}, {8, 5, 0}}},
};
const std::map<std::string, Corners> closed_shapes = {
    {"triangle", {{0, 0, 0}, {9, 0, 0}, {3, 6, 0}}},
    {"rectangle", {{0, 0, 0}, {9, 0, 0}, {9, 5, 0}, {0, 5, 0}}},
    {"trapezium", {{0, 0, 0}, {9, 1, 0}, {8, 5, 0}, {1, 6, 0}}},
    {"hexagon", {{4, 0, 0}, {2, 3.5, 0}, {-2, 3.5, 0}, {-4, 0, 0}, {-2, -3.5, 0}, {2, -3.5, 0}}},
};

TEST(LineGroup, RecoversExactPolylines) {
  const auto fitter = shape("line-group");
  for (const bool closed : {false, true})
    for (const auto& [name, corners] : closed ? closed_shapes : open_shapes)
      for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        Random random(seed);
        const Eigen::Matrix3d rotation = random.rotation();
        const Vec3 shift = random.normal3(30);
        const PointSets sets = transformed(sampled(corners, closed, 0.25), rotation, 2, shift);
        Corners truth = corners;
        for (Vec3& corner : truth) corner = rotation * (2 * corner) + shift;
        const int segments = static_cast<int>(corners.size()) - (closed ? 0 : 1);
        const FittedShape fitted = fit(*fitter, sets, line_group(segments, closed).options());
        ASSERT_TRUE(fitted.summary.usable()) << name << ": " << fitted.summary.message;
        EXPECT_LT(mismatch(endpoints(fitted), truth, closed), 20 * 1e-3) << name << " " << seed;
        EXPECT_GT(fitted.coverage, 0.9) << name;
        EXPECT_EQ(fitted.unexplained, 0) << name;
        EXPECT_EQ(fitted.orientation, Orientation::plane_like);
      }
}

TEST(LineGroup, RecoversExactSegments) {
  for (const char* method : {"robust", "powell"}) {
    const FittedShape fitted = fit(*shape("line-group", {{"method", method}}),
                                   sampled({{1, 2, 3}, {4, -2, 8}}, false, 0.1), line_group(1).options());
    ASSERT_TRUE(fitted.summary.usable()) << fitted.summary.message;
    EXPECT_LT(mismatch(endpoints(fitted), {{1, 2, 3}, {4, -2, 8}}, false), 1e-9);
    EXPECT_NEAR(measure(fitted, "length").value, std::sqrt(50.0), 1e-9);
    EXPECT_NEAR(measure(fitted, "length_1").value, std::sqrt(50.0), 1e-9);
    EXPECT_EQ(fitted.orientation, Orientation::line_like);
    EXPECT_LT(line_angle(fitted.direction, Vec3(3, -4, 5)), 1e-9);
    EXPECT_LT((fitted.centroid - Vec3(2.5, 0, 5.5)).norm(), 1e-9);
    EXPECT_EQ(fitted.coverage, 1);
  }
}

/// Points of some of the sides of a polyline, in two sets.
PointSets in_two_sets(const Corners& first, const Corners& second, double step, double noise, std::uint64_t seed) {
  PointSets sets = sampled(first, false, step, noise, seed);
  const PointSets other = sampled(second, false, step, noise, seed + 1000);
  sets.offsets = {0, static_cast<Index>(sets.points.size())};
  sets.points.insert(sets.points.end(), other.points.begin(), other.points.end());
  sets.offsets.push_back(static_cast<Index>(sets.points.size()));
  return sets;
}

TEST(LineGroup, JoinsTwoSetsWhereTheMiddleSegmentHasNoPoints) {
  const Corners fin = {{0, 0, 0}, {5, 10, 0}, {11, 11, 0}, {9, 0.5, 0}};
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    Random random(seed);
    const Eigen::Matrix3d rotation = random.rotation();
    const Vec3 shift = random.normal3(30);
    PointSets sets = in_two_sets({fin[0], fin[1]}, {fin[2], fin[3]}, 0.5, 0.1, seed);
    for (int i = 0; i < 3; ++i) sets.points[static_cast<std::size_t>(i)] += Vec3(-1, 0, 0);  // of a fillet
    const FittedShape fitted =
        fit(*shape("line-group"), transformed(sets, rotation, 2, shift), line_group(3).options());
    ASSERT_TRUE(fitted.summary.usable()) << fitted.summary.message;
    Corners truth = fin;
    for (Vec3& corner : truth) corner = rotation * (2 * corner) + shift;
    EXPECT_LT(mismatch(endpoints(fitted), truth, false), 2 * 2 * 0.5) << seed;
    EXPECT_LT(fitted.rms, 0.7) << seed;
    EXPECT_LT(fitted.coverage, 0.9) << "the middle has no points";
  }
}

TEST(LineGroup, BendsWithinASetWhereThatIsBetter) {
  const Corners fin = {{0, 0, 0}, {5, 10, 0}, {11, 11, 0}, {9, 0.5, 0}};
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const PointSets sets =
        in_two_sets({fin[0], fin[1], fin[2]}, {fin[2] + (fin[3] - fin[2]) / 8, fin[3]}, 0.5, 0.1, seed);
    const FittedShape fitted = fit(*shape("line-group"), sets, line_group(3).options());
    ASSERT_TRUE(fitted.summary.usable()) << fitted.summary.message;
    EXPECT_LT(mismatch(endpoints(fitted), fin, false), 2 * 0.5) << seed;
    EXPECT_GT(fitted.coverage, 0.9);
  }
}

TEST(LineGroup, SegmentHoldsAgainstOutliers) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    PointSets sets = sampled({{0, 0, 0}, {70, 0, 0}}, false, 1, 0.1, seed);
    Random random(seed);
    for (int i = 0; i < 25; ++i)  // a one-sided branch: 26 % of all points
      sets.points.push_back(Vec3(60 + 4 * random.uniform(), 1 + i, random.uniform()));
    const FittedShape fitted = fit(*shape("line-group"), sets, line_group(1).options());
    ASSERT_TRUE(fitted.summary.usable()) << fitted.summary.message;
    EXPECT_LT(line_angle(fitted.direction, Vec3::UnitX()), 0.005);
    EXPECT_NEAR(measure(fitted, "length").value, 70, 1);
    EXPECT_GT(fitted.unexplained, 15);
    EXPECT_GT(line_angle(fit(*shape("line-group", {{"method", "powell"}}), sets, line_group(1).options()).direction,
                         Vec3::UnitX()),
              0.02)
        << "least squares fails here: the test has teeth";
  }
}

/// A wing's convex edge: a band of vertices some edges wide around an open U with rounded corners.
TEST(LineGroup, WingEdgesAreFoundInANoisyBand) {
  const Corners wing = {{0, 0, 0}, {40, 14, 2}, {42, 22, 2.2}, {2, 16, 0.2}};
  int good = 0;
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    Random random(seed);
    PointSets sets = sampled(wing, false, 0.35, 0.7, seed);  // three vertices per edge of arc
    sets.mean_edge = 1;
    for (const Vec3& corner :
         {wing[1], wing[2]})  // round the corners: what lies within two edges goes towards the root
      for (Vec3& point : sets.points)
        if ((point - corner).norm() < 2) point += Vec3(-0.8, 0, 0);
    for (int i = 0; i < 25; ++i)  // a piece of fuselage
      sets.points.push_back(Vec3(-2 + 2 * random.uniform(), -6 * random.uniform(), 4 * random.uniform()));
    const FittedShape fitted = fit(*shape("line-group"), sets, line_group(3).options());
    ASSERT_TRUE(fitted.summary.usable()) << fitted.summary.message;
    good += mismatch(endpoints(fitted), wing, false) < 3.5 && fitted.coverage > 0.9;
  }
  EXPECT_GE(good, 28);
}

/// On small sets the best polyline over all triples and quadruples of points as corners bounds the cost from above.
TEST(LineGroup, CostIsNoWorseThanBruteForce) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed)
    for (const char* name : {"L", "V"}) {
      PointSets sets = sampled(open_shapes.at(name), false, 1, 0.1, seed);
      const FittedShape fitted = fit(*shape("line-group"), sets, line_group(2).options());
      ASSERT_TRUE(fitted.summary.usable());
      const auto cost = [&](const Corners& corners) {
        double sum = 0;
        for (const Vec3& point : sets.points) {
          double least = 1e30;
          for (std::size_t k = 0; k + 1 < corners.size(); ++k)
            least =
                std::min(least, (closest_on_segment(corners[k], corners[k + 1], point).point - point).squaredNorm());
          sum += least;
        }
        return sum;
      };
      double best = 1e30;
      for (const Vec3& a : sets.points)
        for (const Vec3& b : sets.points)
          for (const Vec3& c : sets.points) best = std::min(best, cost({a, b, c}));
      EXPECT_LE(cost(endpoints(fitted)), best * 1.02) << name << " " << seed;
    }
}

TEST(LineGroup, UncertaintyIsCalibrated) {
  const Corners wing = {{0, 0, 0}, {60, 0, 0}, {60, 30, 0}, {0, 30, 0}};
  Calibration middle_length, across, segment_direction;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    const FittedShape u = fit(*shape("line-group"), sampled(wing, false, 1, 0.1, seed), line_group(3).options());
    ASSERT_TRUE(u.summary.usable());
    middle_length.add(measure(u, "length_2").value - 30, measure(u, "length_2").sd);
    for (std::size_t corner = 1; corner <= 2; ++corner)  // height of the inner corners over the plane
      across.add(endpoints(u)[corner].z(), std::sqrt(u.covariance[(3 * corner + 2) * 13]));
    const FittedShape line =
        fit(*shape("line-group"), sampled({{0, 0, 0}, {60, 0, 0}}, false, 1, 0.1, seed), line_group(1).options());
    segment_direction.add(line.direction.y() / line.direction.x(), line.direction_sd);
    segment_direction.add(line.direction.z() / line.direction.x(), line.direction_sd);
  }
  for (const Calibration* each : {&middle_length, &across, &segment_direction}) {
    EXPECT_GT(each->variance(), 0.6);
    EXPECT_LT(each->variance(), 1.6);
  }
}

TEST(LineGroup, DoesNotDependOnPoseScaleOrOrder) {
  const auto fitter = shape("line-group");
  for (const int segments : {1, 2, 3}) {
    const Corners wing = {{0, 0, 0}, {40, 14, 2}, {42, 22, 2.2}, {2, 16, 0.2}};
    const Corners corners(wing.begin(), wing.begin() + segments + 1);
    const PointSets sets = sampled(corners, false, 0.5, 0.3);
    const FittedShape base = fit(*fitter, sets, line_group(segments).options());
    ASSERT_TRUE(base.summary.usable());
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      Random random(seed);
      const Eigen::Matrix3d rotation = random.rotation();
      const double scale = std::exp(3 * random.normal());
      const Vec3 shift = random.normal3(20 * scale);
      const FittedShape moved =
          fit(*fitter, transformed(shuffled(sets, seed), rotation, scale, shift), line_group(segments).options());
      ASSERT_TRUE(moved.summary.usable());
      Corners truth = endpoints(base);
      for (Vec3& corner : truth) corner = rotation * (scale * corner) + shift;
      EXPECT_LT(mismatch(endpoints(moved), truth, false), 1e-6 * 45 * scale) << segments;
      EXPECT_NEAR(moved.rms / scale, base.rms, 1e-5 * base.rms);
      EXPECT_NEAR(moved.explained, base.explained, 1e-5 * base.explained);
      EXPECT_NEAR(moved.direction_sd, base.direction_sd, 1e-4 * base.direction_sd);
      EXPECT_LT(line_angle(moved.direction, rotation * base.direction), 1e-6);
    }
  }
}

TEST(LineGroup, TwoRunsGiveTheSameBits) {
  const PointSets sets = sampled(open_shapes.at("swept wing"), false, 0.25, 0.2);
  for (const char* method : {"robust", "powell"}) {
    const auto fitter = shape("line-group", {{"method", method}});
    const FittedShape one = fit(*fitter, sets, line_group(3).options()),
                      two = fit(*fitter, sets, line_group(3).options());
    EXPECT_EQ(parameter_values(one, "endpoints"), parameter_values(two, "endpoints"));
    EXPECT_EQ(one.covariance, two.covariance);
  }
}

TEST(LineGroup, PowellAgreesWithRobustOnCleanPoints) {
  for (const char* name : {"U", "swept wing", "L"}) {
    const Corners& corners = open_shapes.at(name);
    const PointSets sets = sampled(corners, false, 0.25, 0.02);
    const Arguments arguments = line_group(static_cast<int>(corners.size()) - 1);
    const FittedShape robust = fit(*shape("line-group"), sets, arguments.options());
    const FittedShape powell = fit(*shape("line-group", {{"method", "powell"}}), sets, arguments.options());
    ASSERT_TRUE(powell.summary.usable()) << powell.summary.message;
    EXPECT_LT(mismatch(endpoints(powell), endpoints(robust), false), 0.05) << name;
    EXPECT_LE(powell.summary.final_cost, powell.summary.initial_cost);
  }
}

TEST(LineGroup, DegenerateRequestsAreRefusedWithAReason) {
  const auto fitter = shape("line-group");
  PointSets spot, line = sampled({{0, 0, 0}, {5, 1, 2}}, false, 0.1);
  for (int i = 0; i < 50; ++i) spot.points.push_back(Vec3(1, 2, 3));
  for (const FittedShape& fitted :
       {fit(*fitter, spot, line_group(1).options()), fit(*fitter, spot, line_group(3).options()),
        fit(*fitter, line, line_group(2, true).options()), fit(*fitter, PointSets{}, line_group(1).options()),
        fit(*fitter, {{Vec3(0, 0, 0), Vec3(1, 0, 0)}, 1, {}}, line_group(3).options())}) {
    EXPECT_EQ(fitted.summary.termination, Termination::degenerate);
    EXPECT_FALSE(fitted.summary.message.empty());
  }
  const FittedShape three = fit(*fitter, line, line_group(3).options());
  if (three.summary.usable()) {
    EXPECT_EQ(three.orientation, Orientation::line_like) << "endpoints on one line have no plane";
  }
}

TEST(LineGroup, BoundsContainTheFitAndOutlineLiesOnIt) {
  const auto fitter = shape("line-group");
  for (const auto& [name, corners] : open_shapes) {
    const PointSets sets = sampled(corners, false, 0.25, 0.2);
    const FittedShape fitted = fit(*fitter, sets, line_group(static_cast<int>(corners.size()) - 1).options());
    ASSERT_TRUE(fitted.summary.usable()) << name;
    for (const Measure& m : fitted.measures) {
      const Interval range = bounds(*fitter, m.name, sets, line_group(static_cast<int>(corners.size()) - 1).options());
      EXPECT_LE(range.low, m.value);
      EXPECT_GE(range.high, m.value);
    }
    double sum = 0;
    for (const Measure& m : fitted.measures) sum += m.name == "length" ? -m.value : m.value;
    EXPECT_NEAR(sum, 0, 1e-9) << "length is the sum of the segments'";
    EXPECT_LE(fitted.outline.size(), 512U);
    for (const Vec3& point : fitted.outline) EXPECT_NEAR(fitter->distance(fitted, point), 0, 1e-9);
  }
}

TEST(LineGroup, DistanceIsExactAlsoToTheClosingSegment) {
  const auto fitter = shape("line-group");
  const FittedShape open = fit(*fitter, sampled(open_shapes.at("U"), false, 0.25), line_group(3).options());
  EXPECT_NEAR(fitter->distance(open, Vec3(-3, 0, 4)), 5, 1e-3);
  EXPECT_NEAR(fitter->distance(open, Vec3(5, 2, 0)), 2, 1e-3);
  EXPECT_NEAR(fitter->distance(open, Vec3(0, 2, 0)), 2, 1e-3);
  const FittedShape closed =
      fit(*fitter, sampled(closed_shapes.at("rectangle"), true, 0.25), line_group(4, true).options());
  EXPECT_NEAR(fitter->distance(closed, Vec3(0, 2.5, 0)), 0, 1e-3);
  EXPECT_NEAR(fitter->distance(closed, Vec3(9, 2.5, 1)), 1, 1e-3);
}

}  // namespace
}  // namespace toposcope::test
