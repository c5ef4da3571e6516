// SPDX-License-Identifier: BSD-3-Clause
// What the formats of labelling problems may say.

#include "formats/problem_formats.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "support/labeling_problems.h"
#include "support/refusal.h"
#include "toposcope/labeling/tools.h"

namespace {

using namespace toposcope;
using test::refusal;
using testing::HasSubstr;

TEST(ProblemFiles, CfnWithAllItsFreedoms) {
  const char* tagged = R"({
# a comment
"problem": {"name": "p", "mustbe": "<20.5"},  // another
"variables": {"a": ["u", "v"], b: 3, 2, "c": -4},
"functions": {
  "f1": {"scope": ["a", "b"], "costs": "f2"},
  "f2": {scope: [3 1], "defaultcost": 1.5, costs: [2 0 -4 3 2 7.25]},
  {"scope": [a, b], "defaultcost": 0.5, "costs": ["v", 2, 3]},
  constant {scope [] costs [2]}
  g: {scope: [b c] type: "wsum" params: {metric: lin cost: 2 comparator: "<=" to: 3}}
}})";
  EXPECT_THAT(refusal([&] { read_cfn("x.cfn", tagged); }),
              HasSubstr("x.cfn:6:40: function 'f1' uses the costs of 'f2'"));
  std::string text = tagged;
  text.replace(text.find("[\"a\", \"b\"], \"costs\""), 10, "[\"c\", \"b\"]");
  const ProblemFile file = read_cfn("x.cfn", text);
  const LabelingProblem& p = file.problem;
  EXPECT_EQ(file.top, 20.5);
  ASSERT_EQ(p.variables.size(), 4U);
  EXPECT_EQ(p.variables[2].name, "2");
  EXPECT_EQ(p.variables[3].domain(), 4U);
  EXPECT_EQ(p.constant, 2);
  EXPECT_EQ(cost_of(p, std::vector<Index>{1, 2, 0, 3}), 2 + 2 * 7.25 + 3 + 2 * 2);
  EXPECT_EQ(cost_of(p, std::vector<Index>{0, 0, 0, 2}), 2 + 2 * -4 + 0.5 + 0);

  // Without the first tag there are none at all.
  const LabelingProblem plain = read_cfn("x.cfn",
                                         "{{p <20.5} {[u v] 3 4}\n{{[0 1] 0.5 [u 2 3]} {[1 2] [0 1 2 3 4 5 "
                                         "6 7 8 9 10 11]} f {[1] [1 2 3]} {[1 2] wsum [lin 2 <= 3]} {[] [2]}}}")
                                    .problem;
  ASSERT_EQ(plain.variables.size(), 3U);
  EXPECT_EQ(plain.variables[2].name, "2");
  EXPECT_EQ(cost_of(plain, std::vector<Index>{0, 2, 3}), 3 + 11 + 3 + 2 * 2 + 2);
  EXPECT_EQ(cost_of(plain, std::vector<Index>{1, 0, 1}), 0.5 + 1 + 1 + 0 + 2);
}

