// SPDX-License-Identifier: BSD-3-Clause

// Which constructed features may stand beside each other.

#include "pipeline/places.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/kernel/pipeline/hand_made_run.h"

namespace toposcope {
namespace {

/// A ring about z; its radius is that of the outline.
struct RingFitter : ShapeFitter {
  FittedShape fit(const FitInput&, const Options&, Context&) const override { return {}; }
  double distance(const FittedShape& shape, const Vec3& point) const override {
    const Vec3 from = point - shape.centroid;
    return std::hypot(std::hypot(from.x(), from.y()) - (shape.outline.front() - shape.centroid).norm(), from.z());
  }
};

ConstructedFeature ring(const RingFitter& fitter, const Vec3& centre, double radius, double rms) {
  ConstructedFeature made;
  made.fitter = &fitter;
  made.dimension = 1;
  made.shape.centroid = centre;
  made.shape.rms = rms;
  for (int i = 0; i < 64; ++i) {
    const double angle = 2 * std::numbers::pi * i / 64;
    made.shape.outline.push_back(centre + radius * Vec3(std::cos(angle), std::sin(angle), 0));
  }
  return made;
}

struct Places : ::testing::Test, test::HandMadeRun {
  Places() {
    for (int row = 0; row < 10; ++row) add_set(row);
    measure();
  }
  ConstructedFeature region(int first_row, int last_row, int dimension) const {
    ConstructedFeature made;
    made.dimension = dimension;
    for (int row = first_row; row <= last_row; ++row) {
      made.sets.push_back(static_cast<Index>(row));
      for (const Index v : sets[static_cast<std::size_t>(row)]) made.vertices.push_back(v);
    }
    return made;
  }
  bool exclude(const ConstructedFeature& a, const ConstructedFeature& b) const {
    const BitMatrix made = exclusions(run(), sets, {a, b});
    EXPECT_TRUE(made.get(0, 0) && made.get(1, 1));
    EXPECT_EQ(made.get(0, 1), made.get(1, 0));
    return made.get(0, 1);
  }
  /// A ring of one set that no other has, of no vertices: as sharp as can be.
  static ConstructedFeature on_row(ConstructedFeature made, int row) {
    made.sets = {static_cast<Index>(row)};
    return made;
  }
};

TEST_F(Places, TwoOfOneDimensionMayNotShareAVertex) {
  EXPECT_TRUE(exclude(region(0, 4, 2), region(4, 8, 2)));
  EXPECT_TRUE(exclude(region(0, 0, 1), region(0, 0, 1)));
  EXPECT_FALSE(exclude(region(0, 3, 2), region(4, 8, 2)));
}

TEST_F(Places, ALineMayLieOnTheBorderOfASurface) {
  EXPECT_FALSE(exclude(region(4, 4, 1), region(0, 4, 2)));  // its last row
  EXPECT_FALSE(exclude(region(4, 5, 1), region(0, 4, 2)));  // astride
  EXPECT_FALSE(exclude(region(0, 4, 2), region(4, 5, 1)));
}

TEST_F(Places, ButNotWithinIt) {
  EXPECT_TRUE(exclude(region(2, 2, 1), region(0, 5, 2)));
}

TEST_F(Places, NorOnTheSameVertices) {
  EXPECT_TRUE(exclude(region(4, 4, 1), region(4, 4, 2)));
  EXPECT_TRUE(exclude(region(3, 5, 1), region(3, 5, 2)));
}

TEST_F(Places, WhoseDimensionIsUnknownMayNotShareAVertex) {
  EXPECT_TRUE(exclude(region(4, 4, -1), region(0, 4, 2)));
}

TEST_F(Places, PiecesOfOneRingAreOnePlace) {
  const RingFitter fitter;
  const ConstructedFeature whole = on_row(ring(fitter, Vec3(0, 0, 0), 6, 0.1), 0);
  EXPECT_TRUE(exclude(whole, on_row(ring(fitter, Vec3(0.1, 0, 0), 6.05, 0.1), 9)));
  EXPECT_FALSE(exclude(whole, on_row(ring(fitter, Vec3(0, 0, 0), 6.5, 0.1), 9))) << "0.5 apart, told apart by 0.2";
  EXPECT_TRUE(exclude(whole, on_row(ring(fitter, Vec3(0, 0, 0), 6.5, 0.4), 9))) << "within the noise";
  EXPECT_FALSE(exclude(whole, on_row(ring(fitter, Vec3(20, 0, 0), 6, 0.1), 9)));
  // On a flat grid rings that lie closer than its edges are one band.
  ConstructedFeature coarse = on_row(ring(fitter, Vec3(0, 0, 0), 6, 0.1), 0);
  ConstructedFeature beside = on_row(ring(fitter, Vec3(0, 0, 0), 6.5, 0.1), 9);
  coarse.vertices = region(0, 0, 1).vertices;
  beside.vertices = region(9, 9, 1).vertices;
  EXPECT_TRUE(exclude(coarse, beside));
  ConstructedFeature surface = on_row(ring(fitter, Vec3(0, 0, 0), 6, 0.1), 9);
  surface.dimension = 2;
  EXPECT_FALSE(exclude(whole, surface));
}

}  // namespace
}  // namespace toposcope
