// SPDX-License-Identifier: BSD-3-Clause

// Where faces and vertices come from, over any number of filters.

#include "pipeline/filters.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <numeric>

#include "base/errors.h"
#include "support/meshes.h"
#include "support/plugins.h"

namespace toposcope {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// A filter that gives one mesh, whatever it gets.
struct Gives final : MeshFilter {
  Gives(std::vector<Vec3> p, std::vector<Triangle> t, std::vector<Index> kept)
      : positions(std::move(p)), triangles(std::move(t)), vertex_origin(std::move(kept)) {}
  std::vector<Vec3> positions;
  std::vector<Triangle> triangles;
  std::vector<Index> vertex_origin;
  void apply(const MeshView&, Context&, MeshSink& sink) const override {
    sink.set(positions, triangles, std::vector<Index>(triangles.size(), 0), vertex_origin);
  }
};

const std::vector<Vec3> corners = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}};
const Vec3 middle(1, 0, 0), other_middle(0, 1, 0);

struct Origins : ::testing::Test {
  Origins() : mesh({corners, {{0, 1, 2}}, {0}, 1}, "triangle") {}

  PreparedMesh filtered(const std::vector<Gives>& filters) {
    std::vector<FilterStation> stations;
    for (const Gives& filter : filters) stations.push_back({"odd", std::make_shared<const Gives>(filter)});
    return apply_filters(mesh, stations, test::context());
  }
  std::string refusal(const Gives& filter) {
    try {
      filtered({filter});
      return "";
    } catch (const PluginError& error) {
      return error.what();
    }
  }
  Mesh mesh;
};

std::vector<Index> input_vertices(const PreparedMesh& prepared) {
  const auto span = prepared.view().input_vertices;
  return {span.begin(), span.end()};
}

TEST_F(Origins, WithoutAFilterAllVerticesAreTheInputs) {
  EXPECT_TRUE(filtered({}).view().input_vertices.empty());
}

TEST_F(Origins, AreComposedOverFilters) {
  // First the middle of an edge comes in, then the vertices change their order and one more is made.
  const Gives split{{corners[0], corners[1], corners[2], middle}, {{0, 3, 2}, {3, 1, 2}}, {0, 1, 2, no_vertex}};
  EXPECT_THAT(input_vertices(filtered({split})), ElementsAre(0, 1, 2, no_vertex));
  const Gives turn{{middle, other_middle, corners[2], corners[0], corners[1]},
                   {{3, 0, 1}, {0, 4, 2}, {0, 2, 1}},
                   {3, no_vertex, 2, 0, 1}};
  EXPECT_THAT(input_vertices(filtered({split, turn})), ElementsAre(no_vertex, no_vertex, 2, 0, 1));
}

TEST_F(Origins, OfAFilterThatKeepsNoneAreNone) {
  const Gives moved{{{0, 0, 1}, {2, 0, 1}, {0, 2, 1}}, {{0, 1, 2}}, {}};
  EXPECT_THAT(input_vertices(filtered({moved})), ElementsAre(no_vertex, no_vertex, no_vertex));
  const Gives same{moved.positions, {{0, 1, 2}}, {0, 1, 2}};
  EXPECT_THAT(input_vertices(filtered({moved, same})), ElementsAre(no_vertex, no_vertex, no_vertex))
      << "what came from nowhere stays from nowhere";
}

TEST_F(Origins, ThatAreNoneAreRefused) {
  Gives filter{corners, {{0, 1, 2}}, {0, 1, 2}};
  EXPECT_EQ(refusal(filter), "");
  filter.vertex_origin = {0, 1};
  EXPECT_THAT(refusal(filter), HasSubstr("2 vertex origins for 3 vertices"));
  filter.vertex_origin = {0, 1, 3};
  EXPECT_THAT(refusal(filter), HasSubstr("vertex 2 is vertex 3 of its input"));
  filter.vertex_origin = {1, 0, 2};
  EXPECT_THAT(refusal(filter), HasSubstr("does not lie there"));
}

TEST(OriginsOfFilters, WhatIsNarrowerThanATriangleLabelsThoseThatItTouches) {
  const Mesh mesh({{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {2, 2, 0}}, {{0, 1, 2}, {1, 3, 2}}, {0, 1}, 2}, "square");
  const std::vector<FilterStation> filters = {{"refine", test::filter("refine", {{"max_edge", "0.2"}})}};
  const PreparedMesh prepared = apply_filters(mesh, filters, test::context());
  std::vector<bool> which(prepared.view().face_count(), false);
  ASSERT_GT(which.size(), 8U);
  EXPECT_THAT(prepared.input_triangles(which), ElementsAre());
  which[0] = true;
  EXPECT_THAT(prepared.input_triangles(which), ElementsAre(prepared.origin[0]));
  for (std::size_t f = 0; f < which.size(); ++f) which[f] = prepared.origin[f] == 0;
  which[0] = true;
  EXPECT_THAT(prepared.input_triangles(which), ElementsAre(0)) << "one piece of the other is not half of it";
}

TEST(OriginsOfFilters, RefinedThenDecimatedVerticesAreWhereTheyWere) {
  const Mesh mesh(test::make_torus(1, 0.4, 24, 12), "torus");
  const std::vector<FilterStation> filters = {{"refine", test::filter("refine", {{"max_edge", "0.05"}})},
                                              {"decimate", test::filter("decimate", {{"faces", "700"}})}};
  const PreparedMesh prepared = apply_filters(mesh, filters, test::context());
  const MeshView& view = prepared.view();
  ASSERT_EQ(view.input_vertices.size(), view.vertex_count());
  Index kept = 0;
  for (Index v = 0; v < view.vertex_count(); ++v) {
    if (view.input_vertices[v] == no_vertex) continue;
    ++kept;
    EXPECT_EQ(view.positions[v], mesh.view().positions[view.input_vertices[v]]);
  }
  EXPECT_GT(kept, 0U);
  EXPECT_LT(kept, view.vertex_count());
}

}  // namespace
}  // namespace toposcope
