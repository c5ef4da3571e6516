// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <set>

#include "base/errors.h"
#include "base/run_context.h"
#include "mesh/mesh.h"
#include "pipeline/working_sets.h"
#include "support/meshes.h"
#include "support/plugins.h"

namespace toposcope {
namespace {

WorkingSets classify(const Mesh& mesh, const std::vector<std::pair<std::string, std::string>>& options = {}) {
  RunContext context;
  const WorkingSetStation station{
      "curvature", {"convex", "concave", "planar", "other"}, test::worksets("curvature", options)};
  return classify_mesh(mesh.view(), {&station, 1}, context);
}

std::size_t count(const WorkingSets& sets, const std::string& type) {
  std::size_t n = 0;
  for (std::size_t s = 0; s < sets.size(); ++s) n += sets.type_names[sets.types[s]] == type;
  return n;
}

/// A closed can has two planar ends, one wall between the thresholds, two convex edges.
TEST(CurvatureWorkingSets, OfACylinder) {
  const Mesh mesh(test::make_can(1, 3, 64, 30, 10), "can");
  const WorkingSets sets =
      classify(mesh, {{"neighbourhood", "0"}, {"plane_threshold", "2"}, {"high_threshold", "10"}, {"smoothing", "0"}});
  EXPECT_EQ(count(sets, "planar"), 2u);
  EXPECT_EQ(count(sets, "convex"), 2u);
  EXPECT_EQ(count(sets, "other"), 1u);
  EXPECT_EQ(count(sets, "concave"), 0u);
}

TEST(CurvatureWorkingSets, CoverEveryVertexOnce) {
  const Mesh mesh(test::make_torus(2, 0.6, 60, 30), "torus");
  const WorkingSets sets = classify(mesh);
  const std::set<Index> distinct(sets.vertices.begin(), sets.vertices.end());
  EXPECT_EQ(sets.vertices.size(), mesh.view().vertex_count());
  EXPECT_EQ(distinct.size(), mesh.view().vertex_count());
}

/// Thresholds are relative to the object: the unit plays no role (the dissertation's sign test reads every concave
/// vertex as convex at curvatures above 2 per unit).
TEST(CurvatureWorkingSets, DoNotDependOnTheUnit) {
  TriangleSoup soup = test::make_torus(2, 0.6, 60, 30);
  const Mesh mesh(soup, "torus");
  for (Vec3& p : soup.positions) p /= 1024;
  const Mesh small(soup, "torus");
  EXPECT_EQ(classify(mesh).vertices, classify(small).vertices);
  EXPECT_EQ(classify(mesh).types, classify(small).types);
}

TEST(CurvatureWorkingSets, MergeSmallImbeddedRegions) {
  TriangleSoup soup = test::make_grid(40, 40);
  soup.positions[20 * 41 + 20].z() += 0.3 * (soup.positions[1] - soup.positions[0]).norm();  // one bump
  const Mesh mesh(soup, "grid");
  const std::pair<std::string, std::string> near{"neighbourhood", "0"}, unsmoothed{"smoothing", "0"};
  EXPECT_GT(classify(mesh, {near, unsmoothed, {"min_region", "0"}}).size(), 1u);
  EXPECT_EQ(classify(mesh, {near, unsmoothed, {"min_region", "1"}}).size(), 1u);
}

TEST(CurvatureWorkingSets, RefuseThresholdsInTheWrongOrder) {
  try {
    test::worksets("curvature", {{"plane_threshold", "20"}, {"high_threshold", "10"}});
    FAIL();
  } catch (const PluginError& error) {
    EXPECT_NE(std::string(error.what()).find("plane_threshold"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace toposcope
