// SPDX-License-Identifier: BSD-3-Clause
// Constraint-based tree search (dissertation 3.4.2), made exact by branch and bound.

#include <array>
#include <cmath>
#include <string>

#include "depth_first.h"
#include "toposcope/plugin.h"

namespace {

using namespace toposcope;
using namespace toposcope::tree_search;

struct Settings {
  bool only_if_needed, by_violation, crisp;
  double window;  // nats
};

// One run over one problem: the best labelling, then the k best, then the sums.
class Run {
 public:
  Run(const Settings& settings, const LabelingRequest& request, const Tables& tables, Stop& stop, Context& context)
      : settings_(settings),
        request_(request),
        tables_(tables),
        context_(context),
        stop_(stop),
        search_(tables, stop) {}

  LabelingOutcome outcome() {
    find_best();
    if (outcome_.labelings.empty()) {
      nothing_found();
    } else {
      find_alternatives();
      find_lower_bound();
      add_up();
    }
    outcome_.nodes = search_.nodes();
    context_.progress(1);
    return std::move(outcome_);
  }

 private:
  Index variables() const { return tables_.depths(); }

  void find_best() {
    rules_.by_violation = settings_.by_violation;
    std::vector<Ranked> found;
    if (settings_.only_if_needed) {
      bool finished = true;
      for (Index missing = 0; missing <= variables() && finished && found.empty(); ++missing) {
        rules_.missing = missing;
        finished = search_.best(rules_, 1, found);
      }
      outcome_.optimal = finished;
    } else {
      outcome_.optimal = search_.best(rules_, 1, found);
    }
    open_bound_ = search_.open_bound();
    for (Ranked& ranked : found) outcome_.labelings.push_back(std::move(ranked.labeling));
  }

  // Nothing has finite cost, or time was out before the first leaf: all missing is always a labelling.
  void nothing_found() {
    Labeling nothing{std::vector<Index>(variables(), 0), 0};
    nothing.cost = tables_.evaluate(nothing.values).second;
    outcome_.lower_bound = outcome_.optimal ? nothing.cost : tables_.root_bound();
    outcome_.log_evidence = -nothing.cost;
    outcome_.guarantee = outcome_.optimal ? "every labelling is forbidden or of infinite cost; all features missing"
                                          : "stopped before any labelling was reached; all features missing";
    if (!settings_.by_violation)
      for (const LabelingVariable& variable : tables_.problem.variables) {
        outcome_.posteriors.emplace_back(variable.domain(), 0.0);
        outcome_.posteriors.back()[0] = 1;
      }
    outcome_.labelings.push_back(std::move(nothing));
  }

  void find_alternatives() {
    alternatives_proven_ = outcome_.optimal;
    if (!outcome_.optimal || request_.k_best <= 1) return;
    Rules rules = rules_;
    rules.cost_limit = outcome_.labelings[0].cost + settings_.window;
    std::vector<Labeling> kept;
    const auto append = [&] {
      std::vector<Ranked> found;
      alternatives_proven_ = search_.best(rules, request_.k_best - kept.size(), found);
      for (Ranked& ranked : found) kept.push_back(std::move(ranked.labeling));
    };
    append();
    if (settings_.only_if_needed)
      while (*rules.missing < variables() && kept.size() < request_.k_best && alternatives_proven_) {
        ++*rules.missing;
        append();
      }
    // Stopped, the list may even lack the best, which is known.
    if (kept.empty() || kept[0].values != outcome_.labelings[0].values)
      kept.insert(kept.begin(), outcome_.labelings[0]);
    kept.resize(std::min(kept.size(), request_.k_best));
    outcome_.labelings = std::move(kept);
  }

  // Bounds the cost of all labellings that compete; `least_cost_` is the least one known.
  void find_lower_bound() {
    least_cost_ = outcome_.labelings[0].cost;
    if (!settings_.by_violation) {
      outcome_.lower_bound = outcome_.optimal ? least_cost_ : std::min(least_cost_, open_bound_ - tables_.cost.slack);
      return;
    }
    Rules rules = rules_;
    rules.by_violation = false;
    std::vector<Ranked> found;
    const bool finished = search_.best(rules, 1, found);
    if (!found.empty()) least_cost_ = std::min(least_cost_, found[0].labeling.cost);
    outcome_.lower_bound = finished ? least_cost_ : std::min(least_cost_, tables_.root_bound());
  }

