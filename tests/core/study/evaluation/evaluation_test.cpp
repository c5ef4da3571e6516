// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/evaluation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/errors.h"
#include "io/mesh_io.h"
#include "model/read_model.h"
#include "pipeline/pipeline_manifest.h"
#include "support/meshes.h"
#include "support/plugins.h"
#include "support/program.h"

namespace toposcope {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

FeatureJudgement judged(const std::string& feature, Verdict verdict, double distance, double probability) {
  FeatureJudgement result;
  result.feature = feature;
  result.verdict = verdict;
  result.distance = distance;
  result.probability = probability;
  return result;
}

/// Two meshes of one object at two resolutions: mean edges 1 and 2, diagonals 100.
Evaluation by_hand() {
  const double none = std::nan("");
  Evaluation evaluation;
  evaluation.dataset = "hand";
  evaluation.meshes.resize(2);
  MeshEvaluation& fine = evaluation.meshes[0];
  fine.name = "cup 5K", fine.object = "cup", fine.variant = "5K";
  fine.judgement = {{judged("rim", Verdict::right, 1, 0.95), judged("handle", Verdict::absent, none, 0.85)}, 1, 100};
  MeshEvaluation& coarse = evaluation.meshes[1];
  coarse.name = "cup 2K", coarse.object = "cup", coarse.variant = "2K";
  coarse.judgement = {{judged("rim", Verdict::wrong, 6, 0.95), judged("handle", Verdict::missed, none, 0.15)}, 2, 100};
  return evaluation;
}

TEST(Evaluation, SumsUpPerFeature) {
  const Evaluation evaluation = by_hand();
  const std::vector<FeatureSummary> summaries = summarize(all_of(evaluation));
  ASSERT_EQ(summaries.size(), 3U);
  EXPECT_EQ(summaries[0].name, "rim");
  EXPECT_EQ(summaries[0].right, 1U);
  EXPECT_EQ(summaries[0].wrong, 1U);
  EXPECT_NEAR(summaries[0].distance, 3.5, 1e-12);
  EXPECT_NEAR(summaries[0].edges, 2, 1e-12) << "1 and 3 mean edges";
  EXPECT_NEAR(summaries[0].worst_edges, 3, 1e-12);
  EXPECT_NEAR(summaries[0].diagonal, 0.035, 1e-12);
  EXPECT_EQ(summaries[1].absent, 1U);
  EXPECT_EQ(summaries[1].missed, 1U);
  EXPECT_EQ(summaries[1].measured, 0U);
  EXPECT_EQ(summaries[2].name, "all");
  EXPECT_EQ(summaries[2].all(), 4U);
}

TEST(Evaluation, CalibrationErrorIsTheWeightedGap) {
  const Evaluation evaluation = by_hand();
  const Reliability reliable = reliability(all_of(evaluation));
  EXPECT_EQ(reliable.count, 4U);
  EXPECT_EQ(reliable.bins[9].count, 2U);
  EXPECT_EQ(reliable.bins[9].right, 1U);
  EXPECT_EQ(reliable.bins[8].right, 1U);
  EXPECT_EQ(reliable.bins[1].right, 0U);
  EXPECT_NEAR(reliable.expected_calibration_error, 0.5 * 0.45 + 0.25 * 0.15 + 0.25 * 0.15, 1e-12);
}

TEST(Evaluation, ATenthOfAllAtOneIsInTheLastBin) {
  Evaluation evaluation = by_hand();
  evaluation.meshes[0].judgement.features[0].probability = 1;
  EXPECT_EQ(reliability(all_of(evaluation)).bins[9].count, 2U);
}

TEST(Evaluation, ConfusionCountsClasses) {
  Evaluation evaluation = by_hand();
  evaluation.meshes[0].expected_class = evaluation.meshes[1].expected_class = "tee";
  evaluation.meshes[0].found_class = "tee";
  const auto counts = confusion(all_of(evaluation));
  EXPECT_EQ(counts.at("tee").at("tee"), 1U);
  EXPECT_EQ(counts.at("tee").at("unknown"), 1U);
}

TEST(Evaluation, TablesHaveAColumnPerResolutionAndTellWhatIsWrong) {
  const Evaluation evaluation = by_hand();
  const std::string text = to_text(tables(evaluation));
  for (const char* part : {"5K", "2K", "wrong 3.0", "missed", "none", "Expected calibration error 0.300"})
    EXPECT_THAT(text, HasSubstr(part));
  EXPECT_THAT(to_markdown(tables(evaluation)), HasSubstr("| cup | rim | 1.00 | wrong 3.0 |"));
  EXPECT_THAT(headline(evaluation), HasSubstr("2 of 4 features right (50.0 %), 1 of 2 meshes wholly"));
}

TEST(Evaluation, ChangesSinceABaseline) {
  Evaluation before = by_hand(), after = by_hand();
  after.meshes[1].judgement.features[0].verdict = Verdict::right;
  after.meshes[0].judgement.features[1].verdict = Verdict::spurious;
  const std::string text = to_text(changes(after, to_json({before}), "old.json"));
  EXPECT_THAT(text, HasSubstr("1 better, 1 worse"));
  EXPECT_THAT(text, HasSubstr("cup 2K  rim"));
  EXPECT_THROW(changes(after, "{}", "old.json"), UsageError);
  EXPECT_THROW(changes(after, "no json", "old.json"), UsageError);
}

TEST(Evaluation, CsvHasARowPerFeature) {
  const std::string csv = to_csv({by_hand()});
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 5);
  EXPECT_THAT(csv, HasSubstr("hand,cup 2K,cup,2K,0,rim,wrong,6,3,0.06,0.95,"));
}

