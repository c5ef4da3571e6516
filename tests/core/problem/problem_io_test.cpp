// SPDX-License-Identifier: BSD-3-Clause
// Labelling problems written and read back, what the formats may say, and broken files.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>

#include "base/errors.h"
#include "base/schemas.h"
#include "model/yaml_schema.h"
#include "problem_formats.h"
#include "support/labeling_problems.h"
#include "support/plugins.h"
#include "toposcope/labeling/problem_writer.h"
#include "toposcope/labeling/tools.h"
#include "toposcope/system/programs.h"

namespace {

using namespace toposcope;
using testing::HasSubstr;
namespace fs = std::filesystem;

std::string refusal(const std::function<void()>& read) {
  try {
    read();
  } catch (const UsageError& error) {
    return error.what();
  }
  return "";
}

ProblemFile file_of(const LabelingProblem& problem) {
  ProblemFile file;
  file.problem = problem;
  return file;
}

TEST(ProblemFiles, JsonLosesNothing) {
  std::ifstream stream(fs::path(TOPOSCOPE_SOURCE_DIR) / "schemas/problem.schema.json");
  const std::string schema(std::istreambuf_iterator<char>(stream), {});
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    ProblemFile file = file_of(test::random_problem(test::random_kind(seed), seed));
    file.problem.constant = seed % 3 == 0 ? 0 : 0.1 * static_cast<double>(seed);
    file.maximize = seed % 5 == 0;
    if (seed % 2 == 0) file.top = 1.0 / 3 + static_cast<double>(seed);
    const std::string text = problem_json(file);
    const ProblemFile back = read_problem_json("x.json", text);
    EXPECT_EQ(problem_json(back), text);
    EXPECT_EQ(back.top, file.top);
    ASSERT_EQ(back.problem.variables.size(), file.problem.variables.size());
    for (std::size_t v = 0; v < back.problem.variables.size(); ++v) {
      const LabelingVariable &a = back.problem.variables[v], &b = file.problem.variables[v];
      EXPECT_EQ(a.name, b.name);
      EXPECT_EQ(a.costs, b.costs);
      EXPECT_EQ(a.candidates, b.candidates);
      EXPECT_EQ(a.value_names, b.value_names);
      EXPECT_EQ(a.optional, b.optional);
      EXPECT_EQ(a.detectability, b.detectability);
    }
    ASSERT_EQ(back.problem.constraints.size(), file.problem.constraints.size());
    for (std::size_t c = 0; c < back.problem.constraints.size(); ++c) {
      EXPECT_EQ(back.problem.constraints[c].scope, file.problem.constraints[c].scope);
      EXPECT_EQ(back.problem.constraints[c].costs, file.problem.constraints[c].costs);
      EXPECT_EQ(back.problem.constraints[c].violations, file.problem.constraints[c].violations);
    }
    EXPECT_EQ(back.problem.conflict_bits, file.problem.conflict_bits);
    if (seed >= 20) continue;
    ErrorList errors;
    check_schema(parse_yaml(text, "problem"), schema, "problem", errors);
    EXPECT_NO_THROW(errors.throw_if_any());
  }
}

// Every labelling costs what it did, to the digits that the format has; what was forbidden is.
TEST(ProblemFiles, OtherFormatsKeepEveryLabellingsCost) {
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    test::RandomKind kind = test::random_kind(seed);
    kind.ties = seed % 4 != 0;  // whole quarters: two decimals
    LabelingProblem problem = test::random_problem(kind, seed);
    problem.constant = -0.75 * static_cast<double>(seed % 3);
    const auto all = test::all_labelings(problem);
    const auto compare = [&](const LabelingProblem& back, double factor, double shift, double rounding,
                             const char* format) {
      const auto found = test::all_labelings(back);
      ASSERT_EQ(found.size(), all.size()) << format << ", " << seed;
      for (const Labeling& labeling : all)
        EXPECT_NEAR(cost_of(back, labeling.values), (labeling.cost + shift) * factor, rounding) << format << seed;
    };
    const WrittenProblem cfn = write_cfn(problem);
    compare(read_cfn("x.cfn", cfn.text).problem, 1, 0, 1e-7, "cfn");
    EXPECT_EQ(cfn.exact, kind.ties) << seed;
    compare(read_uai("x.uai", write_uai(problem).text).problem, 1, 0, 1e-9, "uai");
    const WrittenProblem wcsp = write_wcsp(problem);
    compare(read_wcsp("x.wcsp", wcsp.text).problem, std::pow(10, wcsp.decimals), wcsp.shift, kind.ties ? 1e-6 : 20,
            "wcsp");
    const ProblemFile most = read_cfn("x.cfn", write_cfn(problem, forbidden, true).text);
    EXPECT_TRUE(most.maximize);
    compare(most.problem, 1, 0, 1e-7, "cfn, maximised");
  }
}

