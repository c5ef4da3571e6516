// SPDX-License-Identifier: BSD-3-Clause
// Error-minimising optimisation (dissertation 3.4.2), exact.

#include <algorithm>
#include <string>

#include "branch_and_bound.h"
#include "by_elimination.h"
#include "toposcope/labeling/crisp_search.h"
#include "toposcope/labeling/greedy_labeling.h"
#include "toposcope/plugin.h"

namespace {

using namespace toposcope;
using namespace toposcope::least_error;

class LeastError final : public Labeler {
 public:
  explicit LeastError(const Options& options)
      : settings_{options.integer("root_sweeps"), options.integer("node_sweeps"),
                  options.boolean("virtual_arc_consistency")} {}

  LabelingOutcome solve(const LabelingProblem& problem, const LabelingRequest& request,
                        Context& context) const override {
    Deadline deadline(request.time_limit_s, context);  // the making of the tables counts too
    check(problem);
    LabelingOutcome outcome;
    const std::size_t k_best = std::max<std::size_t>(1, request.k_best);
    BestLabelings best(k_best, std::max(0.0, request.within));
    if (!by_elimination(problem, {k_best, context.memory_budget(), deadline}, best, outcome))
      search(problem, {best, k_best, deadline, context}, outcome);
    outcome.labelings = best.take();
    outcome.guarantee = guarantee(outcome, request);
    if (outcome.labelings.empty()) outcome.labelings = all_missing(problem);
    if (!outcome.labelings.empty()) outcome.lower_bound = std::min(outcome.lower_bound, outcome.labelings[0].cost);
    context.progress(1);
    return outcome;
  }

 private:
  struct Means {
    BestLabelings& best;
    std::size_t k_best;
    Deadline& deadline;
    Context& context;
  };

  void search(const LabelingProblem& problem, const Means& means, LabelingOutcome& outcome) const {
    // To have one at any time, and a cost to stay below.
    if (const auto values =
            greedy_labeling(problem, {.order = detectability_order(problem), .rank = {}}, means.deadline))
      means.best.offer({*values, cost_of(problem, *values)});
    SoftNetwork network(problem, means.deadline);
    if (network.infeasible()) {
      outcome.optimal = true;
      outcome.lower_bound = forbidden;
    } else if (network.complete()) {
      BranchAndBound search(problem, network, means.best, means.k_best, settings_, means.deadline, means.context);
      outcome.optimal = search.search();
      outcome.nodes = search.nodes();
      outcome.lower_bound = search.lower_bound();
      if (search.root_bound() < forbidden)
        outcome.facts.push_back({"lower bound before the search", std::to_string(search.root_bound())});
    }
  }

  static std::string guarantee(const LabelingOutcome& outcome, const LabelingRequest& request) {
    if (outcome.labelings.empty())
      return outcome.optimal ? "every labelling is forbidden: proven" : "stopped before any labelling was reached";
    if (!outcome.optimal) return "stopped early: the best labelling found, and a proven lower bound";
    std::string text = "least cost: proven";
    if (outcome.labelings.size() > 1)
      text += "; so are the " + std::to_string(outcome.labelings.size() - 1) + " next best listed";
    if (request.within < forbidden && outcome.labelings.size() < request.k_best) text += ", all within the threshold";
    return text;
  }

  Settings settings_;
};

constexpr OptionSpec options[] = {
    {"root_sweeps", OptionType::integer, "", "100", "0", "100000",
     "most sweeps that spread costs evenly before the search; they end when they gain little"},
    {"node_sweeps", OptionType::integer, "", "3", "0", "1000",
     "most such sweeps at a node, on problems that prove hard; 0: soft arc consistency alone"},
    {"virtual_arc_consistency", OptionType::boolean, "", "true", "", "", "enforce it before the search"},
};

}  // namespace

TOPOSCOPE_PLUGIN(
    Labeler, LeastError,
    {.id = "least-error",
     .version = "1.0.0",
     .summary = "Error-minimising optimisation, exact: branch and bound with soft local consistency",
     .citation = "Neal 1999, section 3.4.2; de Givry et al. 2005; Cooper et al. 2010; Allouche et al. 2015",
     .options = options})
