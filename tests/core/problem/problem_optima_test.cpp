// SPDX-License-Identifier: BSD-3-Clause
// Instances and functions in intension whose optima are known: from their authors, by hand, from toulbar2.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "core/problem/global_function_cases.h"
#include "formats/problem_formats.h"
#include "support/labeling_problems.h"
#include "support/plugins.h"
#include "toposcope/labeling/tools.h"
#include "toposcope/system/programs.h"

namespace {

using namespace toposcope;
using testing::HasSubstr;
namespace fs = std::filesystem;

fs::path instances() {
  return fs::path(TOPOSCOPE_SOURCE_DIR) / "../shared/data/wcsp";
}

/// Files of ../shared/data/wcsp and their optima.
std::vector<std::pair<std::string, double>> optima() {
  std::ifstream table(instances() / "optima.tsv");
  std::vector<std::pair<std::string, double>> all;
  std::string line;
  std::getline(table, line);
  while (std::getline(table, line))
    all.emplace_back(line.substr(0, line.find('\t')), std::atof(line.c_str() + line.find('\t') + 1));
  return all;
}

TEST(ProblemFiles, DevelopmentInstancesHaveTheirProvenOptima) {
  const auto all = optima();
  if (all.empty()) GTEST_SKIP() << "SKIPPED: no ../shared/data/wcsp here";
  for (const auto& [name, optimum] : all) {
    const ProblemFile file = read_problem(instances() / name);
    EXPECT_TRUE(file.warnings.empty()) << name;
    const LabelingOutcome outcome =
        test::labeler("least-error")->solve(file.problem, {.k_best = 1, .time_limit_s = 100}, test::context());
    EXPECT_TRUE(outcome.optimal) << name;
    ASSERT_EQ(outcome.labelings.size(), 1U) << name;
    EXPECT_NEAR(outcome.labelings[0].cost, optimum, 1e-4) << name;
  }
}

/// What toulbar2 proves of a file; -1 where there is no solution.
double toulbar2_optimum(const fs::path& file) {
  FILE* pipe = popen(("toulbar2 '" + file.string() + "' 2>&1").c_str(), "r");
  std::string text;
  for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe)) text += static_cast<char>(c);
  pclose(pipe);
  for (const char* word : {" energy: ", "\nOptimum: "})
    if (const std::size_t at = text.rfind(word); at != text.npos)
      return std::atof(text.c_str() + at + std::string(word).size());
  EXPECT_THAT(text, HasSubstr("No solution"));
  return -1;
}

TEST(ProblemFiles, WrittenBackToulbar2ProvesTheSameOptimum) {
  const auto all = optima();
  if (all.empty()) GTEST_SKIP() << "SKIPPED: no ../shared/data/wcsp here";
  if (!find_program("toulbar2")) GTEST_SKIP() << "SKIPPED: no toulbar2 here (apt-get install toulbar2)";
  for (const auto& [name, optimum] : all) {
    const fs::path original = instances() / name;
    const fs::path written = fs::path(testing::TempDir()) / ("toposcope_written_" + name);
    write_problem(written, read_problem(original));
    EXPECT_NEAR(toulbar2_optimum(written), optimum, 1e-3) << name;
    const fs::path cfn = written.string() + ".cfn";
    write_problem(cfn, read_problem(original));
    EXPECT_NEAR(toulbar2_optimum(cfn), optimum, 1e-3) << name;
    fs::remove(written);
    fs::remove(cfn);
  }
}

TEST(ProblemFiles, FunctionsInIntensionAgreeWithToulbar2) {
  for (const test::GlobalFunctionCase& each : test::global_function_cases) {
    const ProblemFile file = read_wcsp("x.wcsp", each.file);
    const auto all = test::all_labelings(file.problem);
    const bool none = all.empty() || all[0].cost >= file.top;
    EXPECT_EQ(none ? -1 : all[0].cost, each.optimum) << each.file;
  }
}

