// SPDX-License-Identifier: BSD-3-Clause

// What fits and relations are told of the vertices.

#include <gtest/gtest.h>

#include <mutex>

#include "core/kernel/pipeline/rows_of_a_grid.h"
#include "pipeline/relate.h"

namespace toposcope {
namespace {

/// Rows of a grid as working sets.
struct Bars : ::testing::Test, test::Rows {
  Bars() : Rows(test::two_bars, 20) {
    add_rows(2, 2);
    add_rows(8, 8);
  }
  bool are_vertices(const MeshView* of, std::span<const Vec3> points, std::span<const Index> vertices) const {
    if (of == nullptr || of->positions.data() != mesh.view().positions.data()) return false;
    if (points.empty() || vertices.size() != points.size()) return false;
    for (std::size_t i = 0; i < points.size(); ++i)
      if (of->positions[vertices[i]] != points[i]) return false;
    return true;
  }
};

TEST_F(Bars, FitsAndRelationsKnowTheVertices) {
  struct Watching final : ShapeFitter {
    const Bars& bars;
    std::shared_ptr<const ShapeFitter> fitter;
    mutable std::mutex mutex;
    mutable int seen = 0, wrong = 0;
    Watching(const Bars& of, std::shared_ptr<const ShapeFitter> by) : bars(of), fitter(std::move(by)) {}
    FittedShape fit(const FitInput& input, const Options& arguments, Context& context) const override {
      const std::lock_guard lock(mutex);
      ++seen;
      wrong += bars.are_vertices(input.mesh, input.points, input.vertices) ? 0 : 1;
      return fitter->fit(input, arguments, context);
    }
    double distance(const FittedShape& shape, const Vec3& point) const override {
      return fitter->distance(shape, point);
    }
  };
  struct Asking final : RelationTester {
    const Bars& bars;
    mutable std::mutex mutex;
    mutable int seen = 0, wrong = 0;
    explicit Asking(const Bars& of) : bars(of) {}
    RelationResult test(const RelationInput& input, const Options&, Context&) const override {
      const std::lock_guard lock(mutex);
      for (const RelationOperand& feature : input.features) {
        ++seen;
        wrong += bars.are_vertices(input.mesh, feature.points, feature.vertices) ? 0 : 1;
      }
      RelationResult result;
      result.tolerance = result.clutter_density = 1;
      return result;
    }
  };
  const auto watching = std::make_shared<const Watching>(*this, stations.features[0].fitter);
  const auto asking = std::make_shared<const Asking>(*this);
  for (FeatureStation& feature : stations.features) feature.fitter = watching;
  stations.relationships[0].tester = asking;
  first_look();
  relate(run(), sets, features);
  EXPECT_GT(watching->seen, 0);
  EXPECT_EQ(watching->wrong, 0);
  EXPECT_GT(asking->seen, 0);
  EXPECT_EQ(asking->wrong, 0);
}

}  // namespace
}  // namespace toposcope
