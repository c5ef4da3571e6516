// SPDX-License-Identifier: BSD-3-Clause
// Iterated conditional modes: from a greedy labelling, each variable in turn takes the value that is best beside the
// others, until nothing changes.
#include <numeric>
#include <vector>

#include "toposcope/labeling/greedy_labeling.h"
#include "toposcope/plugin.h"

namespace {
using namespace toposcope;

struct Strategy final : Labeler {
  explicit Strategy(const Options& options) : sweeps(options.integer("sweeps")) {}

  LabelingOutcome solve(const LabelingProblem& problem, const LabelingRequest& request,
                        Context& context) const override {
    LabelingOutcome outcome;
    outcome.guarantee = "no change of one variable lowers the cost, unless it was stopped";
    Deadline deadline(request.time_limit_s, context);
    std::vector<Index> order(problem.variables.size());
    std::iota(order.begin(), order.end(), Index{0});
    const auto start = greedy_labeling(problem, {.order = order, .rank = {}}, deadline);
    outcome.labelings = all_missing(problem);
    if (!start) return outcome;
    BestLabelings best(request.k_best, request.within);
    Labeling current{*start, cost_of(problem, *start)};
    best.offer(current);
    bool changed = true;
    for (int sweep = 0; sweep < sweeps && changed; ++sweep) {
      changed = false;
      for (Index v = 0; v < order.size(); ++v)
        for (Index value = 0; value < problem.variables[v].domain() && !deadline.reached(); ++value) {
          Labeling next = current;
          next.values[v] = value;
          next.cost = cost_of(problem, next.values);  // infinite where the labelling is not allowed
          if (next.cost < forbidden) best.offer(next);
          if (next.cost < current.cost) current = next, changed = true;
        }
      ++outcome.nodes;
    }
    outcome.labelings = best.take();
    return outcome;
  }

  int sweeps;
};

const OptionSpec options[] = {
    {"sweeps", OptionType::integer, "", "100", "1", "1000000", "over all variables, at most"}};
}  // namespace

TOPOSCOPE_PLUGIN(Labeler, Strategy,
                 {.id = "@ID@",
                  .version = "0.1.0",
                  .summary = "Iterated conditional modes",
                  .citation = "Besag, On the statistical analysis of dirty pictures, 1986",
                  .options = options})
