// SPDX-License-Identifier: BSD-3-Clause
// Labelling problems written and read back, the development instances with their proven optima, and broken files.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>

#include "base/errors.h"
#include "problem/problem_builder.h"
#include "problem/problem_formats.h"
#include "support/labeling_problems.h"
#include "support/plugins.h"
#include "toposcope/labeling_tools.h"

namespace {

using namespace toposcope;
using testing::HasSubstr;

std::string refusal(const std::function<void()>& read) {
  try {
    read();
  } catch (const UsageError& error) {
    return error.what();
  }
  return "";
}

TEST(ProblemFiles, JsonLosesNothing) {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const LabelingProblem problem = test::random_problem(test::random_kind(seed), seed);
    const LabelingProblem back = read_problem_json("x.json", problem_json(problem)).problem;
    EXPECT_EQ(problem_json(back), problem_json(problem));
    ASSERT_EQ(test::all_labelings(back).size(), test::all_labelings(problem).size());
  }
}

// Every labelling costs what it did, to the digits that the format has.
TEST(ProblemFiles, OtherFormatsKeepEveryLabellingsCost) {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    test::RandomKind kind = test::random_kind(seed);
    kind.ties = true;  // whole quarters: two decimals
    const LabelingProblem problem = test::random_problem(kind, seed);
    bool possible = true;  // a value without which nothing is possible has no factor
    for (const LabelingConstraint& constraint : problem.constraints)
      possible = possible && *std::min_element(constraint.costs.begin(), constraint.costs.end()) < forbidden;
    for (const LabelingVariable& variable : problem.variables)
      possible = possible && *std::min_element(variable.costs.begin(), variable.costs.end()) < forbidden;
    if (!possible) continue;
    const auto all = test::all_labelings(problem);
    const auto compare = [&](const ProblemFile& file, double factor, bool shifted, const char* format) {
      const auto back = test::all_labelings(file.problem);
      ASSERT_EQ(back.size(), all.size()) << format << ", " << seed;
      for (std::size_t k = 0; k < all.size(); ++k) {
        const double shift = shifted ? back[0].cost - all[0].cost * factor : 0;
        EXPECT_NEAR(back[k].cost - shift, all[k].cost * factor, 1e-6 * factor) << format << ", " << seed;
      }
    };
    compare(read_cfn("x.cfn", cfn_text(problem)), 1, false, "cfn");
    compare(read_uai("x.uai", uai_text(problem), {}), 1, false, "uai");
    const ProblemFile wcsp = read_wcsp("x.wcsp", wcsp_text(problem));
    const auto back = test::all_labelings(wcsp.problem);
    if (back.size() > 1 && all.back().cost > all[0].cost)
      compare(wcsp, std::round((back.back().cost - back[0].cost) / (all.back().cost - all[0].cost)), true, "wcsp");
  }
}

TEST(ProblemFiles, DevelopmentInstancesHaveTheirProvenOptima) {
  const std::filesystem::path folder = std::filesystem::path(TOPOSCOPE_SOURCE_DIR) / "../shared/data/wcsp";
  std::ifstream table(folder / "optima.tsv");
  if (!table) GTEST_SKIP() << "SKIPPED: no ../shared/data/wcsp here";
  std::string name, optimum;
  std::getline(table, name);
  for (std::string line; std::getline(table, line);) {
    const std::size_t tab = line.find('\t');
    const ProblemFile file = read_problem(folder / line.substr(0, tab));
    const LabelingOutcome outcome =
        test::labeler("least-error")->solve(file.problem, {.k_best = 1, .time_limit_s = 100}, test::context());
    EXPECT_TRUE(outcome.optimal) << line;
    ASSERT_EQ(outcome.labelings.size(), 1U) << line;
    EXPECT_NEAR(outcome.labelings[0].cost, std::atof(line.c_str() + tab + 1), 1e-4) << line;
  }
}