  // Sums in widening windows, so that what is reported is always a whole window even when time runs out.
  void add_up() {
    Rules rules = rules_;
    rules.by_violation = false;
    Sums whole;
    double reached = -1;
    for (const double part : std::array<double, 4>{0.125, 0.25, 0.5, 1}) {
      if (stop_.reached()) break;
      rules.cost_limit = least_cost_ + part * settings_.window;
      Sums sums;
      if (!search_.sum(rules, least_cost_, sums)) break;
      whole = std::move(sums);
      reached = part * settings_.window;
    }
    if (!(whole.total > 0)) whole = sums_of_list();
    outcome_.log_evidence = std::log(whole.total) - least_cost_;
    if (!settings_.by_violation) set_posteriors(whole);
    describe(reached, whole.labelings);
  }

  // What is known when not even the first window could be summed: the labellings found.
  Sums sums_of_list() const {
    Sums sums{0, std::vector<double>(tables_.offsets.back(), 0), outcome_.labelings.size()};
    for (const Labeling& labeling : outcome_.labelings) {
      const double weight = std::exp(least_cost_ - labeling.cost);
      for (Index depth = 0; depth < variables(); ++depth)
        sums.values[tables_.offsets[depth] + labeling.values[tables_.order[depth]]] += weight;
      sums.total += weight;
    }
    return sums;
  }

  void set_posteriors(const Sums& sums) {
    outcome_.posteriors.resize(variables());
    for (Index depth = 0; depth < variables(); ++depth) {
      std::vector<double>& posterior = outcome_.posteriors[tables_.order[depth]];
      posterior.resize(tables_.domain(depth));
      for (std::size_t v = 0; v < posterior.size(); ++v)
        posterior[v] = sums.values[tables_.offsets[depth] + v] / sums.total;
    }
  }

  void describe(double reached, std::uint64_t labelings) {
    std::string& text = outcome_.guarantee;
    const std::string rank = settings_.by_violation ? "constraints best satisfied" : "least cost";
    text = rank + (settings_.only_if_needed ? " among the fewest missing: " : ": ");
    text += outcome_.optimal ? "proven" : "not proven, stopped early";
    text += alternatives_proven_ ? "; alternatives proven" : "; alternatives may lack some";
    if (reached < 0) {
      text += "; sums over the listed labellings only";
    } else {
      std::string nats = std::to_string(reached);
      nats.erase(nats.find_last_not_of('0') + 1);
      if (nats.back() == '.') nats.pop_back();
      text += "; sums over all " + std::to_string(labelings) + " labellings within " + nats + " nats of the least cost";
    }
  }

  const Settings& settings_;
  const LabelingRequest& request_;
  const Tables& tables_;
  Context& context_;
  Stop& stop_;
  DepthFirst search_;
  Rules rules_;
  LabelingOutcome outcome_;
  double open_bound_ = forbidden;
  double least_cost_ = 0;
  bool alternatives_proven_ = false;
};

class TreeSearch final : public Labeler {
 public:
  explicit TreeSearch(const Options& options)
      : settings_{options.text("missing") == "only-if-needed", options.text("rank") == "violation",
                  options.boolean("crisp"), options.real("window")} {}

  LabelingOutcome solve(const LabelingProblem& problem, const LabelingRequest& request,
                        Context& context) const override {
    Stop stop(request.time_limit_s, context);  // the making of the tables counts too
    check(problem);
    if (problem.variables.empty())
      return {{Labeling{}}, 0, true, 0, {}, 0, "a problem without variables has one labelling"};
    const Tables tables(problem, settings_.crisp, settings_.by_violation);
    std::string order = "tree-search: features enter in the order";
    for (const Index variable : tables.order) order += " " + problem.variables[variable].name;
    context.log(LogLevel::debug, order);
    return Run(settings_, request, tables, stop, context).outcome();
  }

 private:
  Settings settings_;
};

constexpr OptionSpec options[] = {
    {"missing", OptionType::text, "", "by-cost", "by-cost|only-if-needed", "",
     "a missing feature competes by its cost, or the fewest missing features come first (the dissertation)"},
    {"rank", OptionType::text, "", "cost", "cost|violation", "",
     "consistent labellings are ranked by cost, or by the sum of their violations, then by cost (the dissertation)"},
    {"crisp", OptionType::boolean, "", "true", "", "",
     "forbid relations beyond their tolerance; false: only costs count"},
    {"window", OptionType::real, "nats", "25", "0", "700",
     "labellings costlier than the best by more are neither listed nor summed"},
};

}  // namespace

TOPOSCOPE_PLUGIN(Labeler, TreeSearch,
                 {.id = "tree-search",
                  .version = "1.0.0",
                  .summary = "Exact constraint-based tree search, most detectable relationships first",
                  .citation = "Neal 1999, section 3.4.2",
                  .options = options})
