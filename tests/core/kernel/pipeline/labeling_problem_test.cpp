// SPDX-License-Identifier: BSD-3-Clause

// What fits and relations are told of the vertices, and tables that would take too much memory.

#include "pipeline/labeling_problem.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <mutex>

#include "base/errors.h"
#include "base/run_context.h"
#include "core/kernel/pipeline/rows_of_a_grid.h"

namespace toposcope {
namespace {

constexpr const char* two_bars = R"(
schema: toposcope.model/1
name: bars
features:
  one: {worksets: [convex], shape: lgrp1}
  other: {worksets: [convex], shape: lgrp1}
relationships:
  r1: {features: [one, other], type: parallel}
)";

/// Rows of a grid as working sets.
struct Bars : ::testing::Test, test::Rows {
  Bars() : Rows(two_bars, 20) {
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
  const auto watching = std::make_shared<const Watching>(*this, stations.shapes.at("line-group"));
  const auto asking = std::make_shared<const Asking>(*this);
  stations.shapes["line-group"] = watching;
  stations.relations["parallel"] = asking;
  first_look();
  build_problem(mesh.view(), model, features, overlap, stations, test::context(2));
  EXPECT_GT(watching->seen, 0);
  EXPECT_EQ(watching->wrong, 0);
  EXPECT_GT(asking->seen, 0);
  EXPECT_EQ(asking->wrong, 0);
}

TEST_F(Bars, TablesBeyondTheMemoryOfTheRunAreRefused) {
  first_look();
  const LabelingProblem problem = build_problem(mesh.view(), model, features, overlap, stations, test::context(1));
  const std::uint64_t bytes = problem.constraints[0].costs.size() * (sizeof(double) + sizeof(float));
  RunContext enough({.threads = 1, .memory_budget = bytes}), short_of({.threads = 1, .memory_budget = bytes - 1});
  EXPECT_EQ(build_problem(mesh.view(), model, features, overlap, stations, enough).constraints[0].costs,
            problem.constraints[0].costs);
  try {
    build_problem(mesh.view(), model, features, overlap, stations, short_of);
    ADD_FAILURE() << "not refused";
  } catch (const UsageError& error) {
    EXPECT_THAT(error.what(), ::testing::AllOf(::testing::HasSubstr(":8:3: "), ::testing::HasSubstr("'r1'"),
                                               ::testing::HasSubstr("need " + std::to_string(bytes) + " bytes"),
                                               ::testing::HasSubstr("max_candidates")));
  }
}

}  // namespace
}  // namespace toposcope
