// SPDX-License-Identifier: BSD-3-Clause
// Labelling problems on the command line: `label`, `run --save-problem`, `compare`.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "support/program.h"

namespace toposcope::test {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::StartsWith;
namespace fs = std::filesystem;

/// Two variables that want the same value, which only one may have: the optimum is 3, the next 4.
constexpr const char* small_problem = R"({
  problem: {name: pair, mustbe: <100},
  variables: {x: [red, green], y: [red, green]},
  functions: {
    fx: {scope: [x], costs: [0, 3]},
    fy: {scope: [y], costs: [0, 4]},
    differ: {scope: [x, y], defaultcost: 0, costs: [0, 0, 100, 1, 1, 100]}
  }
})";

class LabelCommand : public ::testing::Test {
 protected:
  std::string file(const std::string& name, const std::string& text) {
    write_text(folder_ / name, text);
    return (folder_ / name).string();
  }
  TemporaryFolder folder_;
};

TEST_F(LabelCommand, PrintsTheLabellingAndItsProof) {
  const std::string problem = file("pair.cfn", small_problem);
  const Outcome outcome = toposcope("label " + problem + " --k-best 2");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("green"));
  EXPECT_THAT(outcome.out, HasSubstr("cost         3\n"));
  EXPECT_THAT(outcome.out, HasSubstr("next best    4: red green"));
  EXPECT_THAT(outcome.out, HasSubstr("least cost: proven"));
}

TEST_F(LabelCommand, PrintsJsonForPrograms) {
  const json result = json::parse(toposcope("label --json --marginals " + file("pair.cfn", small_problem)).out);
  EXPECT_EQ(result["labeling"], json({{"x", "green"}, {"y", "red"}}));
  EXPECT_EQ(result["cost"], 3);
  EXPECT_EQ(result["lower_bound"], 3);
  EXPECT_EQ(result["optimal"], true);
  EXPECT_EQ(result["satisfiable"], true);
  const double red = result["posteriors"]["x"][0], green = result["posteriors"]["x"][1];
  EXPECT_NEAR(green / red, std::exp(1.0), 1e-9) << "costs 3 and 4 are nats";
  EXPECT_TRUE(result["nodes"].is_number());
  EXPECT_TRUE(result["time_ms"].is_number());
}

TEST_F(LabelCommand, NoLabellingIsAnAnswer) {
  const Outcome outcome = toposcope("label " + file("none.wcsp", "none 1 2 1 10\n2\n1 0 10 0\n"));
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("no labelling is allowed"));
}

TEST_F(LabelCommand, ConvertsBetweenFormatsWithTheSameOptimum) {
  const std::string problem = file("pair.cfn", small_problem);
  for (const char* extension : {"json", "cfn", "wcsp", "uai"}) {
    const std::string written = (folder_ / (std::string("copy.") + extension)).string();
    ASSERT_EQ(toposcope("label " + problem + " --save-problem " + written).exit_code, 0) << extension;
    const json result = json::parse(toposcope("label --json " + written).out);
    EXPECT_NEAR(result["cost"].get<double>(), 3, 1e-9) << extension;
  }
}

TEST_F(LabelCommand, BadUsageAndBadFilesNameThePlaceAndTheRemedy) {
  const std::string problem = file("pair.cfn", small_problem);
  const std::pair<std::string, const char*> bad[] = {
      {"label absent.cfn", "absent.cfn"},
      {"label " + file("broken.cfn", "{problem: {name: x"), "broken.cfn:1:"},
      {"label " + file("unknown.wcsp", "x 1 2 1 10\n2\n1 0 -1 frobnicate\n"), "frobnicate"},
      {"label " + file("notes.txt", "hello"), ".cfn"},
      {"label " + problem + " --save-problem out.xml", ".cfn"},
      {"label " + problem + " --labeler least-eror", "least-error"},
      {"label " + problem + " --set labeler.nonsense=1", "nonsense"},
      {"label " + problem + " --set worksets.growth=1", "labeler.option=value"},
      {"label " + problem + " --k-best 0", "k-best"},
  };
  for (const auto& [arguments, remedy] : bad) {
    const Outcome outcome = toposcope(arguments);
    EXPECT_EQ(outcome.exit_code, 2) << arguments;
    EXPECT_THAT(outcome.err, HasSubstr(remedy)) << arguments;
    EXPECT_EQ(outcome.out, "") << arguments;
  }
}

// ---- with meshes ----