// What .cfn tags and groups, .wcsp has in a row: the same tables come of both.
TEST(ProblemFiles, ParametersOfBothFormatsMeanTheSame) {
  struct Case {
    const char *type, *cfn, *wcsp;
  };
  const Case cases[] = {
      {"<", "1 2", "1 2"},
      {"disj", "[1, 2, 9]", "1 2 9"},
      {"sdisj", "[1 2 2 2 4 5]", "1 2 2 2 4 5"},
      {"salldiff", "metric: var cost: 3", "var 3"},
      {"sgcc", "metric: var cost: 3 bounds: [[0 1 2][2 0 1]]", "var 3 2 0 1 2 2 0 1"},
      {"sgcc", "metric: wdec cost: 3 bounds: [[0 1 2 4 5]]", "wdec 3 1 0 1 2 4 5"},
      {"ssame", "cost: 3 vars1: [v0 v3] vars2: [1 v2]", "3 2 2 0 3 1 2"},
      {"sregular", "metric: var cost: 3 nb_states: 2 starts: [0] ends: [0 1] transitions: [[0 0 0][0 1 1][1 1 1]]",
       "var 3 2 1 0 2 0 1 3 0 0 0 0 1 1 1 1 1"},
      {"sgrammar",
       "metric: var cost: 3 nb_symbols: 4 nb_values: 2 start: 0 terminals: [[1 0][3 1]] "
       "non_terminals: [[0 0 0][0 1 2][0 1 3][2 0 3]]",
       "var 3 4 2 0 6 0 1 0 0 3 1 1 0 0 0 1 0 1 2 1 0 1 3 1 2 0 3"},
      {"sgrammardp",
       "metric: weight cost: 3 nb_symbols: 2 nb_values: 2 start: 0 terminals: [[1 0 2][1 1 5]] "
       "non_terminals: [[0 0 1 4][0 1 1 1]]",
       "weight 3 2 2 0 4 2 1 0 2 2 1 1 5 3 0 0 1 4 3 0 1 1 1"},
      {"samong", "metric: var cost: 3 min: 1 max: 2 values: [0 2]", "var 3 1 2 2 0 2"},
      {"salldiffdp", "metric: var cost: 3", "var 3"},
      {"smaxdp", "defaultcost: 3 tuples: [[v0 0 4] [1 1 3][2 2 2]]", "3 3 0 0 4 1 1 3 2 2 2"},
      {"clique", "rhs: 1 values: [[0] [1 2] [] [2]]", "1 1 0 2 1 2 0 1 2"},
      {"wregular", "nb_states: 2 starts: [[0 1]] ends: [[1 2]] transitions: [[0 0 1 3][1 2 1 4]]",
       "2 1 0 1 1 1 2 2 0 0 1 3 1 2 1 4"},
      {"wgcc", "metric: lin cost: 3 bounds: [[0 0 1][1 2 2]]", "lin 3 2 0 0 1 1 2 2"},
      {"wsame", "metric: lin cost: 3", "lin 3"},
      {"wsamegcc", "metric: lin cost: 3 bounds: [[0 0 1][1 0 1]]", "lin 3 2 0 0 1 1 0 1"},
      {"wamong", "metric: lin cost: 3 values: [0 1] min: 1 max: 2", "lin 3 2 0 1 1 2"},
      {"wvaramong", "metric: hard cost: 3 values: [1]", "hard 3 1 1"},
      {"woverlap", "metric: quad cost: 3 comparator: > to: 1", "quad 3 > 1"},
      {"wsum", "metric: lin cost: 3 comparator: \"<=\" to: 4", "lin 3 <= 4"},
      {"wvarsum", "metric: hard cost: 3 comparator: ==", "hard 3 =="},
      {"MST", "", ""},
      {"knapsackv", "capacity: 4 weightedvalues: [[v0 1 2][v1 2 3]]", "4 2 0 1 2 1 2 3"},
      {"wdiverse", "distance: 2 values: [0 1 2 0]", "2 0 1 2 0"},
  };
  for (const Case& each : cases) {
    const std::string type = each.type;
    const bool two = type == "<" || type == "disj" || type == "sdisj";
    const std::string parameters = each.cfn[0] == '[' ? each.cfn : "{" + std::string(each.cfn) + "}";
    const ProblemFile cfn = read_cfn(
        "x.cfn", "{problem {name p mustbe <100} variables {v0 3 v1 3 v2 3 v3 3} functions {f0 {scope [" +
                     std::string(two ? "v0 v1" : "v0 v1 v2 v3") + "] type: " + type + " params: " + parameters + "}}}");
    const ProblemFile wcsp = read_wcsp("x.wcsp", "p 4 3 1 100\n3 3 3 3\n" + std::string(two ? "2 0 1" : "4 0 1 2 3") +
                                                     " -1 " + type + " " + each.wcsp + "\n");
    ASSERT_EQ(cfn.problem.constraints.size(), wcsp.problem.constraints.size()) << type;
    ASSERT_FALSE(cfn.problem.constraints.empty()) << type;
    for (std::size_t c = 0; c < cfn.problem.constraints.size(); ++c)
      EXPECT_EQ(cfn.problem.constraints[c].costs, wcsp.problem.constraints[c].costs) << type;
  }
  const ProblemFile knapsack = read_cfn("x.cfn",
                                        "{problem {name p mustbe <100} variables {a 2 b 2} functions {f {scope [a b] "
                                        "type knapsack params {capacity: 2 weights: [1 -2]}}}}");
  EXPECT_EQ(knapsack.problem.constraints[0].costs, (std::vector<double>{forbidden, forbidden, forbidden, forbidden}));
}

