// SPDX-License-Identifier: BSD-3-Clause
// Marginals and evidence of a labelling problem: exact by elimination or by exhaustive summation, else by belief
// propagation.

#include <cmath>
#include <string>

#include "elimination.h"
#include "toposcope/plugin.h"

namespace {

using namespace toposcope;
using namespace toposcope::posterior;

struct Settings {
  std::string method;
  double max_entries;
};

/// One run over one problem.
class Run {
 public:
  Run(const Settings& settings, const LabelingProblem& problem, const LabelingRequest& request, Context& context)
      : settings_(settings),
        problem_(problem),
        deadline_(request.time_limit_s, context),
        watch_(deadline_),
        best_(std::max<std::size_t>(1, request.k_best), request.within) {}

  LabelingOutcome outcome() {
    try {
      graph_ = factor_graph(problem_, watch_);
      if (graph_.impossible)
        nothing();
      else
        eliminate();
    } catch (const OutOfTime&) {
      outcome_.guarantee = "stopped before anything was known";
    }
    outcome_.labelings = best_.take();
    if (outcome_.labelings.empty()) outcome_.labelings = all_missing(problem_);
    return std::move(outcome_);
  }

 private:
  void nothing() {
    outcome_.optimal = true;
    outcome_.lower_bound = forbidden;
    outcome_.log_evidence = -forbidden;
    outcome_.guarantee = "no labelling has a finite cost: the evidence is 0 and there are no probabilities";
  }

  void offer(const std::vector<Index>& at) {
    Labeling labeling;
    for (Index v = 0; v < at.size(); ++v) labeling.values.push_back(graph_.values[v][at[v]]);
    labeling.cost = cost_of(problem_, labeling.values);
    best_.offer(labeling);
  }

  void eliminate() {
    const EliminationPlan plan = elimination_plan(graph_, settings_.max_entries, watch_);
    if (!(plan.entries <= settings_.max_entries)) {
      outcome_.guarantee = "no elimination order within max_entries";
      return;
    }
    Elimination elimination(graph_, plan, watch_);
    const double slack = rounding_slack(problem_);
    const double least = elimination.minimize();
    if (!(least < forbidden)) return nothing();
    elimination.k_best(
        least, [&](const std::vector<Index>& at) { offer(at); }, [&] { return best_.limit() + slack; }, 100'000);
    outcome_.optimal = true;
    outcome_.lower_bound = best_.labelings().front().cost;
    outcome_.log_evidence = -elimination.sum();
    outcome_.posteriors = spread(elimination.marginals());
    outcome_.guarantee = "exact by elimination";
  }

  /// From the graph's values to the problem's; those struck have probability 0.
  std::vector<std::vector<double>> spread(const std::vector<std::vector<double>>& marginals) const {
    std::vector<std::vector<double>> made;
    for (Index v = 0; v < marginals.size(); ++v) {
      made.emplace_back(problem_.variables[v].domain(), 0.0);
      for (std::size_t i = 0; i < marginals[v].size(); ++i) made[v][graph_.values[v][i]] = marginals[v][i];
    }
    return made;
  }

  const Settings& settings_;
  const LabelingProblem& problem_;
  Deadline deadline_;
  Watch watch_;
  BestLabelings best_;
  FactorGraph graph_;
  LabelingOutcome outcome_;
};

class Posterior final : public Labeler {
 public:
  explicit Posterior(const Options& options) : settings_{options.text("method"), options.real("max_entries")} {}

  LabelingOutcome solve(const LabelingProblem& problem, const LabelingRequest& request,
                        Context& context) const override {
    check(problem);
    if (problem.variables.empty()) {
      LabelingOutcome outcome;
      outcome.labelings = all_missing(problem);
      outcome.lower_bound = problem.constant;
      outcome.optimal = true;
      outcome.log_evidence = -problem.constant;
      outcome.guarantee = "a problem without variables has one labelling";
      return outcome;
    }
    return Run(settings_, problem, request, context).outcome();
  }

 private:
  Settings settings_;
};

constexpr OptionSpec options[] = {
    {"method", OptionType::text, "", "auto", "auto|elimination|search|belief-propagation", "",
     "how the sums are made; auto: whichever exact method is cheaper, belief propagation where neither can finish"},
    {"max_entries", OptionType::real, "", "33554432", "1", "1e10",
     "elimination is feasible where its tables have at most so many entries together, of 8 bytes each"},
};

}  // namespace

TOPOSCOPE_PLUGIN(Labeler, Posterior,
                 {.id = "posterior",
                  .version = "1.0.0",
                  .summary = "Marginal probabilities and evidence, exact where that is feasible",
                  .citation = "Dechter 1999, Artificial Intelligence 113; Pearl 1988",
                  .options = options})
