// SPDX-License-Identifier: BSD-3-Clause
// Run with the plugin's library as its argument.
#include "toposcope/labeling/tools.h"
#include "toposcope/testing/plugin_test.h"

int main(int, char** argv) {
  using namespace toposcope;
  const testing::Plugin<Labeler> plugin(argv[1]);
  testing::QuietContext context;
  // Two features and two candidates, each better as another feature than its first choice: 1 as a and 0 as b.
  LabelingProblem problem;
  problem.variables = {{.name = "a", .candidates = {0, 1}, .costs = {5, -1, -2}},
                       {.name = "b", .candidates = {0, 1}, .costs = {5, -2, -1}}};
  problem.candidate_count = 2;
  problem.conflict_bits = {0b01, 0b10};  // a candidate conflicts with itself alone
  const LabelingOutcome outcome = plugin->solve(problem, {.k_best = 3}, context);
  TOPOSCOPE_EXPECT(!outcome.labelings.empty());
  if (outcome.labelings.empty()) return 1;
  TOPOSCOPE_EXPECT((outcome.labelings[0].values == std::vector<Index>{2, 1}));
  TOPOSCOPE_EXPECT(outcome.labelings[0].cost == -4);
  for (const Labeling& labeling : outcome.labelings) {
    TOPOSCOPE_EXPECT(meets_exclusions(problem, labeling.values));
    TOPOSCOPE_EXPECT(labeling.cost == cost_of(problem, labeling.values));
  }
  return testing::failures;
}
