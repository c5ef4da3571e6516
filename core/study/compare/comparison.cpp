// SPDX-License-Identifier: BSD-3-Clause
#include "compare/comparison.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>

#include "base/errors.h"
#include "result/result.h"
#include "toposcope/labeling/tools.h"

namespace toposcope {
namespace {

/// Larger differences than the rounding of sums are real.
bool same_cost(double a, double b) {
  return std::abs(a - b) <= 1e-9 * std::max({1.0, std::abs(a), std::abs(b)});
}

struct ClassBound {
  std::string name;
  double bound;
};

void raise(std::vector<ClassBound>& bounds, const ClassOutcome& solved) {
  const auto found = std::find_if(bounds.begin(), bounds.end(), [&](const auto& b) { return b.name == solved.name; });
  if (found == bounds.end())
    bounds.push_back({solved.name, solved.lower_bound});
  else
    found->bound = std::max(found->bound, solved.lower_bound);
}

Entry entry_of(const Contender& contender, const ClassOutcome& best, double time_ms, std::uint64_t nodes) {
  Entry entry;
  entry.labeler = contender.name;
  entry.class_name = best.name;
  const Labeling& labeling = best.outcome.labelings.front();
  for (Index v = 0; v < labeling.values.size(); ++v)
    entry.labeling.emplace_back(
        best.problem.variables[v].name,
        labeling.values[v] == 0 ? 0 : best.problem.variables[v].candidates[labeling.values[v] - 1] + 1);
  entry.cost = labeling.cost;
  entry.posterior = std::exp(-labeling.cost - best.log_evidence);
  entry.time_ms = time_ms;
  entry.nodes = nodes;
  entry.guarantee = best.outcome.guarantee;
  return entry;
}

/// One labeler that cannot leaves the others to be compared.
std::string label_or_say_why(Analysis& analysis, const Model& model, const Stations& stations,
                             const LabelingRequest& request, Context& context) try {
  label(analysis, model, stations, request, context);
  return "";
} catch (const PluginError& error) {
  return error.what();
} catch (const std::bad_alloc&) {
  return "labeler '" + stations.labeler.id + "': out of memory";
}

Entry failed_entry(const Contender& contender, const std::string& error) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  Entry entry;
  entry.labeler = contender.name;
  entry.cost = entry.bound = entry.posterior = entry.time_ms = none;
  entry.guarantee = "none: it failed";
  entry.error = error;
  return entry;
}

}  // namespace

Comparison compare(Analysis& analysis, const Model& model, const Stations& stations, const std::string& mesh,
                   const std::vector<Contender>& contenders, const LabelingRequest& request, const Truth* truth,
                   Context& context, const LabelerObserver& observer) {
  Comparison comparison{mesh, {}};
  std::vector<ClassBound> bounds;
  for (const Contender& contender : contenders) {
    Stations with = stations;
    with.labeler = {contender.id, contender.labeler};
    if (const std::string error = label_or_say_why(analysis, model, with, request, context); !error.empty()) {
      comparison.entries.push_back(failed_entry(contender, error));
      continue;
    }
    double time_ms = 0;
    std::uint64_t nodes = 0;
    for (const ClassOutcome& solved : analysis.classes) {
      raise(bounds, solved);
      time_ms += solved.label_ms;
      nodes += solved.nodes;
    }
    comparison.entries.push_back(entry_of(contender, analysis.classes[analysis.best], time_ms, nodes));
    if (!truth && !observer) continue;
    const Result result = explain(analysis, model, mesh, with, context);
    if (observer) observer(contender, analysis, result);
    if (!truth) continue;
    const Judgement judged = judge(result, analysis, model, with, *truth);
    if (judged.features.empty()) continue;
    comparison.entries.back().right = judged.right();
    comparison.entries.back().of = judged.features.size();
  }
  for (Entry& entry : comparison.entries) {
    if (!entry.error.empty()) continue;
    for (const ClassBound& each : bounds)
      if (each.name == entry.class_name) entry.bound = each.bound;
    entry.proven = entry.cost < forbidden && same_cost(entry.cost, entry.bound);
    if (entry.proven) entry.bound = entry.cost;
  }
  return comparison;
}

std::vector<Total> totals(const std::vector<Comparison>& comparisons) {
  std::vector<Total> all;
  if (comparisons.empty()) return all;
  for (std::size_t i = 0; i < comparisons[0].entries.size(); ++i) {
    Total total;
    total.labeler = comparisons[0].entries[i].labeler;
    std::vector<double> times;
    std::size_t with_posterior = 0;
    for (const Comparison& comparison : comparisons) {
      const Entry& entry = comparison.entries[i];
      if (!entry.error.empty()) continue;
      ++total.meshes;
      total.proven += entry.proven;
      if (entry.cost < forbidden) {
        total.mean_gap += entry.gap();
        total.worst_gap = std::max(total.worst_gap, entry.gap());
      } else {
        ++total.unsound;
      }
      if (!std::isnan(entry.posterior)) {
        ++with_posterior;
        total.mean_posterior += entry.posterior;
      }
      times.push_back(entry.time_ms);
      total.nodes += entry.nodes;
      total.right += entry.right.value_or(0);
      total.of += entry.of.value_or(0);
    }
    total.mean_gap /= static_cast<double>(total.meshes - total.unsound);
    total.mean_posterior /= static_cast<double>(with_posterior);
    std::sort(times.begin(), times.end());
    if (times.empty()) times = {std::numeric_limits<double>::quiet_NaN()};
    total.median_ms = (times[(times.size() - 1) / 2] + times[times.size() / 2]) / 2;
    total.worst_ms = times.back();
    all.push_back(std::move(total));
  }
  return all;
}

}  // namespace toposcope
