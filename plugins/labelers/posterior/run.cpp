// SPDX-License-Identifier: BSD-3-Clause
#include "run.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <string>

#include "belief_propagation.h"
#include "decode.h"
#include "search.h"
#include "toposcope/labeling/crisp_search.h"
#include "toposcope/labeling/elimination.h"

namespace toposcope::posterior {
namespace {

std::string number(double value, const char* format = "%.3g") {
  char text[32];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

/// One run over one problem.
class Run {
 public:
  Run(const Settings& settings, const LabelingProblem& problem, const LabelingRequest& request, Context& context)
      : settings_(settings),
        problem_(problem),
        request_(request),
        context_(context),
        deadline_(request.time_limit_s, context),
        watch_(deadline_),
        best_(std::max<std::size_t>(1, request.k_best), request.within) {}

  LabelingOutcome outcome() {
    try {
      graph_ = factor_graph(problem_, watch_);
      if (graph_.impossible || choose() == Ending::no_labeling) nothing();
    } catch (const OutOfTime&) {
      if (outcome_.guarantee.empty()) outcome_.guarantee = "stopped before any sum was made: no probabilities";
    }
    outcome_.labelings = best_.take();
    if (outcome_.labelings.empty()) {
      outcome_.labelings = all_missing(problem_);
    } else if (outcome_.optimal) {
      outcome_.lower_bound = outcome_.labelings.front().cost;
    } else {
      outcome_.lower_bound = std::min(outcome_.lower_bound, outcome_.labelings.front().cost);
      outcome_.guarantee += "; the labelling is not proven best";
    }
    if (outcome_.optimal && !alternatives_proven_) outcome_.guarantee += "; alternatives are not proven next best";
    return std::move(outcome_);
  }

 private:
  enum class Ending { summed, no_labeling, unfinished };

  Ending choose() {
    const std::string& method = settings_.method;
    if (method == "belief-propagation") return propagate();
    EliminationPlan plan;
    bool feasible = false;
    const auto memory = static_cast<double>(context_.memory_budget());
    if (method != "search") {
      plan = elimination_plan(graph_, settings_.max_entries + 1, watch_);
      feasible = plan.entries <= settings_.max_entries && plan.bytes() <= memory;
      if (feasible && (method == "elimination" || plan.entries <= cheap_entries(graph_))) return eliminate(plan);
      if (method == "elimination") {
        fact("elimination", plan.entries <= settings_.max_entries
                                ? too_much(plan.bytes())
                                : "needs more than " + number(settings_.max_entries, "%.0f") + " table entries");
        return propagate();
      }
    }
    if (const double bytes = Search::bytes(graph_); bytes > std::min(memory, most_of_search)) {
      fact("search", too_much(bytes));
      return feasible ? eliminate(plan) : propagate();
    }
    // Where evidence is concentrated the search is done long before a table of all combinations is filled: it may take
    // about as long as that, or where that cannot be done, most of the time.
    const std::uint64_t most_nodes = feasible ? static_cast<std::uint64_t>(plan.entries / entries_per_node) : unlimited;
    const Ending ending = search(most_nodes);
    if (ending != Ending::unfinished) return ending;
    return feasible ? eliminate(plan) : propagate();
  }

  static std::string too_much(double bytes) { return "would need " + number(bytes / 1e6, "%.0f") + " MB"; }

  /// All is proven, and there is nothing to sum.
  void nothing() {
    outcome_.optimal = alternatives_proven_ = true;
    outcome_.lower_bound = forbidden;
    outcome_.log_evidence = -forbidden;
    outcome_.posteriors.clear();
    promise(Exactness::exact, Exactness::none);
    outcome_.guarantee = "exact: no labelling has a finite cost, so that there are no probabilities";
  }

  /// \param left_out  part of the evidence that is known not to have been summed
  void promise(Exactness evidence, Exactness posteriors, double left_out = 0) {
    outcome_.evidence_exactness = evidence;
    outcome_.evidence_error = std::log1p(left_out);
    outcome_.posterior_exactness = posteriors;
    outcome_.posterior_error = left_out;
  }

  void fact(std::string name, std::string value) {
    for (LabelingFact& known : outcome_.facts)
      if (known.name == name) {
        known.value = std::move(value);
        return;
      }
    outcome_.facts.push_back({std::move(name), std::move(value)});
  }

  void offer(const std::vector<Index>& at) {
    offered_.values.resize(at.size());
    for (Index v = 0; v < at.size(); ++v) offered_.values[v] = graph_.values[v][at[v]];
    offered_.cost = cost_of(problem_, offered_.values);
    best_.offer(offered_);
  }

  /// Reads all tables: not before there is something to compare.
  double slack() {
    if (!slack_) slack_ = rounding_slack(problem_);
    return *slack_;
  }

  Ending eliminate(const EliminationPlan& plan) {
    Elimination elimination(graph_, plan, watch_);
    const double least = elimination.minimize();
    if (!(least < forbidden)) return Ending::no_labeling;
    elimination.k_best(least, {.k = std::max<std::size_t>(1, request_.k_best),
                               .slack = slack(),
                               .offer = [&](const std::vector<Index>& at) { offer(at); },
                               .list = best_});
    alternatives_proven_ = true;
    outcome_.optimal = true;
    outcome_.nodes += graph_.variables();
    context_.progress(0.3);
    const double log_evidence = -elimination.sum();
    context_.progress(0.7);
    outcome_.posteriors = spread(elimination.marginals());
    outcome_.log_evidence = log_evidence;
    promise(Exactness::exact, Exactness::exact);
    outcome_.facts.clear();  // of a search that did not come to its end
    fact("method", "elimination");
    fact("table entries", number(plan.entries, "%.0f"));
    outcome_.guarantee = "exact: sums over all labellings by elimination";
    return Ending::summed;
  }

  Ending search(std::uint64_t most_nodes) {
    // Belief propagation has the rest of the time.
    Deadline deadline(search_share * (request_.time_limit_s - deadline_.elapsed_s()), context_);
    Watch watch(most_nodes == unlimited ? deadline : deadline_);
    try {
      const SearchTables tables(graph_, detectability_order(problem_), watch);
      outcome_.lower_bound = tables.bound() - slack();
      Search search(graph_, tables, slack(), watch, outcome_.nodes);
      if (!find_best(search, most_nodes)) return Ending::unfinished;
      if (best_.labelings().empty()) return Ending::no_labeling;
      return add_up(tables, search, most_nodes) ? Ending::summed : Ending::unfinished;
    } catch (const OutOfTime&) {
      return outcome_.posteriors.empty() ? Ending::unfinished : Ending::summed;
    }
  }

  /// \return false when that took too many nodes
  bool find_best(Search& search, std::uint64_t most_nodes) {
    BestLabelings single(1, forbidden);
    const auto both = [&](const std::vector<Index>& at) {
      offer(at);
      single.offer(offered_);
    };
    if (!search.best(both, single, most_nodes)) return false;
    if (best_.labelings().empty()) return true;
    outcome_.optimal = true;
    least_ = best_.labelings().front().cost;
    if (request_.k_best > 1)
      alternatives_proven_ =
          search.best([&](const std::vector<Index>& at) { offer(at); }, best_, std::min(most_nodes, most_alternatives));
    return true;
  }

  bool add_up(const SearchTables& tables, Search& search, std::uint64_t most_nodes) {
    // At once where that is quick; else from coarse to fine, so that there is something when time runs out.
    double known = 1;  // the evidence is at least that times exp(-least cost)
    if (sum(tables, search, settings_.tolerance, known, std::min(most_nodes, quick_nodes))) return true;
    if (most_nodes <= quick_nodes) return false;
    for (double tolerance = 0.1; tolerance > settings_.tolerance; tolerance *= 0.01)
      if (!sum(tables, search, tolerance, known, most_nodes)) return false;
    return sum(tables, search, settings_.tolerance, known, most_nodes);
  }

  bool sum(const SearchTables& tables, Search& search, double tolerance, double& known, std::uint64_t most_nodes) {
    const Sums sums = search.sum(least_, tolerance * known, most_nodes);
    if (!sums.finished) return false;
    known = std::max(known, sums.total);
    const double error = sums.omitted / sums.total;
    outcome_.log_evidence = std::log(sums.total) - least_;
    std::vector<std::vector<double>> marginals(graph_.variables());
    for (Index depth = 0; depth < tables.depths(); ++depth)
      for (std::size_t i = tables.offsets[depth]; i < tables.offsets[depth + 1]; ++i)
        marginals[tables.order[depth]].push_back(sums.values[i] / sums.total);
    outcome_.posteriors = spread(marginals);
    const Exactness exactness = error <= as_good_as_exact ? Exactness::exact : Exactness::bound;
    promise(exactness, exactness, error);
    fact("method", "search");
    fact("left out", number(error));
    outcome_.guarantee = (error <= settings_.tolerance ? "exact to " : "stopped early: proven to ") + number(error) +
                         ": sums over all labellings but for a proven part of so much";
    return true;
  }

  Ending propagate() {
    if (!std::isfinite(outcome_.lower_bound)) outcome_.lower_bound = lower_bound(graph_) - slack();
    // The rest is for the estimate of the evidence and the labelling.
    Deadline deadline(sweeps_share * (request_.time_limit_s - deadline_.elapsed_s()), context_);
    Watch watch(deadline);
    const FactorGraph graph = merged(graph_, watch);
    BeliefPropagation propagation(graph, watch);
    double residual = forbidden;
    try {
      while (propagation.sweeps() < settings_.max_sweeps && residual > converged_at) {
        residual = propagation.sweep(propagation.sweeps() < undamped_sweeps ? 0 : settings_.damping);
        if (propagation.contradiction()) return Ending::no_labeling;
      }
    } catch (const OutOfTime&) {
    }
    const bool converged = residual <= converged_at;
    if (propagation.sweeps() == 0) throw OutOfTime{};
    outcome_.nodes += propagation.sweeps();
    const std::vector<std::vector<double>> marginals = propagation.marginals();
    outcome_.posteriors = spread(marginals);
    const bool exact = converged && propagation.forest();
    const Exactness exactness = exact ? Exactness::exact : Exactness::approximate;
    outcome_.posterior_exactness = exactness;
    fact("method", "belief propagation");
    fact("converged", converged ? "yes" : "no");
    fact("sweeps", std::to_string(propagation.sweeps()));
    fact("residual", number(residual));
    outcome_.guarantee = exact ? "exact: belief propagation on a graph without cycles"
                               : "approximate: loopy belief propagation, " +
                                     std::string(converged ? "converged" : "not converged") + " after " +
                                     std::to_string(propagation.sweeps()) + " sweeps (residual " + number(residual) +
                                     "); evidence is Bethe's estimate";
    propagation.use(watch_);
    outcome_.log_evidence = propagation.bethe_log_evidence();
    outcome_.evidence_exactness = std::isnan(outcome_.log_evidence) ? Exactness::none : exactness;
    const std::vector<Index> decoded = decode(graph_, marginals, most_decoded, watch_);
    if (!decoded.empty()) offer(decoded);
    return Ending::summed;
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

  static constexpr std::uint64_t unlimited = std::uint64_t{1} << 60;
  static constexpr double most_of_search = 1 << 29;  ///< bytes: what needs more does not end
  static constexpr double entries_per_node = 30;     ///< that take as long as a node of the search
  static constexpr std::uint64_t quick_nodes = 200'000;
  static constexpr std::uint64_t most_alternatives = 1'000'000, most_decoded = 100'000;
  static constexpr double search_share = 0.6, sweeps_share = 0.8;
  static constexpr double converged_at = 1e-9;
  static constexpr double as_good_as_exact = 1e-9;  ///< part of the evidence left out
  static constexpr std::uint64_t undamped_sweeps = 20;

  const Settings& settings_;
  const LabelingProblem& problem_;
  const LabelingRequest& request_;
  Context& context_;
  std::optional<double> slack_;
  Deadline deadline_;
  Watch watch_;
  BestLabelings best_;
  FactorGraph graph_;
  Labeling offered_;
  double least_ = 0;
  bool alternatives_proven_ = true;
  LabelingOutcome outcome_;
};

}  // namespace

LabelingOutcome run(const Settings& settings, const LabelingProblem& problem, const LabelingRequest& request,
                    Context& context) {
  return Run(settings, problem, request, context).outcome();
}

}  // namespace toposcope::posterior
