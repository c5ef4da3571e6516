// SPDX-License-Identifier: BSD-3-Clause

// What is found on a cup does not depend on how finely it was meshed.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/run_context.h"
#include "model/read_model.h"
#include "pipeline/pipeline_manifest.h"
#include "result/result.h"
#include "sample/sample.h"
#include "support/plugins.h"
#include "support/sanitized.h"
#include "truth/judgement.h"

namespace toposcope {
namespace {

namespace fs = std::filesystem;

class FineMeshes : public ::testing::TestWithParam<Index> {};

TEST_P(FineMeshes, HaveTheFeaturesOfCoarseOnes) {
  SKIP_WHEN_SANITIZED(GetParam() > 50000, "50,000 faces take the same way");
  const PluginCatalog& catalog = test::host().catalog();
  const fs::path source = TOPOSCOPE_SOURCE_DIR;
  const Model model = read_model(source / "models/cup.yaml", &catalog);
  const Stations stations =
      make_stations(test::host(), read_pipeline(source / "pipelines/default.yaml", catalog), model);
  Sample sample = make_sample({.kind = "cup", .faces = GetParam()}, test::context(2));
  const Mesh mesh(std::move(sample.mesh), "cup", &test::context(2));
  const Analysis analysis = analyze(mesh, model, stations, {}, test::context(2));
  const Result result = explain(analysis, model, "", stations, test::context(2));
  EXPECT_EQ(analysis.mesh.coarse.has_value(), GetParam() > 2 * stations.resolution.faces);

  double area = 0;
  std::vector<double> labelled(result.features.size(), 0);
  const MeshView& view = mesh.view();
  const auto area_of = [&](Index t) {
    const auto& [a, b, c] = view.triangles[t];
    return (view.positions[b] - view.positions[a]).cross(view.positions[c] - view.positions[a]).norm() / 2;
  };
  for (Index t = 0; t < view.face_count(); ++t) area += area_of(t);
  for (std::size_t f = 0; f < result.features.size(); ++f)
    for (const Index t : result.features[f].triangles) labelled[f] += area_of(t) / area;
  for (std::size_t f = 0; f < result.features.size(); ++f) {
    EXPECT_TRUE(result.features[f].present) << result.features[f].name;
    EXPECT_GT(labelled[f], 0.003) << result.features[f].name;
    EXPECT_LT(labelled[f], 0.1) << result.features[f].name;
  }
  const auto radius = [&](std::size_t f) { return result.features[f].shape.measure("radius")->value; };
  ASSERT_EQ(result.features[0].name, "rim");
  EXPECT_NEAR(radius(0), 38.87, 1);
  ASSERT_EQ(result.features[1].name, "bottomEdge");
  EXPECT_NEAR(radius(1), 34.24, 0.3);
}

INSTANTIATE_TEST_SUITE_P(Faces, FineMeshes, ::testing::Values(5000, 50000, 500000, 1000000));

}  // namespace
}  // namespace toposcope
