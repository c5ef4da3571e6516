// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <map>

#include "base/errors.h"
#include "base/run_context.h"
#include "sample/scan.h"
#include "sample/solid.h"
#include "toposcope/geometry/closest_face.h"
#include "toposcope/geometry/point_sets.h"

namespace toposcope {
namespace {

TEST(ScanTarget, LiesOnTheExactSurfaceAndIsWatertight) {
  RunContext context({.threads = 2});
  for (const char* kind : {"cup", "tee", "airplane"}) {
    const Sample target = make_scan_target({.kind = kind}, context);
    const Solid solid = make_solid(kind, target.parameters);
    const double diagonal = (solid.high - solid.low).norm();
    std::map<std::pair<Index, Index>, int> balance;
    for (const Triangle& t : target.mesh.triangles)
      for (std::size_t i = 0; i < 3; ++i) {
        const Index a = t[i], b = t[(i + 1) % 3];
        balance[{std::min(a, b), std::max(a, b)}] += a < b ? 1 : -1;
      }
    for (const auto& [edge, sum] : balance) EXPECT_EQ(sum, 0) << kind;
    double off = 0;
    for (const Triangle& t : target.mesh.triangles) {
      const auto& p = target.mesh.positions;
      EXPECT_LT(std::abs(solid.surface(p[t[0]]).value), 1e-6 * diagonal);
      off += std::abs(solid.surface((p[t[0]] + p[t[1]] + p[t[2]]) / 3).value);
    }
    EXPECT_LT(off / static_cast<double>(target.mesh.triangles.size()), 0.0002 * diagonal) << kind;
  }
}

/// Three wyes of which a net of cells of 0.03 diagonals loses a rim.
TEST(ScanTarget, PassesThroughThePointsOfItsFeatures) {
  RunContext context;
  for (const std::uint64_t seed : {15, 90, 780}) {
    const Sample target = make_scan_target({.kind = "wye", .faces = 10000, .seed = seed, .random = true}, context);
    const ClosestFace surface(target.mesh.positions, target.mesh.triangles);
    const Box box = oriented_box(target.mesh.positions);
    for (const TruthFeature& f : target.truth.features) {
      double farthest = 0;
      for (const Vec3& p : f.points) farthest = std::max(farthest, surface(p).squared_distance);
      EXPECT_LT(std::sqrt(farthest), 0.002 * box.diagonal()) << f.name << " of seed " << seed;
    }
  }
}

TEST(ScanTarget, RefusesWhatMakeSampleRefuses) {
  RunContext context({.threads = 2});
  EXPECT_THROW(make_scan_target({.kind = "teapot"}, context), UsageError);
  EXPECT_THROW(make_scan_target({.kind = "cup", .faces = 10}, context), UsageError);
}

}  // namespace
}  // namespace toposcope
