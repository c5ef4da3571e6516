// SPDX-License-Identifier: BSD-3-Clause

// Line groups whose one segment ends at the centroids of two patches of surface.

#include <gtest/gtest.h>

#include "line_group_fixture.h"

namespace toposcope::test {
namespace {

TEST(LineGroup, SegmentBetweenCentroidsOfTheSets) {
  PointSets sets;
  Random random(4);
  for (int i = 0; i < 25; ++i) sets.points.push_back(Vec3(0, 0, 10) + random.normal3(0.5));
  for (int i = 0; i < 16; ++i) sets.points.push_back(Vec3(0, 0, 0) + random.normal3(0.5));
  sets.offsets = {0, 25, 41};
  const FittedShape fitted = fit(*shape("line-group"), sets, line_group(1, false, "centroids").options());
  ASSERT_TRUE(fitted.summary.usable()) << fitted.summary.message;
  Vec3 top = Vec3::Zero(), low = Vec3::Zero();
  for (std::size_t i = 0; i < 41; ++i) (i < 25 ? top : low) += sets.points[i] / (i < 25 ? 25 : 16);
  EXPECT_LT(mismatch(endpoints(fitted), {top, low}, false), 1e-12);
  EXPECT_NEAR(measure(fitted, "length").value, (top - low).norm(), 1e-12);
  EXPECT_NEAR(fitted.explained, 5 + 4, 1e-12);
  EXPECT_EQ(fitted.coverage, 1);
  EXPECT_NEAR(fitted.rms, 0.5 * std::sqrt(2.5), 0.15);  // two components across, half of the points beyond an end
  EXPECT_GT(fitted.direction_sd, 0);
  for (const Measure& m : fitted.measures) {
    const Interval range = bounds(*shape("line-group"), m.name, sets, line_group(1, false, "centroids").options());
    EXPECT_LE(range.low, m.value) << m.name;
    EXPECT_GE(range.high, m.value) << m.name;
  }
  EXPECT_LT(measure(fitted, "end_size").value, 6 * 0.5 * 2);
  EXPECT_GT(measure(fitted, "end_depth").value, 0.2) << "a ball is as deep as it is long";
  const FittedShape one = fit(*shape("line-group"), {sets.points, 1, {}}, line_group(1, false, "centroids").options());
  EXPECT_EQ(one.summary.termination, Termination::degenerate);
  EXPECT_NE(one.summary.message.find("two working sets"), std::string::npos);
}

/// Two rings of fillets of radius 3, each with a patch beside it that bends little, or the other way.
PointSets rings_with_fringes(double bend_of_fringe) {
  PointSets sets;
  for (const double height : {20.0, 0.0}) {
    for (int i = 0; i < 24; ++i) {
      const double angle = 2 * pi * i / 24;
      sets.points.push_back(Vec3(0, 0, height) + 3 * Vec3(std::cos(angle), std::sin(angle), 0));
      sets.integrated_mean_curvature.push_back(-0.5);
    }
    for (int i = 0; i < 12; ++i) {
      sets.points.push_back(Vec3(4 + 0.3 * i, 0, height));
      sets.integrated_mean_curvature.push_back(bend_of_fringe);
    }
  }
  sets.offsets = {0, 36, 72};
  return sets;
}

TEST(LineGroup, SegmentBetweenTheCentroidsOfWhatBendsInwards) {
  const Corners ends = {{0, 0, 20}, {0, 0, 0}};
  const auto fitted = [](const PointSets& sets, const std::string& which) {
    const FittedShape shape_of = fit(*shape("line-group"), sets, line_group(1, false, which).options());
    EXPECT_TRUE(shape_of.summary.usable()) << shape_of.summary.message;
    return shape_of;
  };
  for (const double fringe : {0.0, 0.1, 5.0})
    EXPECT_LT(mismatch(endpoints(fitted(rings_with_fringes(fringe), "concave")), ends, false), 1e-12)
        << "what does not bend inwards has no weight, however many points it has and however much it bends";
  EXPECT_LT(mismatch(endpoints(fitted(rings_with_fringes(-0.01), "concave")), ends, false), 0.1);
  EXPECT_GT(mismatch(endpoints(fitted(rings_with_fringes(-0.01), "centroids")), ends, false), 1);

  PointSets outwards = rings_with_fringes(5.0);
  for (double& bend : outwards.integrated_mean_curvature) bend = -bend;
  EXPECT_LT(mismatch(endpoints(fitted(outwards, "convex")), ends, false), 1e-12);

  // Of sets that do not bend that way, or of which that is not known, the surface's centroids.
  PointSets flat = rings_with_fringes(0.0);
  const Corners of_surface = endpoints(fitted(flat, "centroids"));
  flat.integrated_mean_curvature.assign(flat.integrated_mean_curvature.size(), 0.3);
  EXPECT_LT(mismatch(endpoints(fitted(flat, "concave")), of_surface, false), 1e-12);
  flat.integrated_mean_curvature.clear();
  EXPECT_LT(mismatch(endpoints(fitted(flat, "concave")), of_surface, false), 1e-12);
}

// Rings of fillets in a scan: a threshold leaves out each point with a probability that grows as it bends less.
TEST(LineGroup, UncertaintyOfCentroidsOfWhatBendsCoversTheirErrors) {
  Calibration across;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    Random random(seed);
    PointSets sets;
    for (const double height : {20.0, 0.0}) {
      for (int i = 0; i < 24; ++i)
        for (int j = -1; j <= 1; ++j) {
          const double angle = 2 * pi * i / 24, bend = j == 0 ? 1 : 0.3;
          if (random.uniform() > (j == 0 ? 0.95 : 0.5)) continue;
          sets.points.push_back(Vec3(0, 0, height) + (4 + j) * Vec3(std::cos(angle), std::sin(angle), 0));
          sets.integrated_mean_curvature.push_back(-bend * (0.8 + 0.4 * random.uniform()));
        }
      sets.offsets.push_back(static_cast<Index>(sets.points.size()));
    }
    sets.offsets.insert(sets.offsets.begin(), 0);
    const FittedShape f = fit(*shape("line-group"), sets, line_group(1, false, "concave").options());
    across.add(endpoints(f)[0].x(), std::sqrt(f.covariance[0]));
  }
  EXPECT_LT(across.variance(), 1) << "the sets' ends are not all that is uncertain";
  EXPECT_GT(across.variance(), 0.06) << "no more than four times too wide";
}

}  // namespace
}  // namespace toposcope::test
