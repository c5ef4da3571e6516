// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/solve.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <memory>
#include <stdexcept>

#include "base/errors.h"
#include "support/plugins.h"
#include "toposcope/labeling/tools.h"

namespace toposcope {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr double none = std::numeric_limits<double>::quiet_NaN();

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

TEST_F(Contract, SumsAreTakenWithWhatIsPromisedOfThem) {
  LabelingOutcome sums;
  sums.posteriors = {{0.25, 0.5, 0.25}, {0, 1}};
  sums.posterior_exactness = Exactness::bound;
  sums.posterior_error = 1e-3;
  sums.log_evidence = -2;
  sums.evidence_exactness = Exactness::approximate;
  sums.evidence_error = 0.5;
  take_sums(sums, outcome);
  EXPECT_EQ(refusal(), "");
  EXPECT_EQ(outcome.posteriors[1][1], 1);
  EXPECT_EQ(outcome.posterior_exactness, Exactness::bound);
  EXPECT_EQ(outcome.posterior_error, 1e-3);
  EXPECT_EQ(outcome.log_evidence, -2);
  EXPECT_EQ(outcome.evidence_exactness, Exactness::approximate);
  EXPECT_EQ(outcome.evidence_error, 0.5);
  EXPECT_EQ(outcome.labelings.size(), 2U) << "and nothing else";
}

TEST_F(Contract, ABoundAboveACost) {
  outcome.lower_bound = 1.001;
  EXPECT_THAT(refusal(), AllOf(HasSubstr("odd"), HasSubstr("1.001"), HasSubstr("1.000")));
  outcome.lower_bound = 1 + 1e-13;  // rounding
  EXPECT_EQ(refusal(), "");
  outcome.lower_bound = none;
  EXPECT_NE(refusal(), "");
}

TEST_F(Contract, LabellingsThatAreNone) {
  outcome.labelings[1].values = {1};
  EXPECT_THAT(refusal(), HasSubstr("1 values for 2 variables"));
  outcome.labelings[1].values = {1, 2};
  EXPECT_THAT(refusal(), AllOf(HasSubstr("'bottom'"), HasSubstr("2 of 2")));
  outcome.labelings.clear();
  EXPECT_THAT(refusal(), HasSubstr("no labelling"));
  problem.variables[0].optional = false;
  EXPECT_EQ(refusal(), "") << "there may be none";
}

TEST_F(Contract, FeaturesThatShareAVertex) {
  problem.variables[0].candidates = {0, 1};
  problem.variables[1].candidates = {1};
  problem.candidate_count = 2;
  problem.conflict_bits = {0b01, 0b10};
  EXPECT_EQ(refusal(), "");
  outcome.labelings[1] = {{2, 1}, 8};
  EXPECT_THAT(refusal(), HasSubstr("share a vertex"));
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

struct GivenLabeler final : Labeler {
  explicit GivenLabeler(std::function<LabelingOutcome()> gives) : give(std::move(gives)) {}
  LabelingOutcome solve(const LabelingProblem&, const LabelingRequest&, Context&) const override { return give(); }
  std::function<LabelingOutcome()> give;
};

TEST_F(Contract, SolvingIsCheckedAndGuarded) {
  const auto solved = [&](std::function<LabelingOutcome()> give) {
    return solve({"odd", std::make_shared<GivenLabeler>(std::move(give))}, problem, {}, test::context());
  };
  EXPECT_EQ(solved([&] { return outcome; }).labelings[1].cost, 2);
  const auto refused = [&](const std::function<LabelingOutcome()>& give) -> std::string {
    try {
      solved(give);
    } catch (const PluginError& error) {
      return error.what();
    }
    return "none";
  };
  EXPECT_THAT(refused([]() -> LabelingOutcome { throw std::runtime_error("lost"); }),
              AllOf(HasSubstr("'odd'"), HasSubstr("lost")));
  EXPECT_THAT(refused([] { return LabelingOutcome{}; }), AllOf(HasSubstr("'odd'"), HasSubstr("no labelling")));
}

}  // namespace
}  // namespace toposcope