class ProblemsOfMeshes : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new TemporaryFolder;
    ASSERT_EQ(toposcope("sample cup --faces 4000 -o " + path("cup.ply")).exit_code, 0);
    ASSERT_EQ(toposcope("sample tee --faces 4000 -o " + path("tee.ply")).exit_code, 0);
  }
  static void TearDownTestSuite() { delete folder_; }
  static std::string path(const std::string& name) { return (*folder_ / name).string(); }

 private:
  static TemporaryFolder* folder_;
};
TemporaryFolder* ProblemsOfMeshes::folder_ = nullptr;

TEST_F(ProblemsOfMeshes, ASavedProblemHasTheRunsOptimum) {
  ASSERT_EQ(toposcope("run " + path("cup.ply") + " --model cup -q --save-problem " + path("cup.json")).exit_code, 0);
  const json label = json::parse(toposcope("label --json --marginals " + path("cup.json")).out);
  const json run = json::parse(toposcope("run --json --model cup " + path("cup.ply")).out);
  EXPECT_TRUE(label["optimal"]);
  EXPECT_NEAR(label["log_evidence"].get<double>(), run["log_evidence"].get<double>(), 1e-9);
  for (const auto& [name, feature] : run["features"].items()) EXPECT_NE(label["labeling"][name], "missing") << name;
}

TEST_F(ProblemsOfMeshes, AModelWithClassesSavesOneForEach) {
  ASSERT_EQ(
      toposcope("run " + path("tee.ply") + " --model pipe-fitting -q --save-problem " + path("tee.cfn")).exit_code, 0);
  for (const char* name : {"tee-wye.cfn", "tee-cross.cfn", "tee-elbow.cfn", "tee-tricorner.cfn", "tee-tee.cfn"})
    EXPECT_TRUE(fs::exists(path(name))) << name;
  EXPECT_FALSE(fs::exists(path("tee.cfn")));
}

TEST_F(ProblemsOfMeshes, SeveralMeshesHaveNoOneProblem) {
  const Outcome outcome =
      toposcope("run " + path("cup.ply") + " " + path("tee.ply") + " --model cup --save-problem x.json");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("one by one"));
}

TEST_F(ProblemsOfMeshes, LabelersAreComparedOnTheSameProblem) {
  const std::string arguments = "compare " + path("cup.ply") + " " + path("tee.ply") +
                                " --model cup --labelers least-error,backtracking,annealing:sweeps=50:runs=2";
  const Outcome outcome = toposcope(arguments);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  for (const char* word : {"cup.ply", "tee.ply", "all 2 meshes", "annealing:sweeps=50:runs=2", "gap", "posterior"})
    EXPECT_THAT(outcome.out, HasSubstr(word));

  const json result = json::parse(toposcope(arguments + " --json").out);
  EXPECT_EQ(result["schema"], "toposcope.comparison/1");
  ASSERT_EQ(result["meshes"].size(), 2U);
  const json& exact = result["meshes"][0]["labelers"][0];
  EXPECT_EQ(exact["labeler"], "least-error");
  EXPECT_TRUE(exact["proven"]);
  EXPECT_EQ(exact["right"], 4) << "the truth lies beside the mesh";
  EXPECT_EQ(exact["of"], 4);
  for (const json& mesh : result["meshes"])
    for (const json& entry : mesh["labelers"]) {
      EXPECT_GE(entry["cost"].get<double>(), mesh["labelers"][0]["cost"].get<double>() - 1e-9)
          << "the optimum is proven";
      EXPECT_LE(entry["posterior"].get<double>(), mesh["labelers"][0]["posterior"].get<double>() * (1 + 1e-9));
    }
  EXPECT_EQ(result["totals"].size(), 3U);

  const std::string csv = toposcope(arguments + " --csv").out;
  EXPECT_THAT(csv,
              StartsWith("mesh,labeler,class,labeling,cost,gap,proven,posterior,time_ms,nodes,right,of,guarantee\n"));
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 2 * 3 + 3);
  EXPECT_THAT(toposcope(arguments + " --markdown").out, HasSubstr("| `backtracking` |"));
}

TEST_F(ProblemsOfMeshes, BadComparisonsAreExplained) {
  const std::string head = "compare " + path("cup.ply") + " --model cup --labelers ";
  for (const auto& [labelers, words] :
       std::vector<std::pair<std::string, std::string>>{{"least-eror", "least-error"},
                                                        {"annealing:sweps=3", "sweeps"},
                                                        {"annealing:sweeps", "id:option=value"},
                                                        {"least-error,least-error", "given twice"},
                                                        {"''", "labeler"}}) {
    const Outcome outcome = toposcope(head + labelers);
    EXPECT_EQ(outcome.exit_code, 2) << labelers;
    EXPECT_THAT(outcome.err, HasSubstr(words)) << labelers;
    EXPECT_EQ(outcome.out, "") << labelers;
  }
}

}  // namespace
}  // namespace toposcope::test
