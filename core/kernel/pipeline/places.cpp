// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/places.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "pipeline/labeling_problem.h"
#include "pipeline/same_shape.h"
#include "plugin/plugin_host.h"
#include "toposcope/labeling/tools.h"

namespace toposcope {
namespace {

/// Values of one variable, by place.
class Places {
 public:
  Places(const ClassOutcome& posed, Index variable, const Model& model, const Analysis& analysis,
         const Stations& stations)
      : variable_(posed.problem.variables[variable]),
        posterior_(posed.outcome.posteriors[variable]),
        fitter_(*stations.shapes.at(model.features[posed.features[variable]].shape.plugin)),
        analysis_(analysis) {}

  double probability(Index value) const {
    double sum = 0;
    for (const Index like : of(value)) sum += posterior_[like];
    return std::min(1.0, sum);
  }

  /// All values in the place of one, ascending.
  std::vector<Index> of(Index value) const {
    std::vector<Index> values;
    for (Index other = 0; other < variable_.domain(); ++other)
      if (other == value || alike(value, other)) values.push_back(other);
    return values;
  }

  /// The values of the most probable place.
  std::vector<Index> best() const {
    std::vector<Index> order(variable_.domain());
    std::iota(order.begin(), order.end(), Index{0});
    std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) { return posterior_[a] > posterior_[b]; });
    std::vector<bool> placed(order.size(), false);
    std::vector<Index> best;
    double most = -1, left = 1;
    for (const Index value : order) {
      if (placed[value]) continue;
      if (left <= most) break;  // no place of what is left has more
      std::vector<Index> place = of(value);
      double sum = 0;
      for (const Index like : place) {
        sum += posterior_[like];
        if (!placed[like]) left -= posterior_[like];
        placed[like] = true;
      }
      if (sum > most) most = sum, best = std::move(place);
    }
    return best;
  }

 private:
  bool alike(Index a, Index b) const {
    if (a == 0 || b == 0) return false;
    const auto shape = [&](Index value) -> const FittedShape& {
      return analysis_.features.all[variable_.candidates[value - 1]].shape;
    };
    return same_shape(fitter_, shape(a), shape(b), analysis_.mesh.view().mean_edge);
  }

  const LabelingVariable& variable_;
  const std::vector<double>& posterior_;
  const ShapeFitter& fitter_;
  const Analysis& analysis_;
};

}  // namespace

double probability_of_place(const ClassOutcome& posed, Index variable, Index value, const Model& model,
                            const Analysis& analysis, const Stations& stations) {
  return Places(posed, variable, model, analysis, stations).probability(value);
}

Labeling in_most_probable_places(const ClassOutcome& posed, const Model& model, const Analysis& analysis,
                                 const Stations& stations, Context& context) {
  const Labeling& least = posed.outcome.labelings.front();
  if (posed.outcome.posteriors.empty()) return least;
  std::vector<std::vector<Index>> kept(least.values.size());
  std::vector<Index> moved;
  for (Index v = 0; v < kept.size(); ++v) {
    const Places places(posed, v, model, analysis, stations);
    kept[v].resize(posed.problem.variables[v].domain());
    std::iota(kept[v].begin(), kept[v].end(), Index{0});
    const double here = places.probability(least.values[v]);
    if (here >= 0.5) continue;  // no other place has more
    std::vector<Index> best = places.best();
    double there = 0;
    for (const Index value : best) there += posed.outcome.posteriors[v][value];
    if (there <= here) continue;
    moved.push_back(v);
    if (best.front() != 0) best.insert(best.begin(), 0);  // every problem has it; it is forbidden below
    kept[v] = std::move(best);
  }
  if (moved.empty()) return least;
  LabelingProblem problem = restricted(posed.problem, kept);
  for (const Index v : moved)
    if (kept[v].size() > 1) problem.variables[v].costs[0] = forbidden;
  const LabelingOutcome outcome =
      guard(stations.labeler_id, [&] { return stations.labeler->solve(problem, {}, context); });
  check_outcome(problem, outcome, stations.labeler_id);
  if (outcome.labelings.empty() || !(outcome.labelings.front().cost < forbidden)) return least;
  Labeling answer = outcome.labelings.front();
  for (Index v = 0; v < kept.size(); ++v) answer.values[v] = kept[v][answer.values[v]];
  answer.cost = cost_of(posed.problem, answer.values);
  return answer;
}

}  // namespace toposcope