TEST(ProblemFiles, NamesAreKeptAsFarAsCfnAllows) {
  LabelingProblem problem;
  problem.name = "a [cup], 2";
  problem.variables.resize(3);
  problem.variables[0] = {.name = "left wing", .costs = {1, 2}};
  problem.variables[1] = {.name = "left,wing", .costs = {0, 2}, .optional = false};
  problem.variables[2] = {.name = "3", .costs = {0, 2}, .optional = false, .value_names = {"a", "a b"}};
  problem.constraints.push_back({"r1", {0, 2}, {0, 1, 2, 3}, {}});
  const LabelingProblem back = read_cfn("x.cfn", write_cfn(problem).text).problem;
  EXPECT_EQ(back.name, "a__cup___2");
  EXPECT_EQ(back.variables[0].name, "left_wing");
  EXPECT_THAT(back.variables[0].value_names, testing::ElementsAre("missing", "c1"));
  EXPECT_EQ(back.variables[1].name, "left_wing_2");
  EXPECT_TRUE(back.variables[1].value_names.empty());
  EXPECT_EQ(back.variables[2].name, "_3");
  EXPECT_THAT(back.variables[2].value_names, testing::ElementsAre("a", "a_b"));
  EXPECT_EQ(back.constraints[0].name, "r1");
}

TEST(ProblemFiles, WideAllDifferentBecomesPairs) {
  std::string text = "x 40 40 1 5\n", scope;
  for (int i = 0; i < 40; ++i) {
    text += "40 ";
    scope += " " + std::to_string(i);
  }
  const auto read = [&](const std::string& function) {
    return read_wcsp("x.wcsp", text + "\n40" + scope + " -1 " + function).problem.constraints.size();
  };
  EXPECT_EQ(read("salldiff var 5"), 780U);
  EXPECT_EQ(read("salldiff dec 1"), 780U);
  EXPECT_EQ(read("walldiff lin 9"), 780U);
  EXPECT_THAT(refusal([&] { read("salldiff var 1"); }),
              HasSubstr("x.wcsp:3:117: the function over 40 variables needs a table of more than 4194304 entries"));
}

// All that the format lets out or lets in besides JSON; see also the functions of max.cfn.

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

