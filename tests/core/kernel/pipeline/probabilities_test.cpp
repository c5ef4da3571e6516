// SPDX-License-Identifier: BSD-3-Clause

// Where the probabilities of a result come from.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "result/classification.h"
#include "support/program.h"

namespace toposcope {
namespace {

using nlohmann::json;
using ::testing::StartsWith;

constexpr double none = std::numeric_limits<double>::quiet_NaN();

Result result_of(const std::string& name, double log_evidence, double least_cost) {
  Result result;
  result.mesh_path = "m";
  result.model = name;
  result.classes.push_back({name, log_evidence, least_cost, 0.5, true});
  return result;
}

TEST(Classify, ComparesTheClassesOfSeveralModels) {
  const Classification summed = classify({result_of("a", 5, -4), result_of("b", 4, -9)});
  EXPECT_EQ(summed.class_name, "a");
  EXPECT_NEAR(summed.probabilities[0].second, std::exp(5) / (std::exp(5) + std::exp(4) + 1), 1e-15);
  EXPECT_EQ(summed.probabilities.back().first, "none");
  const Classification costs = classify({result_of("a", 5, -4), result_of("b", none, -9)});
  EXPECT_EQ(costs.class_name, "b");
  EXPECT_NEAR(costs.probabilities[1].second, std::exp(9) / (std::exp(9) + std::exp(4) + 1), 1e-15);
  EXPECT_EQ(classify({result_of("a", none, 3)}).class_name, "");
}

struct ProbabilitiesOfARun : ::testing::Test {
  ProbabilitiesOfARun() {
    EXPECT_EQ(test::toposcope("sample cup --faces 5000 -o " + (folder / "cup.ply").string()).exit_code, 0);
  }
  json run(const std::string& arguments) const {
    const test::Outcome outcome = test::toposcope("run " + (folder / "cup.ply").string() + " --json " + arguments);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return json::parse(outcome.out);
  }
  test::TemporaryFolder folder;
};

double probability_of(const json& feature) {
  return feature[feature["present"] ? "probability" : "probability_missing"].get<double>();
}

TEST_F(ProbabilitiesOfARun, ComeFromTheMarginals) {
  const json made = run("--model cup --set marginals.tolerance=1e-9");
  EXPECT_THAT(made["probabilities"].get<std::string>(), StartsWith("posterior: exact"));
  EXPECT_TRUE(made["timings_ms"].contains("label") && made["timings_ms"].contains("marginals"));
  bool listed = false;
  for (const json& plugin : made["plugins"])
    listed =
        listed || (plugin["id"] == "posterior" && std::stod(plugin["options"]["tolerance"].get<std::string>()) == 1e-9);
  EXPECT_TRUE(listed) << made["plugins"].dump(1);

  // Elimination knows nothing of search, and finds the same.
  const json eliminated = run("--model cup --set probability.max_candidates=20 --set marginals.method=elimination");
  const json searched = run("--model cup --set probability.max_candidates=20 --set marginals.method=search");
  EXPECT_NE(eliminated["probabilities"], searched["probabilities"]);
  EXPECT_NEAR(eliminated["log_evidence"].get<double>(), searched["log_evidence"].get<double>(), 1e-9);
  for (const auto& [name, feature] : searched["features"].items())
    EXPECT_NEAR(probability_of(feature), probability_of(eliminated["features"][name]), 1e-9) << name;
  EXPECT_EQ(eliminated["guarantee"], searched["guarantee"]) << "of the labelling, as before";
}

TEST_F(ProbabilitiesOfARun, WithoutMarginalsAreTheLabelersOrNone) {
  const json made = run("--model neal-1999/cup --pipeline neal-1999");
  EXPECT_FALSE(made["timings_ms"].contains("marginals"));
  EXPECT_TRUE(made["probabilities"].is_null());
  EXPECT_TRUE(made["log_evidence"].is_null());
  for (const auto& [name, feature] : made["features"].items())
    EXPECT_TRUE(feature[feature["present"] ? "probability" : "probability_missing"].is_null()) << name;
  for (const json& alternative : made["alternatives"]) EXPECT_TRUE(alternative["probability"].is_null());
  double sum = 0;
  for (const json& p : made["class_probabilities"]) sum += p.get<double>();
  EXPECT_GE(sum, 0);
  EXPECT_LE(sum, 1 + 1e-12);
}

}  // namespace
}  // namespace toposcope
