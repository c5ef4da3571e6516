// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/working_sets.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <utility>

#include "base/errors.h"
#include "model/read_model.h"
#include "pipeline/analysis.h"
#include "pipeline/pipeline_manifest.h"
#include "result/result.h"
#include "support/meshes.h"
#include "support/plugins.h"
#include "support/program.h"

namespace toposcope {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

struct Given {
  std::string type;
  std::vector<Index> vertices;
  double saliency;
};

/// Gives what it was told to.
struct Told final : WorkingSetClassifier {
  explicit Told(std::vector<Given> given) : sets(std::move(given)) {}
  void classify(const MeshView&, Context&, WorkingSetSink& sink) const override {
    for (const Given& set : sets) sink.add(set.type, set.vertices, set.saliency);
  }
  std::vector<Given> sets;
};

WorkingSetStation station(const char* id, std::vector<std::string> types, std::vector<Given> sets) {
  return {id, std::move(types), std::make_shared<Told>(std::move(sets))};
}

std::vector<Index> vertices_of(const WorkingSets& sets, std::size_t set) {
  return {sets[set].begin(), sets[set].end()};
}

/// A grid of 5 x 5 vertices, row by row.
class PooledWorkingSets : public ::testing::Test {
 protected:
  WorkingSets classify(const std::vector<WorkingSetStation>& stations) const {
    return classify_mesh(mesh.view(), stations, test::context(2));
  }
  Mesh mesh{test::make_grid(4, 4), "grid"};
};

TEST_F(PooledWorkingSets, KeepTheNameOfTheirClassifier) {
  const WorkingSets sets = classify({station("first", {"convex"}, {{"convex", {0, 1}, 0.5}}),
                                     station("second", {"flat", "convex"}, {{"flat", {2}, 1}, {"convex", {3}, 0.25}})});
  ASSERT_EQ(sets.size(), 3);
  EXPECT_THAT(sets.plugin_names, ElementsAre("first", "second"));
  EXPECT_THAT(sets.plugins, ElementsAre(0, 1, 1));
  EXPECT_THAT(sets.type_names, ElementsAre("convex", "flat"));
  EXPECT_THAT(sets.types, ElementsAre(0, 1, 0));
  EXPECT_THAT(sets.saliency, ElementsAre(0.5, 1, 0.25));
  EXPECT_THAT(vertices_of(sets, 2), ElementsAre(3));
}

TEST_F(PooledWorkingSets, EqualOnesAreKeptOnceAtTheLargerSaliency) {
  const WorkingSets sets = classify(
      {station("first", {"convex"}, {{"convex", {5, 6, 7}, 0.5}, {"convex", {0, 1}, 0.5}}),
       station("second", {"convex", "flat"},
               {{"convex", {7, 6, 5}, 0.75}, {"flat", {0, 1}, 1}, {"convex", {0}, 1}, {"convex", {0, 1}, 0}})});
  ASSERT_EQ(sets.size(), 4) << "of another type, or of fewer vertices, is another set";
  EXPECT_THAT(sets.plugins, ElementsAre(0, 0, 1, 1));
  EXPECT_THAT(sets.types, ElementsAre(0, 0, 1, 0));
  EXPECT_THAT(sets.saliency, ElementsAre(0.75, 0.5, 1, 1));
  EXPECT_THAT(vertices_of(sets, 0), ElementsAre(5, 6, 7));
  EXPECT_THAT(vertices_of(sets, 1), ElementsAre(0, 1));
  EXPECT_THAT(vertices_of(sets, 2), ElementsAre(0, 1));
  EXPECT_THAT(vertices_of(sets, 3), ElementsAre(0));
}

/// A classifier pooled with itself gives what it gives beside one that gives nothing.
TEST_F(PooledWorkingSets, OfTheSameClassifierTwiceAreThoseOfOne) {
  const Mesh torus(test::make_torus(2, 0.6, 60, 30), "torus");
  const std::vector<std::string> types = {"convex", "concave", "planar"};
  const WorkingSetStation one{"curvature-tree", types, test::worksets("curvature-tree")};
  const WorkingSetStation both[] = {one, one};
  const WorkingSetStation beside_nothing[] = {one, station("silent", {}, {})};
  const WorkingSets alone = classify_mesh(torus.view(), beside_nothing, test::context(2));
  const WorkingSets pooled = classify_mesh(torus.view(), both, test::context(2));
  EXPECT_GT(alone.size(), 2);
  EXPECT_EQ(pooled.types, alone.types);
  EXPECT_EQ(pooled.vertices, alone.vertices);
  EXPECT_EQ(pooled.offsets, alone.offsets);
  EXPECT_EQ(pooled.saliency, alone.saliency);
}

TEST_F(PooledWorkingSets, AClassifierThatBreaksTheContractIsNamed) {
  const auto error = [&](std::vector<Given> sets) -> std::string {
    try {
      classify({station("sound", {"convex"}, {{"convex", {0}, 1}}), station("unsound", {"flat"}, std::move(sets))});
    } catch (const PluginError& refused) {
      return refused.what();
    }
    return "none";
  };
  EXPECT_EQ(error({{"flat", {1}, 1}}), "none");
  EXPECT_THAT(error({{"convex", {1}, 1}}), AllOf(HasSubstr("'unsound'"), HasSubstr("'convex'")))
      << "that another provides the type does not matter";
  EXPECT_THAT(error({{"flat", {0, 24}, 1}}), AllOf(HasSubstr("'unsound'"), HasSubstr("not connected")));
  EXPECT_THAT(error({{"flat", {99}, 1}}), AllOf(HasSubstr("'unsound'"), HasSubstr("vertex 99")));
}

constexpr const char* pool = R"(
schema: toposcope.pipeline/1
name: pool
worksets: [{plugin: curvature-tree}, {plugin: curvature}]
labeler: {plugin: least-error}
)";

