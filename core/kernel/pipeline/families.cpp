// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/families.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "base/errors.h"
#include "pipeline/stopwatch.h"
#include "probability/number_costs.h"

namespace toposcope {
namespace {

double saving(std::span<const double> costs) {
  const auto least = std::min_element(costs.begin(), costs.end());
  return least == costs.end() ? 0 : std::max(0.0, -*least);
}

SolveProblem by(const LabelerStation& labeler, const ModelRun& run) {
  return [&](const LabelingProblem& problem, const LabelingRequest& request) {
    return solve(labeler, problem, request, run.context);
  };
}

/// What cannot be told apart is for the user to change.
template <class Solve>
FamilyOutcome attempt(const ModelRun& run, const Solve& solved) {
  try {
    return solved();
  } catch (const Error&) {
    throw;
  } catch (const std::runtime_error& error) {
    throw UsageError(run.model.file + ": model '" + run.model.name + "': " + error.what());
  }
}

std::vector<FamilyCount> count_instances(const std::vector<Family>& families, const FamilyOutcome& found) {
  std::vector<FamilyCount> counts;
  for (std::size_t f = 0; f < families.size(); ++f) {
    FamilyCount& count = counts.emplace_back();
    count.feature = families[f].variable;
    if (!found.labelings.empty()) count.found = static_cast<Index>(found.labelings.front().instances[f].size());
    if (!found.numbers.empty()) count.numbers = found.numbers[f];
  }
  return counts;
}

/// Where as many are found as there may be, whether there would be more.
void look_beyond(const LabelingProblem& problem, const ModelRun& run, const LabelerStation& labeler,
                 std::vector<FamilyCount>& counts) {
  const auto full = [&](const FamilyCount& count) {
    return run.model.features[count.feature].count.most == count.found;
  };
  if (std::none_of(counts.begin(), counts.end(), full)) return;
  const FamilyOutcome beyond = attempt(run, [&] {
    return sum_with_families({problem, families_of(problem, run, true)}, {}, by(labeler, run));
  });
  for (std::size_t f = 0; f < counts.size() && f < beyond.numbers.size(); ++f) {
    if (!full(counts[f])) continue;
    const std::vector<double>& numbers = beyond.numbers[f];
    double more = 0;
    for (std::size_t k = counts[f].found + 1; k < numbers.size(); ++k) more += numbers[k];
    const auto likely = std::max_element(numbers.begin(), numbers.end()) - numbers.begin();
    counts[f].beyond = {std::min(more, 1.0), static_cast<Index>(likely)};
  }
}

}  // namespace

bool has_families(const Model& model) {
  return std::any_of(model.features.begin(), model.features.end(),
                     [](const ModelFeature& feature) { return feature.count.family(); });
}

double worth(const LabelingProblem& problem, Index variable) {
  double worth = saving(std::span(problem.variables[variable].costs).subspan(1));
  for (const LabelingConstraint& constraint : problem.constraints) {
    if (std::count(constraint.scope.begin(), constraint.scope.end(), variable) != 1) continue;
    double found = 1;
    for (const Index other : constraint.scope)
      if (other != variable) found *= problem.variables[other].detectability;
    worth += found * saving(constraint.costs);
  }
  return worth;
}

std::vector<Family> families_of(const LabelingProblem& problem, const ModelRun& run, bool any_number) {
  std::vector<Family> families;
  for (Index f = 0; f < run.model.features.size(); ++f) {
    const ModelFeature& feature = run.model.features[f];
    if (!feature.count.family()) continue;
    InstanceCount count = feature.count;
    if (any_number) count.most.reset();
    const double certainty = run.stations.probability.certainty;
    const double detectability = std::clamp(feature.detectability, 1 - certainty, certainty);
    const Index most = problem.variables[f].domain() - 1;
    families.push_back({f, number_costs(count, detectability, count.least > 0 ? worth(problem, f) : 0, most)});
  }
  return families;
}

SolveTimes solve_with_families(ClassOutcome& solved, const ModelRun& run, const LabelingRequest& request) {
  SolveTimes times;
  Stopwatch watch;
  const FamilyProblem problem{solved.problem, families_of(solved.problem, run, false)};
  const Stations& stations = run.stations;
  solved.sets =
      attempt(run, [&] { return toposcope::best_with_families(problem, request, by(stations.labeler, run)); });
  if (solved.sets.labelings.empty()) throw PluginError(stations.labeler.id, "gave no labelling");
  solved.outcome = std::move(solved.sets.outcome);
  for (const FamilyLabeling& labeling : solved.sets.labelings)
    solved.outcome.labelings.push_back({labeling.values, labeling.cost});
  times.label_ms = watch.lap_ms();
  const LabelerStation& labeler = stations.marginals ? *stations.marginals : stations.labeler;
  FamilyOutcome sums = attempt(run, [&] { return sum_with_families(problem, request, by(labeler, run)); });
  take_sums(sums.outcome, solved.outcome);
  solved.sets.numbers = std::move(sums.numbers);
  solved.families = count_instances(problem.families, solved.sets);
  look_beyond(solved.problem, run, labeler, solved.families);
  (stations.marginals ? times.marginals_ms : times.label_ms) += watch.lap_ms();
  const bool any = !solved.outcome.posteriors.empty() || !std::isnan(solved.outcome.log_evidence);
  solved.probabilities = any || stations.marginals ? labeler.id + ": " + sums.outcome.guarantee : "";
  if (any && !sums.approximation.empty()) solved.probabilities += "; " + sums.approximation;
  if (!solved.sets.approximation.empty()) solved.outcome.guarantee += "; " + solved.sets.approximation;
  return times;
}

std::vector<Index> best_with_families(const LabelingProblem& problem, const ModelRun& run) {
  const FamilyOutcome best = attempt(run, [&] {
    return toposcope::best_with_families({problem, families_of(problem, run, false)}, {},
                                         by(run.stations.labeler, run));
  });
  if (best.labelings.empty()) return std::vector<Index>(problem.variables.size(), 0);
  return best.labelings.front().values;
}

}  // namespace toposcope
