// SPDX-License-Identifier: BSD-3-Clause
// Relaxation labelling, decoded to a labelling that breaks nothing.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <string>

#include "toposcope/labeling/greedy_labeling.h"
#include "toposcope/labeling/relaxation_labeling.h"
#include "toposcope/plugin.h"

namespace {

using namespace toposcope;

struct Settings {
  RelaxationRules rules;
  double saturation;
  bool lasting, uniform, improve;
};

std::string text(double number) {
  std::array<char, 32> buffer{};
  std::snprintf(buffer.data(), buffer.size(), "%.6g", number);
  return buffer.data();
}

class Run {
 public:
  Run(const Settings& settings, const LabelingProblem& problem, const LabelingRequest& request, Deadline& deadline)
      : settings_(settings),
        problem_(problem),
        deadline_(deadline),
        tables_(problem, deadline),
        best_(std::max<std::size_t>(request.k_best, 1), request.within) {}

  LabelingOutcome outcome() {
    outcome_.lower_bound = tables_.lower_bound();
    if (outcome_.lower_bound < forbidden) {
      begin();
      if (tables_.complete()) relax_weights();
      decode();
      if (settings_.improve && tables_.complete()) improve();
    }
    conclude();
    return std::move(outcome_);
  }

 private:
  // Weights by position, 0 where forbidden: exp(-cost), normed. Beyond 30 nats of the least a value keeps exp(-30):
  // what is 0 once stays so.
  void begin() {
    for (const LabelingVariable& variable : problem_.variables) {
      const double least = *std::min_element(variable.costs.begin(), variable.costs.end());
      const std::size_t first = weights_.size();
      double sum = 0;
      for (const double cost : variable.costs) {
        const double above = settings_.uniform ? 0 : std::min(cost - least, 30.0);
        sum += weights_.emplace_back(cost < forbidden ? std::exp(-above) : 0);
      }
      for (std::size_t p = first; p < weights_.size(); ++p) weights_[p] /= sum;
    }
  }

  void relax_weights() {
    Compatibilities compatibilities(tables_, settings_.saturation, settings_.lasting, deadline_);
    if (!compatibilities.complete()) return;
    const std::span<const std::uint32_t> allowed = tables_.allowed();
    std::vector<double> weights(allowed.size());
    for (Index v = 0; v < compatibilities.variables(); ++v) {
      double sum = 0;
      for (std::size_t l = compatibilities.offset(v); l < compatibilities.offset(v + 1); ++l)
        sum += weights[l] = weights_[allowed[l]];
      for (std::size_t l = compatibilities.offset(v); l < compatibilities.offset(v + 1); ++l) weights[l] /= sum;
    }
    const double entropy_start = mean_entropy(compatibilities, weights);
    const Relaxed relaxed = relax(compatibilities, std::move(weights), settings_.rules, deadline_);
    std::fill(weights_.begin(), weights_.end(), 0.0);
    for (std::size_t l = 0; l < allowed.size(); ++l) weights_[allowed[l]] = relaxed.weights[l];
    outcome_.nodes = static_cast<std::uint64_t>(relaxed.iterations);
    converged_ = relaxed.converged;
    outcome_.facts = {{"iterations", std::to_string(relaxed.iterations)},
                      {"converged", relaxed.converged ? "yes" : "no"},
                      {"ended by", relaxed.criterion},
                      {"saturation", text(compatibilities.saturation())},
                      {"average local consistency at start", text(relaxed.consistency_start)},
                      {"average local consistency at end", text(relaxed.consistency)},
                      {"entropy at start, nats per variable", text(entropy_start)},
                      {"entropy at end, nats per variable", text(mean_entropy(compatibilities, relaxed.weights))}};
  }

  double largest_weight(Index v) const {
    return *std::max_element(weights_.begin() + static_cast<std::ptrdiff_t>(tables_.offset(v)),
                             weights_.begin() + static_cast<std::ptrdiff_t>(tables_.offset(v + 1)));
  }

  // The least ambiguous variable first, each its greatest weight that those before it leave open.
  void decode() {
    GreedyRules rules;
    rules.order.resize(problem_.variables.size());
    std::iota(rules.order.begin(), rules.order.end(), Index{0});
    std::vector<double> largest;
    double ambiguity = 0;
    for (const Index v : rules.order) {
      largest.push_back(largest_weight(v));
      ambiguity += 1 - largest.back();
    }
    std::stable_sort(rules.order.begin(), rules.order.end(), [&](Index a, Index b) { return largest[a] > largest[b]; });
    if (!rules.order.empty()) {
      const Index last = rules.order.back();
      outcome_.facts.push_back({"mean ambiguity", text(ambiguity / static_cast<double>(rules.order.size()))});
      outcome_.facts.push_back(
          {"most ambiguous variable", problem_.variables[last].name + " (" + text(1 - largest[last]) + ")"});
    }
    rules.rank.resize(weights_.size());
    std::transform(weights_.begin(), weights_.end(), rules.rank.begin(), [](double weight) { return -weight; });
    if (auto values = greedy_labeling(problem_, std::move(rules), deadline_)) {
      const double cost = cost_of(problem_, *values);
      outcome_.facts.push_back({"cost as decoded", text(cost)});
      best_.offer({std::move(*values), cost});
    }
  }

