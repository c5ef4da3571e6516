// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/analysis.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "base/errors.h"
#include "pipeline/labeling_problem.h"
#include "plugin/plugin_host.h"
#include "probability/symmetry.h"
#include "toposcope/labeling_tools.h"

namespace toposcope {
namespace {

class Stopwatch {
 public:
  double lap_ms() {
    const auto now = std::chrono::steady_clock::now();
    const double ms = std::chrono::duration<double, std::milli>(now - last_).count();
    last_ = now;
    return ms;
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

/// Values of each variable that stay: those nearer to the variable's own label than to the labels of the features
/// that it could be exchanged with. So an airplane's port wing has one side, and not half a probability on each.
std::vector<std::vector<Index>> one_side(const ClassOutcome& solved, const std::vector<std::vector<Index>>& orbits,
                                         const ConstructedFeatures& features) {
  const std::vector<Index>& best = solved.outcome.labelings.front().values;
  const auto centroid_of = [&](Index variable, Index value) -> const Vec3& {
    return features.all[solved.problem.variables[variable].candidates[value - 1]].shape.centroid;
  };
  std::vector<std::vector<Index>> kept(best.size());
  for (Index v = 0; v < best.size(); ++v)
    for (Index value = 0; value < solved.problem.variables[v].domain(); ++value) {
      bool own = true;
      if (value > 0 && best[v] > 0)
        for (Index w = 0; w < best.size(); ++w) {
          if (w == v || best[w] == 0 || !std::binary_search(orbits[v].begin(), orbits[v].end(), w)) continue;
          const Vec3& at = centroid_of(v, value);
          own = own && (at - centroid_of(v, best[v])).squaredNorm() <= (at - centroid_of(w, best[w])).squaredNorm();
        }
      if (own) kept[v].push_back(value);
    }
  return kept;
}

/// Of a labeler that sums nothing up: its list stands for all labellings, so that classes can be compared.
double log_evidence_of(const LabelingOutcome& outcome) {
  if (!std::isnan(outcome.log_evidence)) return outcome.log_evidence;
  double least = forbidden;
  for (const Labeling& labeling : outcome.labelings) least = std::min(least, labeling.cost);
  if (!std::isfinite(least)) return -forbidden;
  double sum = 0;
  for (const Labeling& labeling : outcome.labelings) sum += std::exp(least - labeling.cost);
  return std::log(sum) - least;
}

ClassOutcome solve(ClassOutcome posed, const Model& model, const ConstructedFeatures& features,
                   const Stations& stations, const LabelingRequest& request, Context& context) {
  const auto run = [&] {
    posed.outcome =
        guard(stations.labeler_id, [&] { return stations.labeler->solve(posed.problem, request, context); });
    check_outcome(posed.problem, posed.outcome, stations.labeler_id);
  };
  run();
  posed.log_evidence = log_evidence_of(posed.outcome);
  const auto orbits = interchangeable_features(model, posed.features, posed.relationships, stations.relation_ordered,
                                               model.classes.empty());
  const auto kept = one_side(posed, orbits, features);
  bool changed = false;
  for (Index v = 0; v < kept.size(); ++v) changed = changed || kept[v].size() < posed.problem.variables[v].domain();
  if (changed) {
    posed.problem = restricted(posed.problem, kept);
    run();
  }
  const Labeling& best = posed.outcome.labelings.front();
  posed.complete = std::all_of(best.values.begin(), best.values.end(), [](Index value) { return value > 0; });
  for (const LabelingConstraint& constraint : posed.problem.constraints)
    posed.complete = posed.complete && satisfied(constraint, table_entry(posed.problem, constraint, best.values));
  return posed;
}

/// Probability of each class, and last of none, when all are equally likely beforehand.
std::vector<double> class_probabilities(const std::vector<ClassOutcome>& classes) {
  std::vector<double> log_evidence;
  for (const ClassOutcome& c : classes) log_evidence.push_back(c.log_evidence);
  log_evidence.push_back(0);  // everything is clutter
  const double top = *std::max_element(log_evidence.begin(), log_evidence.end());
  double sum = 0;
  for (double& e : log_evidence) sum += e = std::exp(e - top);
  for (double& e : log_evidence) e /= sum;
  return log_evidence;
}

}  // namespace

Analysis analyze(const Mesh& mesh, const Model& model, const Stations& stations, const LabelingRequest& request,
                 Context& context) {
  Analysis analysis;
  Stopwatch watch;
  const auto lap = [&](const char* station) { analysis.timings.emplace_back(station, watch.lap_ms()); };

  analysis.mesh = apply_filters(mesh, stations.filters, context);
  lap("filter");
  const MeshView& view = analysis.mesh.view();
  analysis.sets = guard(stations.worksets_id, [&] {
    return classify_mesh(view, *stations.worksets, stations.worksets_id, stations.workset_types, context);
  });
  const BitMatrix overlap = overlaps(analysis.sets, view.vertex_count());
  lap("classify");
  analysis.features = construct_features(view, model, analysis.sets, overlap, stations, context);
  lap("fit");
  const LabelingProblem problem = build_problem(view, model, analysis.features, overlap, stations, context);
  lap("relate");

  for (ClassOutcome& posed : pose_classes(problem, model, stations.probability))
    analysis.classes.push_back(solve(std::move(posed), model, analysis.features, stations, request, context));
  analysis.class_probabilities = class_probabilities(analysis.classes);
  analysis.best = static_cast<std::size_t>(
      std::max_element(analysis.class_probabilities.begin(), analysis.class_probabilities.end() - 1) -
      analysis.class_probabilities.begin());
  lap("label");
  if (context.cancelled()) throw Error("interrupted", interrupted_exit_code);
  return analysis;
}

}  // namespace toposcope