class PipelineOfTwoClassifiers : public ::testing::Test {
 protected:
  PipelineOfTwoClassifiers() { test::write_text(folder / "pool.yaml", pool); }
  Stations stations(const Model& model) const {
    return make_stations(test::host(), read_pipeline(folder / "pool.yaml", test::host().catalog()), model);
  }
  static Model model(const std::string& features) {
    return model_from_text("schema: toposcope.model/1\nname: m\nfeatures:\n" + features, "m.yaml",
                           &test::host().catalog());
  }
  test::TemporaryFolder folder;
};

TEST_F(PipelineOfTwoClassifiers, ServesModelsThatAskForTheTypesOfEither) {
  const Model sound = model("  rim: {worksets: [convex], shape: circle}\n  rest: {worksets: [other], shape: plane}\n");
  const Stations both = stations(sound);
  ASSERT_EQ(both.working_sets.size(), 2);
  EXPECT_EQ(both.uses[0].id, "curvature-tree");
  EXPECT_EQ(both.uses[1].id, "curvature");
  PipelineManifest pipeline = read_pipeline(folder / "pool.yaml", test::host().catalog());
  pipeline.worksets.pop_back();
  try {
    make_stations(test::host(), pipeline, sound);
    FAIL() << "curvature-tree makes no sets of type 'other'";
  } catch (const UsageError& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("m.yaml:5:3"), HasSubstr("'other'"), HasSubstr("'curvature-tree'"),
                                    HasSubstr("pipeline 'pool'")));
  }
}

/// What is found of a mesh that was classified for two models is what each finds alone.
TEST_F(PipelineOfTwoClassifiers, AMeshIsClassifiedOnceForManyModels) {
  const Mesh mesh(test::make_torus(2, 0.6, 40, 20), "torus");
  const Model models[] = {model("  rim: {worksets: [convex], shape: circle}\n"),
                          model("  waist: {worksets: [concave], shape: circle}\n")};
  std::vector<std::string> types;
  for (const Model& each : models) add_asked_types(each, types);
  EXPECT_THAT(types, ElementsAre("convex", "concave"));
  ClassifiedMesh common = classify(mesh, stations(models[0]), types, test::context(2));
  for (const Model& each : models) {
    const Stations of_model = stations(each);
    const auto described = [&](const Analysis& analysis) {
      Result result = explain(analysis, each, "", of_model, test::context(2));
      result.timings.clear();
      return to_json(result);
    };
    Analysis shared = analyze(std::move(common), each, of_model, {}, test::context(2));
    EXPECT_EQ(described(shared), described(analyze(mesh, each, of_model, {}, test::context(2))));
    EXPECT_FALSE(shared.features.all.empty());
    common = {std::move(shared.mesh), std::move(shared.sets), {}};
  }
}

}  // namespace
}  // namespace toposcope