TEST(ProblemFiles, TheTopBoundsTheSum) {
  // 5 + -3 < 4: not forbidden, though 5 alone is not below the bound.
  const ProblemFile negative = read_cfn("x.cfn",
                                        "{problem {name p mustbe <4} variables {a 2 b 2} functions {"
                                        "f {scope [a] costs [5 9]} g {scope [b] costs [-3 0]}}}");
  EXPECT_EQ(cost_of(negative.problem, std::vector<Index>{0, 0}), 2);
  EXPECT_EQ(cost_of(negative.problem, std::vector<Index>{1, 0}), forbidden);  // 9 - 3 is not below it
  const ProblemFile plain = read_wcsp("x.wcsp", "p 1 2 1 4\n2\n1 0 0 2 0 4 1 3\n");
  EXPECT_EQ(cost_of(plain.problem, std::vector<Index>{0}), forbidden);
  EXPECT_EQ(cost_of(plain.problem, std::vector<Index>{1}), 3);
}

// toulbar2's own example: 0.5 is the greatest value.
TEST(ProblemFiles, MaximisationIsMinimisationOfTheNegative) {
  const ProblemFile file = read_cfn("x.cfn", R"({problem: {name: m, mustbe: ">-5.0"}, variables: {v1: [a b] v2: [c d]},
    functions: {c0: {scope: [], costs: [-6.0]}, c1: {scope: [v1], costs: [1.0, 0.5]}, c2: {scope: [v2], costs: [1.0, 0.5]},
    c12: {scope: [v1 v2], costs: [-1.0, 0.5, -2.0, 5.5]}}})");
  EXPECT_TRUE(file.maximize);
  EXPECT_EQ(file.top, 5);
  EXPECT_EQ(test::all_labelings(file.problem)[0].cost, -0.5);
  EXPECT_THAT(refusal([] {
                read_cfn("x.cfn",
                         "{problem {name m mustbe >0} variables {a 2 b 2}\nfunctions {f {scope [a b] type salldiff "
                         "params {metric var cost 1}}}}");
              }),
              HasSubstr("x.cfn:2:32: 'salldiff' cannot be used where the problem is to be maximised"));
}

TEST(ProblemFiles, SharedFunctionsAndConstants) {
  const LabelingProblem p =
      read_wcsp("x.wcsp", "p 3 2 4 100\n2 2 2\n-2 0 1 1 1\n0 1 7\n2 2 1 1 -1\n0 5 0\n1 0 3 0\n").problem;
  EXPECT_EQ(p.constant, 5);
  EXPECT_EQ(cost_of(p, std::vector<Index>{0, 1, 0}), 5 + 7 + 7 + 3);
  const ProblemFile cut = read_wcsp("x.wcsp", "p 1 2 3 100\n2\n1 0 0 0\n");
  EXPECT_THAT(cut.warnings, testing::ElementsAre("x.wcsp:4: the file ends after 1 of 3 cost functions"));
}

TEST(ProblemFiles, Evidence) {
  const char* text = "BAYES\n2\n2 3\n2\n1 0\n2 0 1\n\n2\n0.25 0.75\n\n6\n0.2 0.3 0.5 0 0.5 0.5\n";
  ProblemFile file = read_uai("x.uai", text);
  EXPECT_NEAR(cost_of(file.problem, std::vector<Index>{0, 2}), -std::log(0.25 * 0.5), 1e-15);
  EXPECT_EQ(cost_of(file.problem, std::vector<Index>{1, 0}), forbidden);
  read_uai_evidence(file.problem, "x.uai.evid", "1\n1 1 2\n");
  EXPECT_EQ(file.problem.variables[1].costs, (std::vector<double>{forbidden, forbidden, 0}));
  read_uai_evidence(file.problem, "x.uai.evid", "1 0 1");
  EXPECT_EQ(file.problem.variables[0].costs[0], forbidden);
  EXPECT_THAT(refusal([&] { read_uai_evidence(file.problem, "x.uai.evid", "1 1 3"); }),
              HasSubstr("x.uai.evid:1:5: variable 1 has no value 3"));
  EXPECT_THAT(refusal([&] { read_uai_evidence(file.problem, "x.uai.evid", "2 1 1"); }), HasSubstr("has 3 numbers"));
}

}  // namespace