// By hand: what one tuple costs.
TEST(ProblemFiles, FunctionsInIntension) {
  const auto cost = [](const std::string& function, const std::vector<Index>& tuple, const std::string& domain = "9") {
    std::string text = "x " + std::to_string(tuple.size()) + " 9 1 1000\n", scope;
    for (std::size_t i = 0; i < tuple.size(); ++i) {
      text += domain + " ";
      scope += " " + std::to_string(i);
    }
    text += "\n" + std::to_string(tuple.size()) + scope + " -1 " + function + "\n";
    const ProblemFile file = read_wcsp("x.wcsp", text);
    return cost_of(file.problem, tuple);
  };
  EXPECT_EQ(cost("salldiff var 2", {1, 1, 1, 3}), 4);  // two must change
  EXPECT_EQ(cost("salldiff dec 2", {1, 1, 1, 3}), 6);  // three pairs
  EXPECT_EQ(cost("salldiff var 1000", {1, 2, 3, 3}), forbidden);
  EXPECT_EQ(cost("walldiff quad 2", {1, 1, 1, 3}), 8);        // one value, two too many
  EXPECT_EQ(cost("walldiff hard 2", {1, 1, 3, 3}), 4);        // per value
  EXPECT_EQ(cost("sgcc var 3 2 0 1 1 1 0 1", {1, 1, 1}), 6);  // two too many, one too few
  EXPECT_EQ(cost("sgcc dec 3 2 0 1 1 1 0 1", {1, 1, 1}), 9);
  EXPECT_EQ(cost("samong var 5 1 2 2 7 8", {7, 8, 7, 1}), 5);
  EXPECT_EQ(cost("wamong quad 5 2 7 8 0 1", {7, 8, 7, 1}), 20);
  EXPECT_EQ(cost("wamong hard 5 2 7 8 0 1", {7, 8, 7, 1}), 5);
  EXPECT_EQ(cost("max 3 2 0 0 4 1 2 1", {0, 2}), 4);
  EXPECT_EQ(cost("max 3 2 0 0 4 1 2 1", {1, 2}), 3);
  EXPECT_EQ(cost("ssame 2 2 2 0 1 2 3", {1, 2, 2, 3}), 2);
  EXPECT_EQ(cost("wsame lin 2", {1, 2, 2, 3}), 4);
  EXPECT_EQ(cost("sregular var 2 2 1 0 1 1 2 0 0 1 1 1 0", {0, 1, 0}), 0);  // 0 1 0 ...
  EXPECT_EQ(cost("sregular var 2 2 1 0 1 1 2 0 0 1 1 1 0", {0, 0, 0}), 2);
  EXPECT_EQ(cost("sregular edit 2 2 1 0 1 1 2 0 0 1 1 1 0", {1, 0}), 2);    // leave out the 1
  EXPECT_EQ(cost("sregular edit 2 2 1 0 1 0 2 0 0 1 1 1 0", {0}, "2"), 2);  // put a 1 behind it
  EXPECT_EQ(cost("wregular 2 1 0 3 1 1 4 2 0 0 1 5 1 1 1 6", {0, 1, 1}), 3 + 5 + 6 + 6 + 4);
  EXPECT_EQ(cost("wregular 2 1 0 3 1 1 4 2 0 0 1 5 1 1 1 6", {1, 1, 1}), forbidden);
  EXPECT_EQ(cost("sgrammar var 5 4 2 0 6 1 0 0 0 1 0 1 2 1 0 1 3 1 2 0 3 0 1 0 0 3 1", {0, 0, 1, 1}), 0);   // (())
  EXPECT_EQ(cost("sgrammar var 5 4 2 0 6 1 0 0 0 1 0 1 2 1 0 1 3 1 2 0 3 0 1 0 0 3 1", {1, 0, 1, 0}), 10);  // )()(
  EXPECT_EQ(cost("MST", {1, 1, 0}, "3"), 0);
  EXPECT_EQ(cost("MST", {1, 0, 0}, "3"), forbidden);
  EXPECT_EQ(cost("knapsack 5 2 3", {1, 1}, "2"), 0);
  EXPECT_EQ(cost("knapsack 5 2 3", {0, 1}, "2"), forbidden);
  EXPECT_EQ(cost("knapsackp 5 1 7 2 2 7 3 8 4", {7, 8}), 0);
  EXPECT_EQ(cost("knapsackp 5 1 7 2 2 7 3 8 4", {6, 8}), forbidden);
  EXPECT_EQ(cost("knapsackv 5 3 0 7 2 1 7 3 1 8 4", {7, 7}), 0);
  EXPECT_EQ(cost("knapsackv 5 3 0 7 2 1 7 3 1 8 4", {0, 8}), forbidden);
  EXPECT_EQ(cost("wdiverse 2 1 2 3", {1, 0, 0}), 0);
  EXPECT_EQ(cost("wdiverse 2 1 2 3", {1, 2, 0}), forbidden);
  EXPECT_EQ(cost("whdiverse 3 1 2 3", {0, 0, 0}), 0);
  EXPECT_EQ(cost("whdiverse 3 1 2 3", {0, 0, 3}), forbidden);
  EXPECT_EQ(cost("clique 1 1 4 2 4 5", {4, 5}), forbidden);
  EXPECT_EQ(cost("clique 1 1 4 2 4 5", {4, 6}), 0);
  EXPECT_EQ(cost(">= 2 3", {1, 1}), 2);
  EXPECT_EQ(cost(">= 2 1", {1, 1}), forbidden);
  EXPECT_EQ(cost("= 2 3", {1, 1}), 2);
  EXPECT_EQ(cost("sdisj 3 4 8 8 10 20", {5, 1}), 0);
  EXPECT_EQ(cost("sdisj 3 4 8 8 10 20", {5, 3}), forbidden);
  EXPECT_EQ(cost("sdisj 3 4 8 8 10 20", {8, 8}), 30);
  EXPECT_EQ(cost("sdisj 3 4 7 8 10 20", {8, 8}), forbidden);  // beyond the last value
}

}  // namespace
