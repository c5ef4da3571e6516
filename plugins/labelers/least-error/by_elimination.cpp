// SPDX-License-Identifier: BSD-3-Clause
#include "by_elimination.h"

#include <string>

#include "toposcope/labeling/elimination.h"

namespace toposcope::least_error {
namespace {

/// \return false where the search is to be asked
bool eliminate(const LabelingProblem& problem, const Limits& limits, BestLabelings& best, LabelingOutcome& outcome) {
  factors::Watch watch(limits.deadline);
  const factors::FactorGraph outline = factors::skeleton(problem);
  if (factors::elimination_plan(outline, factors::cheap_entries(outline) + 1, watch).entries >
      factors::cheap_entries(outline))
    return false;
  const factors::FactorGraph graph = factors::factor_graph(problem, watch);
  if (graph.impossible) return true;
  const double most = factors::cheap_entries(graph);
  const factors::EliminationPlan plan = factors::elimination_plan(graph, most + 1, watch);
  if (plan.entries > most || plan.bytes() > static_cast<double>(limits.memory_budget) / 2) return false;
  factors::Elimination elimination(graph, plan, watch);
  const double least = elimination.minimize();
  if (!(least < forbidden)) return true;
  Labeling labeling{std::vector<Index>(graph.variables()), 0};
  const factors::Offer offer = [&](const std::vector<Index>& at) {
    for (Index v = 0; v < at.size(); ++v) labeling.values[v] = graph.values[v][at[v]];
    labeling.cost = cost_of(problem, labeling.values);
    best.offer(labeling);
  };
  elimination.k_best(least, {.k = limits.k_best, .slack = rounding_slack(problem), .offer = offer, .list = best});
  outcome.facts.push_back({"method", "elimination"});
  outcome.nodes = graph.variables();
  return true;
}

}  // namespace

bool by_elimination(const LabelingProblem& problem, const Limits& limits, BestLabelings& best,
                    LabelingOutcome& outcome) {
  try {
    if (!eliminate(problem, limits, best, outcome)) return false;
  } catch (const factors::OutOfTime&) {
    return false;  // labellings that were found stay in the list
  }
  outcome.optimal = true;
  outcome.lower_bound = best.labelings().empty() ? forbidden : best.labelings().front().cost;
  return true;
}

}  // namespace toposcope::least_error