TEST(ProblemFiles, GlobalFunctions) {
  const auto cost = [](const std::string& name, const GlobalArguments& given, std::vector<Index> tuple) {
    std::vector<Index> scope(tuple.size());
    const GlobalFunction global = global_function(name, scope, given, 1000);
    EXPECT_TRUE(global.cost) << name << global.why;
    return global.cost ? global.cost(tuple) : -1;
  };
  EXPECT_EQ(cost("salldiff", {"var", 2}, {1, 1, 1, 3}), 4);               // two must change
  EXPECT_EQ(cost("salldiff", {"dec", 2}, {1, 1}), 2);                     // a pair
  EXPECT_EQ(cost("sgcc", {"var", 3, {0, 1, 1, 1, 0, 1}}, {1, 1, 1}), 6);  // two too many, one too few
  EXPECT_EQ(cost("sgcc", {"dec", 3, {0, 1, 1, 1, 0, 1}}, {1, 1, 1}), 9);
  EXPECT_EQ(cost("samong", {"var", 5, {1, 2, 7, 8}}, {7, 8, 7, 1}), 5);
  EXPECT_EQ(cost("wamong", {"quad", 5, {0, 1, 7, 8}}, {7, 8, 7, 1}), 20);
  EXPECT_EQ(cost("wamong", {"hard", 5, {0, 1, 7, 8}}, {7, 8, 7, 1}), 1000);
  EXPECT_EQ(cost("max", {"", 0, {3, 0, 0, 4, 1, 2, 1}}, {0, 2}), 4);
  EXPECT_EQ(cost("max", {"", 0, {3, 0, 0, 4, 1, 2, 1}}, {1, 2}), 3);
  EXPECT_EQ(cost("ssame", {"", 2, {0, 1, 2, 3}}, {1, 2, 2, 3}), 2);
  EXPECT_EQ(cost("sregular", {"var", 2, {2, 1, 0, 1, 1, 2, 0, 0, 1, 1, 1, 0}}, {0, 1, 0}), 0);  // 0 1 0 ...
  EXPECT_EQ(cost("sregular", {"var", 2, {2, 1, 0, 1, 1, 2, 0, 0, 1, 1, 1, 0}}, {0, 0, 0}), 2);
  EXPECT_EQ(cost("knapsack", {"", 0, {5, 2, 3}}, {1, 1}), 0);
  EXPECT_EQ(cost("knapsack", {"", 0, {5, 2, 3}}, {0, 1}), 1000);
  EXPECT_EQ(cost(">=", {"", 0, {2, 3}}, {1, 1}), 2);
  EXPECT_EQ(cost(">=", {"", 0, {2, 1}}, {1, 1}), 1000);
  EXPECT_EQ(cost("sdisj", {"", 0, {3, 4, 9, 9, 10, 20}}, {5, 1}), 0);
  EXPECT_EQ(cost("sdisj", {"", 0, {3, 4, 9, 9, 10, 20}}, {5, 3}), 1000);
  EXPECT_EQ(cost("sdisj", {"", 0, {3, 4, 9, 9, 10, 20}}, {9, 9}), 30);
}

TEST(ProblemFiles, RefusalsNameThePlaceAndTheRemedy) {
  EXPECT_THAT(refusal([] { read_wcsp("a.wcsp", "p 1 2 1 10\n2\n1 0 0 1\n"); }), HasSubstr("a.wcsp:"));
  EXPECT_THAT(refusal([] { read_wcsp("a.wcsp", "p 1 2 1 10\n2\n1 5 0 0\n"); }),
              HasSubstr("a.wcsp:3: a variable of a function must be a whole number from 0 to 0"));
  EXPECT_THAT(refusal([] { read_wcsp("a.wcsp", "p 2 2 1 10\n2 2\n2 0 1 -1 smst hard 5\n"); }),
              HasSubstr("a.wcsp:3: the global function 'smst' is not supported"));
  EXPECT_THAT(refusal([] { read_cfn("a.cfn", "{problem {name x mustbe >3}\nvariables {} functions {}}"); }),
              HasSubstr("a.cfn:1: 'mustbe: >3': only '<' is supported"));
  EXPECT_THAT(refusal([] {
                read_cfn("a.cfn",
                         "{problem {name x mustbe <3}\nvariables {a 2}\nfunctions {f {scope [b] costs [0 1]}}}");
              }),
              HasSubstr("a.cfn:3: 'b' is no variable of the problem"));
  EXPECT_THAT(refusal([] { read_cfn("a.cfn", "{problem {name x mustbe <3}"); }), HasSubstr("cut short"));
  EXPECT_THAT(refusal([] { read_uai("a.uai", "MARKOV\n1\n2\n1\n1 0\n\n3\n1 1 1", {}); }),
              HasSubstr("factor 0 must have 2 entries"));
  EXPECT_THAT(refusal([] { read_problem_json("a.json", "{}"); }), HasSubstr("toposcope.problem/1"));
  EXPECT_THAT(refusal([] { read_problem_json("a.json", "{"); }), HasSubstr("a.json"));
  EXPECT_THAT(refusal([] { read_problem("a.txt"); }), HasSubstr("known are .json, .cfn, .wcsp and .uai"));
}

}  // namespace