  // Single changes for the better, from what was decoded; where nothing was, from the greatest weights.
  void improve() {
    std::vector<Index> values;
    if (best_.labelings().empty())
      for (Index v = 0; v < problem_.variables.size(); ++v) {
        const auto first = weights_.begin() + static_cast<std::ptrdiff_t>(tables_.offset(v));
        values.push_back(static_cast<Index>(
            std::max_element(first, first + static_cast<std::ptrdiff_t>(tables_.domain(v))) - first));
      }
    else
      values = best_.labelings()[0].values;
    ConditionalCosts costs(tables_);
    costs.reset(values);
    improved_ = descend(tables_, costs, deadline_);
    offer_neighbours(tables_, costs, best_, deadline_);
  }

  void conclude() {
    outcome_.labelings = best_.take();
    const bool none = outcome_.labelings.empty();
    outcome_.optimal = none ? outcome_.lower_bound == forbidden : outcome_.labelings[0].cost <= outcome_.lower_bound;
    std::string& words = outcome_.guarantee;
    if (none && outcome_.optimal)
      words = "every labelling is forbidden: a variable or constraint has no finite cost";
    else if (outcome_.optimal)
      words = "optimal: the cost is that of every table's least entry";
    else if (none)
      words = "no labelling of finite cost found, which proves nothing";
    else
      words = std::string("not proven: decoded from weights that ") + (converged_ ? "converged" : "did not converge") +
              (improved_ ? ", then improved one variable at a time" : "");
    if (none) outcome_.labelings = all_missing(problem_);
    if (none && !outcome_.labelings.empty()) words += "; all missing";
  }

  const Settings& settings_;
  const LabelingProblem& problem_;
  Deadline& deadline_;
  CostTables tables_;
  BestLabelings best_;
  std::vector<double> weights_;  ///< by position
  LabelingOutcome outcome_;
  bool converged_ = false, improved_ = false;
};

class ContinuousRelaxation final : public Labeler {
 public:
  explicit ContinuousRelaxation(const Options& options)
      : settings_{
            {options.text("update") == "projected-gradient", options.integer("iterations"), options.real("tolerance")},
            options.real("saturation"),
            options.text("evidence") == "lasting",
            options.text("start") == "uniform",
            options.boolean("improve")} {}

  LabelingOutcome solve(const LabelingProblem& problem, const LabelingRequest& request,
                        Context& context) const override {
    Deadline deadline(request.time_limit_s, context);
    check(problem);
    LabelingOutcome outcome = Run(settings_, problem, request, deadline).outcome();
    context.progress(1);
    return outcome;
  }

 private:
  Settings settings_;
};

constexpr OptionSpec options[] = {
    {"update", OptionType::text, "", "projected-gradient", "", "",
     "how weights change: ascent of the average local consistency (1983), or the product rule (1976)",
     "projected-gradient|rosenfeld-hummel-zucker"},
    {"iterations", OptionType::integer, "", "1000", "0", "1000000000", "at most"},
    {"tolerance", OptionType::real, "", "1e-6", "0", "1",
     "of weights: converged where none changes by more, or would in a step along the gradient"},
    {"start", OptionType::text, "", "costs", "", "",
     "weights at first: exp(-cost) of each value by itself, normed, or all alike", "costs|uniform"},
    {"evidence", OptionType::text, "", "lasting", "", "",
     "what a value costs by itself supports it in every iteration, or makes the first weights alone (the papers)",
     "lasting|initial"},
    {"saturation", OptionType::real, "nats", "0", "0", "",
     "constraint cost at which a compatibility reaches -1 or 1; 0: the largest finite one of the problem"},
    {"improve", OptionType::boolean, "", "true", "", "",
     "after decoding change single variables while that lowers the cost; also lists the neighbours for the k best"},
};

}  // namespace

TOPOSCOPE_PLUGIN(Labeler, ContinuousRelaxation,
                 {.id = "continuous-relaxation",
                  .version = "1.0.0",
                  .summary = "Relaxation labelling: weighted labels that constraints pull towards each other",
                  .citation = "Rosenfeld, Hummel and Zucker 1976; Hummel and Zucker 1983",
                  .options = options})
