// SPDX-License-Identifier: BSD-3-Clause

// Where the probabilities of a result come from, what is refused of them, and what classes are compared by.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "base/errors.h"
#include "pipeline/labeling_problem.h"
#include "result/classification.h"
#include "support/program.h"
#include "toposcope/labeling/tools.h"

namespace toposcope {
namespace {

using nlohmann::json;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr double none = std::numeric_limits<double>::quiet_NaN();

TEST(ClassEvidence, IsTheEvidenceWhereAllHaveOne) {
  const auto evidence = comparable_evidence({{3, -10}, {-forbidden, 20}, {1, -30}});
  EXPECT_EQ(evidence, (std::vector<double>{3, -forbidden, 1}));
  const auto p = class_probabilities(evidence);
  const double sum = std::exp(3) + std::exp(1) + 1;
  ASSERT_EQ(p.size(), 4);
  EXPECT_NEAR(p[0], std::exp(3) / sum, 1e-15);
  EXPECT_EQ(p[1], 0);
  EXPECT_NEAR(p[3], 1 / sum, 1e-15);
}

TEST(ClassEvidence, IsTheBestLabellingsCostWhereOneHasNone) {
  EXPECT_EQ(comparable_evidence({{3, -10}, {none, 20}}), (std::vector<double>{10, -20}));
  EXPECT_EQ(comparable_evidence({{none, forbidden}}), (std::vector<double>{-forbidden}));
  EXPECT_EQ(class_probabilities({-forbidden}), (std::vector<double>{0, 1}));
  // Thousands of nats neither overflow nor vanish.
  EXPECT_EQ(class_probabilities({5000, 4000}), (std::vector<double>{1, 0, 0}));
}

Result result_of(const std::string& name, double log_evidence, double least_cost) {
  Result result;
  result.mesh_path = "m";
  result.model = name;
  result.classes.push_back({name, log_evidence, least_cost, 0.5, true});
  return result;
}

TEST(ClassEvidence, OfSeveralModels) {
  const Classification summed = classify({result_of("a", 5, -4), result_of("b", 4, -9)});
  EXPECT_EQ(summed.class_name, "a");
  EXPECT_NEAR(summed.probabilities[0].second, std::exp(5) / (std::exp(5) + std::exp(4) + 1), 1e-15);
  EXPECT_EQ(summed.probabilities.back().first, "none");
  const Classification costs = classify({result_of("a", 5, -4), result_of("b", none, -9)});
  EXPECT_EQ(costs.class_name, "b");
  EXPECT_NEAR(costs.probabilities[1].second, std::exp(9) / (std::exp(9) + std::exp(4) + 1), 1e-15);
  EXPECT_EQ(classify({result_of("a", none, 3)}).class_name, "");
}

/// A problem of two variables and an outcome of it that keeps the contract.
struct Contract : ::testing::Test {
  Contract() {
    problem.variables.push_back({.name = "rim", .costs = {1, 2, 3}});
    problem.variables.push_back({.name = "bottom", .costs = {0, 5}});
    outcome.labelings = {{{0, 0}, 1}, {{1, 0}, 2}};
    outcome.lower_bound = 1;
    outcome.posteriors = {{0.5, 0.25, 0.25}, {1, 0}};
    outcome.posterior_exactness = Exactness::exact;
  }
  std::string refusal() const {
    try {
      check_outcome(problem, outcome, "odd");
      return "";
    } catch (const PluginError& error) {
      return error.what();
    }
  }
  LabelingProblem problem;
  LabelingOutcome outcome;
};

TEST_F(Contract, KeptIsNotRefused) {
  EXPECT_EQ(refusal(), "");
  outcome.lower_bound = -forbidden;
  outcome.posteriors.clear();
  outcome.posterior_exactness = Exactness::none;
  EXPECT_EQ(refusal(), "");
}

TEST_F(Contract, SumsSayWhetherTheyAreExact) {
  outcome.posterior_exactness = Exactness::none;
  EXPECT_THAT(refusal(), HasSubstr("posteriors"));
  outcome.posterior_exactness = Exactness::approximate;
  EXPECT_EQ(refusal(), "");
  outcome.log_evidence = -1;
  EXPECT_THAT(refusal(), HasSubstr("evidence"));
  outcome.evidence_exactness = Exactness::bound;
  EXPECT_EQ(refusal(), "");
  outcome.log_evidence = none;
  EXPECT_THAT(refusal(), HasSubstr("evidence"));
}

TEST_F(Contract, ABoundAboveACost) {
  outcome.lower_bound = 1.001;
  EXPECT_THAT(refusal(), AllOf(HasSubstr("odd"), HasSubstr("1.001"), HasSubstr("1.000")));
  outcome.lower_bound = 1 + 1e-13;  // rounding
  EXPECT_EQ(refusal(), "");
  outcome.lower_bound = none;
  EXPECT_NE(refusal(), "");
}

TEST_F(Contract, ProbabilitiesThatAreNone) {
  outcome.posteriors[0] = {0.5, 0.25, 0.24};
  EXPECT_THAT(refusal(), AllOf(HasSubstr("'rim'"), HasSubstr("0.99"), HasSubstr("not to 1")));
  outcome.posteriors[0] = {1.5, -0.25, -0.25};
  EXPECT_THAT(refusal(), HasSubstr("not from 0 to 1"));
  outcome.posteriors[0] = {none, 0.5, 0.5};
  EXPECT_NE(refusal(), "");
  outcome.posteriors[0] = {0.5, 0.5};
  EXPECT_THAT(refusal(), HasSubstr("domains"));
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