TEST(Evaluation, AMeshWithoutTruthIsNoSuccess) {
  const PluginCatalog& catalog = test::host().catalog();
  const std::filesystem::path source = TOPOSCOPE_SOURCE_DIR;
  const Model cup = read_model(source / "models/cup.yaml", &catalog);
  const Model fitting = read_model(source / "models/pipe-fitting.yaml", &catalog);
  const PipelineManifest pipeline = read_pipeline(source / "pipelines/default.yaml", catalog);
  const test::TemporaryFolder folder;
  const TriangleSoup box = test::make_box({1, 2, 3}, 8);
  write_mesh(folder / "box.ply", box.positions, box.triangles);
  Dataset dataset;
  dataset.meshes.resize(1);
  dataset.meshes[0].name = "box";
  dataset.meshes[0].source = MeshFile{folder / "box.ply", {}, {}};
  const Evaluation features =
      evaluate(dataset, cup, make_stations(test::host(), pipeline, cup), test::host(), test::context());
  EXPECT_FALSE(features.right(features.meshes[0]));
  EXPECT_THAT(features.meshes[0].error, HasSubstr("box: no truth"));
  dataset.by_class = true;
  const Evaluation classes =
      evaluate(dataset, fitting, make_stations(test::host(), pipeline, fitting), test::host(), test::context());
  EXPECT_FALSE(classes.right(classes.meshes[0]));
  EXPECT_THAT(classes.meshes[0].error, HasSubstr("box: its class is not known"));
}

/// Of generated objects, end to end; the numbers are the same side by side as one after the other.
TEST(Evaluation, OfAGeneratedCupAtAnyThreadCount) {
  const PluginCatalog& catalog = test::host().catalog();
  const std::filesystem::path source = TOPOSCOPE_SOURCE_DIR;
  const Model model = read_model(source / "models/cup.yaml", &catalog);
  const Stations stations =
      make_stations(test::host(), read_pipeline(source / "pipelines/default.yaml", catalog), model);
  Dataset dataset;
  dataset.name = "two";
  for (const bool scan : {false, true}) {
    MadeMesh made{.object = {.kind = "cup", .faces = 4000}};
    if (scan) made.scan = ScanSettings{.faces = 4000, .parts = false};
    const std::string name = scan ? "scan" : "exact";
    dataset.meshes.push_back({.name = name, .object = name, .variant = "", .source = made});
  }
  MadeMesh bad{.object = {.kind = "cup", .faces = 4000}};
  bad.object.parameters["wall"] = -1;
  dataset.meshes.push_back({.name = "bad", .object = "exact", .variant = "", .source = bad});
  const auto run = [&](unsigned threads) {
    Evaluation evaluation = evaluate(dataset, model, stations, test::host(), test::context(threads));
    evaluation.seconds = 0;
    for (MeshEvaluation& mesh : evaluation.meshes) mesh.time_ms = 0;
    return evaluation;
  };
  const Evaluation one = run(1);
  EXPECT_TRUE(one.meshes[0].features_right()) << to_text(tables(one));
  EXPECT_TRUE(one.meshes[1].features_right()) << to_text(tables(one));
  EXPECT_THAT(one.meshes[2].error, HasSubstr("wall"));
  EXPECT_FALSE(one.right(one.meshes[2])) << "what could not be made counts as missed";
  EXPECT_EQ(to_json({run(2)}), to_json({one}));
}

}  // namespace
}  // namespace toposcope
