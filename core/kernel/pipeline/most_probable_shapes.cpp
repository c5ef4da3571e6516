// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/most_probable_shapes.h"

#include <algorithm>
#include <numeric>

#include "pipeline/same_shape.h"
#include "pipeline/solve.h"
#include "toposcope/labeling/restricted.h"
#include "toposcope/labeling/tools.h"

namespace toposcope {
namespace {

/// Values of one variable by their shape, the same to within a mean edge; *missing* stands for itself.
class ValuesByShape {
 public:
  ValuesByShape(const ClassOutcome& posed, Index variable, const ConstructedFeatures& features, const ModelRun& run)
      : variable_(posed.problem.variables[variable]),
        posterior_(posed.outcome.posteriors[variable]),
        features_(features),
        mean_edge_(run.mesh.mean_edge) {}

  double probability(Index value) const {
    double sum = 0;
    for (const Index like : of(value)) sum += posterior_[like];
    return std::min(1.0, sum);
  }

  /// All values of the same shape, ascending.
  std::vector<Index> of(Index value) const {
    std::vector<Index> values;
    for (Index other = 0; other < variable_.domain(); ++other)
      if (other == value || same(value, other)) values.push_back(other);
    return values;
  }

  double most_of_a_shape() const {
    double most = 0;
    for (Index value = 1; value < variable_.domain(); ++value)
      if (posterior_[value] > 0) most = std::max(most, probability(value));
    return most;
  }

  /// The values of the most probable shape.
  std::vector<Index> best() const {
    std::vector<Index> order(variable_.domain());
    std::iota(order.begin(), order.end(), Index{0});
    std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) { return posterior_[a] > posterior_[b]; });
    std::vector<bool> counted(order.size(), false);
    std::vector<Index> best;
    double most = -1, left = 1;
    for (const Index value : order) {
      if (counted[value]) continue;
      if (left <= most) break;  // no shape of what is left has more
      std::vector<Index> alike = of(value);
      double sum = 0;
      for (const Index like : alike) {
        sum += posterior_[like];
        if (!counted[like]) left -= posterior_[like];
        counted[like] = true;
      }
      if (sum > most) most = sum, best = std::move(alike);
    }
    return best;
  }

 private:
  bool same(Index a, Index b) const {
    if (a == 0 || b == 0) return false;
    return same_shape(features_.all[variable_.candidates[a - 1]], features_.all[variable_.candidates[b - 1]],
                      mean_edge_);
  }

  const LabelingVariable& variable_;
  const std::vector<double>& posterior_;
  const ConstructedFeatures& features_;
  double mean_edge_;
};

}  // namespace

double probability_of_shape(const ClassOutcome& posed, Index variable, Index value, const ConstructedFeatures& features,
                            const ModelRun& run) {
  return ValuesByShape(posed, variable, features, run).probability(value);
}

double most_of_a_shape(const ClassOutcome& posed, Index variable, const ConstructedFeatures& features,
                       const ModelRun& run) {
  return ValuesByShape(posed, variable, features, run).most_of_a_shape();
}

Labeling with_most_probable_shapes(const ClassOutcome& posed, const ConstructedFeatures& features,
                                   const ModelRun& run) {
  const Labeling& least = posed.outcome.labelings.front();
  if (posed.outcome.posteriors.empty()) return least;
  std::vector<std::vector<Index>> kept(least.values.size());
  std::vector<Index> moved;
  for (Index v = 0; v < kept.size(); ++v) {
    const ValuesByShape values(posed, v, features, run);
    kept[v].resize(posed.problem.variables[v].domain());
    std::iota(kept[v].begin(), kept[v].end(), Index{0});
    const double here = values.probability(least.values[v]);
    if (here >= 0.5) continue;  // no other shape has more
    std::vector<Index> best = values.best();
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
  const LabelingOutcome outcome = solve(run.stations.labeler, problem, {}, run.context);
  if (outcome.labelings.empty() || !(outcome.labelings.front().cost < forbidden)) return least;
  Labeling answer = outcome.labelings.front();
  for (Index v = 0; v < kept.size(); ++v) answer.values[v] = kept[v][answer.values[v]];
  answer.cost = cost_of(posed.problem, answer.values);
  return answer;
}

}  // namespace toposcope
