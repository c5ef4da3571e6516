// SPDX-License-Identifier: BSD-3-Clause
// The documents of the index, of comparisons and evaluations made by hand.

#include "index/index_document.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/study/compare/comparisons_by_hand.h"
#include "support/schemas.h"

namespace toposcope {
namespace {

using nlohmann::json;

TEST(ComparisonIndex, HasTotalsEntriesAndVerdicts) {
  const std::string text = comparison_index(test::comparisons_by_hand(), {{"", "a/report.html"}, {"PNG", ""}}, {}, "t");
  EXPECT_EQ(test::schema_faults("index", text), "");
  const json index = json::parse(text);
  EXPECT_EQ(index["title"], "Labelers side by side");
  const json& labelers = index["tables"][0];
  EXPECT_EQ(labelers["columns"][4], (json{{"name", "mean gap"}, {"unit", "nats"}, {"kind", "number"}}));
  EXPECT_EQ(labelers["rows"][0], (json{"exact", 2, 2, 0, 0.0, 0.0, 0.5, 3.0, 4.0, 30, 3, 4, 0.75}));
  EXPECT_TRUE(labelers["rows"][1][6].is_null()) << "no posterior";
  const json& entries = index["tables"][1];
  ASSERT_EQ(entries["rows"].size(), 4U);
  EXPECT_EQ(entries["rows"][0], (json{"a.ply", "exact", "cup", 1.5, 1.5, 0.0, "yes", 0.5, 2.0, 10, 2, 2, "optimal"}));
  EXPECT_EQ(entries["rows"][3][0], "b.ply") << "without its folder";
  EXPECT_TRUE(entries["rows"][3][3].is_null()) << "an infinite cost";
  EXPECT_EQ(index["meshes"][0]["verdicts"], (json{{"exact", "right"}, {"quick:sweeps=a,b", "wrong"}}));
  EXPECT_EQ(index["meshes"][0]["report"], "a/report.html");
  EXPECT_TRUE(index["meshes"][0]["thumbnail"].is_null());
  EXPECT_EQ(index["meshes"][1]["thumbnail"], "data:image/png;base64,UE5H");
  const std::string one = comparison_index({test::comparisons_by_hand()[1]}, {{}}, {}, "t");
  EXPECT_EQ(json::parse(one)["title"], "Labelers side by side · b.ply");
}

/// A cup with its rim a mean edge off and no handle, and a mesh that could not be read.
Evaluation by_hand() {
  Evaluation evaluation;
  evaluation.dataset = "hand";
  evaluation.model = "cup";
  evaluation.meshes.resize(2);
  MeshEvaluation& good = evaluation.meshes[0];
  good.name = "good";
  good.faces = 5000;
  good.time_ms = 7;
  good.judgement = {{{"rim", Verdict::right, 2, 0.4, 0.9}, {"handle", Verdict::absent, std::nan(""), 0, 0.75}}, 2, 100};
  MeshEvaluation& bad = evaluation.meshes[1];
  bad.name = "bad";
  bad.error = "no such file";
  bad.judgement.features = {{"rim", Verdict::missed}, {"handle", Verdict::missed}};
  return evaluation;
}

const json& table(const json& index, const std::string& id) {
  for (const json& each : index["tables"])
    if (each["id"] == id) return each;
  throw std::out_of_range(id);
}

TEST(EvaluationIndex, HasTablesOfSetsFeaturesAndMeshes) {
  const std::string text = evaluation_index({by_hand()}, {{{"", "good/report.html"}, {}}}, "t");
  EXPECT_EQ(test::schema_faults("index", text), "");
  const json index = json::parse(text);
  EXPECT_EQ(index["title"], "Evaluation · hand");
  EXPECT_EQ(table(index, "datasets")["rows"][0],
            (json{"hand", "cup", 2, 1, 0.5, 2, 4, 0.5, 1.0, 1.0, index["reliability"][0]["ece"], 7.0}));
  const json& features = table(index, "hand-features");
  ASSERT_EQ(features["rows"].size(), 3U) << "the last is of all";
  EXPECT_EQ(features["rows"][0], (json{"rim", 1, 2, 0.5, 0, 1, 0, 0, 1.0, 1.0, 0.02}));
  EXPECT_TRUE(features["rows"][1][8].is_null()) << "nothing was measured of the handle";
  const json& meshes = table(index, "hand-meshes");
  EXPECT_EQ(meshes["rows"][0], (json{"good", 5000, "right", "absent", 1.0, 0.75, 7.0, nullptr}));
  EXPECT_EQ(meshes["rows"][1], (json{"bad", 0, "missed", "missed", nullptr, 0.0, nullptr, "no such file"}));
  EXPECT_EQ(meshes["links"], (json{"good/report.html", nullptr}));
  EXPECT_FALSE(index.contains("confusion"));
}

TEST(EvaluationIndex, OfClassesHasAConfusion) {
  Evaluation evaluation = by_hand();
  evaluation.by_class = true;
  evaluation.meshes[0].expected_class = evaluation.meshes[1].expected_class = "tee";
  evaluation.meshes[0].found_class = "wye";
  evaluation.meshes[0].class_probability = 0.6;
  const std::string text = evaluation_index({evaluation}, {{{}, {}}}, "t");
  EXPECT_EQ(test::schema_faults("index", text), "");
  const json index = json::parse(text);
  EXPECT_EQ(index["confusion"]["classes"], json::array({"tee"}));
  EXPECT_EQ(index["confusion"]["answers"], (json{"tee", "unknown", "wye"}));
  EXPECT_EQ(index["confusion"]["counts"], json::array({json::array({0, 1, 1})}));
  const json& row = table(index, "hand-meshes")["rows"][0];
  EXPECT_EQ(row[2], "tee");
  EXPECT_EQ(row[3], "wye");
  EXPECT_EQ(row[4], 0.6);
  EXPECT_TRUE(table(index, "hand-meshes")["rows"][1][3].is_null()) << "nothing was found";
  EXPECT_EQ(index["meshes"][0]["verdicts"]["class"], "wrong");
  EXPECT_EQ(index["meshes"][0]["probability"], 0.6);
}

}  // namespace
}  // namespace toposcope