TEST(ProblemFiles, RefusalsNameThePlaceAndTheRemedy) {
  EXPECT_THAT(refusal([] { read_wcsp("a.wcsp", "p 1 2 1 10\n2\n1 0 0 1\n"); }), HasSubstr("a.wcsp:4:1: the file ends"));
  EXPECT_THAT(refusal([] { read_wcsp("a.wcsp", "p 1 2 1 10\n2\n1 5 0 0\n"); }),
              HasSubstr("a.wcsp:3:3: the index of a variable cannot be 5: it must be from 0 to 0"));
  EXPECT_THAT(refusal([] { read_wcsp("a.wcsp", "p 2 2 1 10\n2 2\n2 0 0 0 0\n"); }),
              HasSubstr("names variable 'x0' twice"));
  EXPECT_THAT(
      refusal([] { read_wcsp("a.wcsp", "p 2 2 1 10\n2 2\n2 0 1 -1 smst hard 5\n"); }),
      HasSubstr(
          "a.wcsp:3:10: the cost function 'smst' is not supported; did you mean 'MST'? Otherwise write it as a table"));
  EXPECT_THAT(refusal([] { read_wcsp("a.wcsp", "p 2 2 1 10\n2 2\n2 0 1 -1 salldiff lin 5\n"); }),
              HasSubstr("a.wcsp:3:19: the measure of 'salldiff' is 'lin'; supported are var, dec, decbi"));
  EXPECT_THAT(refusal([] { read_wcsp("a.wcsp", "p 2 2 1 10\n2 2\n2 0 1 0 1\n0 0 -3\n"); }),
              HasSubstr("are not negative"));
  EXPECT_THAT(refusal([] { read_wcsp("a.wcsp", "p 2 2 1 10\n2 2\n2 0 1 0 -1\n"); }),
              HasSubstr("is not defined before"));
  EXPECT_THAT(refusal([] { read_cfn("a.cfn", "{problem {name x mustbe 3}\nvariables {} functions {}}"); }),
              HasSubstr("a.cfn:1:25: the bound is '3'; it must be '<'"));
  EXPECT_THAT(refusal([] {
                read_cfn("a.cfn",
                         "{problem {name x mustbe <3}\nvariables {a 2}\nfunctions {f {scope [b] costs [0 1]}}}");
              }),
              HasSubstr("a.cfn:3:22: there is no variable 'b'"));
  EXPECT_THAT(refusal([] { read_cfn("a.cfn", "{problem {name x mustbe <3}"); }), HasSubstr("cut short"));
  EXPECT_THAT(refusal([] {
                read_cfn("a.cfn", "{problem {name x mustbe <3}\nvariables {a 2}\nfunctions {f {scope [a] costs [0]}}}");
              }),
              HasSubstr("function 'f' has 1 costs; its scope has 2 tuples"));
  EXPECT_THAT(refusal([] {
                read_cfn("a.cfn",
                         "{problem {name x mustbe <3}\nvariables {a 2 b 2}\nfunctions {f {scope [a b] type wsum "
                         "params {metric lin cost 1 to 2}}}}");
              }),
              HasSubstr("a.cfn:3:63: expected 'comparator' but found 'to'"));
  EXPECT_THAT(refusal([] { read_uai("a.uai", "MARKOV\n1\n2\n1\n1 0\n\n3\n1 1 1"); }),
              HasSubstr("a.uai:7:1: the function has 3 entries; the domains of its 1 variables make 2"));
  EXPECT_THAT(refusal([] { read_uai("a.uai", "MARKOV\n1\n2\n1\n1 0\n\n2\n1 -1"); }), HasSubstr("are not negative"));
  EXPECT_THAT(refusal([] { read_problem_json("a.json", "{}"); }), HasSubstr("toposcope.problem/1"));
  EXPECT_THAT(refusal([] { read_problem_json("a.json", "{\n  \"schema\": ]"); }), HasSubstr("a.json:2:13: is no JSON"));
  const std::string begin = "{\"schema\": \"toposcope.problem/1\",\n\"variables\": [\n {\"name\": \"a\", ";
  EXPECT_THAT(refusal([&] { read_problem_json("a.json", begin + "\"costs\": [0, \"x\"]}]}"); }),
              HasSubstr("a.json:3:29: 'costs' holds numbers, and null for what is forbidden"));
  EXPECT_THAT(refusal([&] { read_problem_json("a.json", begin + "\"cost\": [0]}]}"); }),
              HasSubstr("a.json:3:24: unknown key 'cost'; did you mean 'costs'?"));
  EXPECT_THAT(refusal([&] {
                read_problem_json("a.json", begin +
                                                "\"costs\": [0, 1]}],\n\"constraints\": [{\"scope\": [1], "
                                                "\"costs\": [0, 1]}]}");
              }),
              HasSubstr("a.json:4:28: there is no variable 1"));
  EXPECT_THAT(refusal([&] { read_problem_json("a.json", begin + "\"costs\": []}]}"); }), HasSubstr("has no values"));
  EXPECT_THAT(refusal([&] { read_problem_json("a.json", begin + "\"costs\": [1e999]}]}"); }), HasSubstr("1e999"));
  EXPECT_THAT(refusal([] { read_problem("a.txt"); }), HasSubstr("known are .json, .cfn, .wcsp and .uai"));
  EXPECT_THAT(refusal([] { read_problem("no-such.cfn"); }), HasSubstr("no-such.cfn: no such file"));
  LabelingProblem large;
  large.variables = {{.name = "a", .costs = {0, 1e16}}};
  EXPECT_THAT(refusal([&] { write_problem(testing::TempDir() + "/large.wcsp", large); }), HasSubstr("too large"));
}

}  // namespace
