// SPDX-License-Identifier: BSD-3-Clause
// Labelling problems written and read back.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "formats/problem_formats.h"
#include "model/yaml_schema.h"
#include "support/labeling_problems.h"
#include "support/plugins.h"
#include "support/refusal.h"
#include "toposcope/labeling/problem_writer.h"
#include "toposcope/labeling/tools.h"
#include "toposcope/system/programs.h"

namespace {

using namespace toposcope;
using test::refusal;
using testing::HasSubstr;
namespace fs = std::filesystem;

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

}  // namespace
