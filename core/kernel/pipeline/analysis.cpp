// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/analysis.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "base/errors.h"
#include "pipeline/labeling_problem.h"
#include "pipeline/places.h"
#include "pipeline/second_look.h"
#include "plugin/plugin_host.h"
#include "probability/symmetry.h"
#include "toposcope/labeling/tools.h"

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

/// Solves a problem for its labellings and, where the pipeline says so, again for its probabilities.
struct Solver {
  const Stations& stations;
  const LabelingRequest& request;
  Context& context;
  double label_ms = 0, marginals_ms = 0;  ///< the last problem's

  LabelingOutcome labelings(const LabelingProblem& problem) {
    return outcome_of(problem, *stations.labeler, stations.labeler_id, request);
  }

  void solve(ClassOutcome& posed) {
    Stopwatch watch;
    posed.outcome = labelings(posed.problem);
    LabelingOutcome& outcome = posed.outcome;
    const std::string* maker = &stations.labeler_id;
    std::string made = outcome.guarantee;
    label_ms = watch.lap_ms();
    marginals_ms = 0;
    if (stations.marginals) {
      LabelingRequest sums = request;
      sums.k_best = 1;
      LabelingOutcome marginals = outcome_of(posed.problem, *stations.marginals, stations.marginals_id, sums);
      outcome.posteriors = std::move(marginals.posteriors);
      outcome.posterior_exactness = marginals.posterior_exactness;
      outcome.posterior_error = marginals.posterior_error;
      outcome.log_evidence = marginals.log_evidence;
      outcome.evidence_exactness = marginals.evidence_exactness;
      outcome.evidence_error = marginals.evidence_error;
      maker = &stations.marginals_id;
      made = std::move(marginals.guarantee);
      marginals_ms = watch.lap_ms();
    }
    // Why there are none is worth a line where they were asked for.
    const bool any = !outcome.posteriors.empty() || !std::isnan(outcome.log_evidence);
    posed.probabilities = any || stations.marginals ? *maker + ": " + made : "";
  }

 private:
  LabelingOutcome outcome_of(const LabelingProblem& problem, const Labeler& labeler, const std::string& id,
                             const LabelingRequest& asked) {
    LabelingOutcome outcome = guard(id, [&] { return labeler.solve(problem, asked, context); });
    check_outcome(problem, outcome, id);
    return outcome;
  }
};

ClassOutcome solve(ClassOutcome posed, const Model& model, const ConstructedFeatures& features, Solver& solver) {
  solver.solve(posed);
  posed.label_ms = solver.label_ms;
  posed.marginals_ms = solver.marginals_ms;
  posed.nodes = posed.outcome.nodes;
  posed.lower_bound = posed.outcome.lower_bound;
  posed.least_cost = forbidden;
  for (const Labeling& labeling : posed.outcome.labelings) posed.least_cost = std::min(posed.least_cost, labeling.cost);
  const auto names =
      renamings({model, posed.features, posed.relationships, solver.stations.relation_ordered, model.classes.empty()});
  // What differs in names that mean the same is one explanation, not several.
  posed.log_evidence = posed.outcome.log_evidence - std::log(static_cast<double>(names.size()));
  const auto orbits = orbits_of(names);
  const auto kept = one_side(posed, orbits, features);
  bool changed = false;
  for (Index v = 0; v < kept.size(); ++v) changed = changed || kept[v].size() < posed.problem.variables[v].domain();
  if (changed) {
    posed.problem = restricted(posed.problem, kept);
    solver.solve(posed);
  }
  const Labeling& best = posed.answer = posed.outcome.labelings.front();
  posed.complete = std::all_of(best.values.begin(), best.values.end(), [](Index value) { return value > 0; });
  for (const LabelingConstraint& constraint : posed.problem.constraints)
    posed.complete = posed.complete && satisfied(constraint, table_entry(posed.problem, constraint, best.values));
  return posed;
}

/// The constructed feature of each model feature in the labelling of least cost over the classes.
std::vector<std::optional<Index>> first_labeling(const LabelingProblem& problem, const Model& model,
                                                 const Stations& stations, Context& context) {
  std::vector<std::optional<Index>> labelled(model.features.size());
  double least = std::numeric_limits<double>::infinity();
  const LabelingRequest request;
  for (const ClassOutcome& posed : pose_classes(problem, model, stations.probability)) {
    const Labeling best = Solver{stations, request, context}.labelings(posed.problem).labelings.front();
    if (!(best.cost < least)) continue;
    least = best.cost;
    std::fill(labelled.begin(), labelled.end(), std::nullopt);
    for (Index v = 0; v < best.values.size(); ++v)
      if (best.values[v] > 0) labelled[posed.features[v]] = posed.problem.variables[v].candidates[best.values[v] - 1];
  }
  return labelled;
}

}  // namespace

std::vector<double> comparable_evidence(const std::vector<Explained>& classes) {
  const bool summed =
      std::none_of(classes.begin(), classes.end(), [](const Explained& c) { return std::isnan(c.log_evidence); });
  std::vector<double> evidence;
  for (const Explained& c : classes) evidence.push_back(summed ? c.log_evidence : -c.least_cost);
  return evidence;
}

std::vector<double> class_probabilities(std::vector<double> log_evidence) {
  log_evidence.push_back(0);  // everything is clutter
  const double top = *std::max_element(log_evidence.begin(), log_evidence.end());
  double sum = 0;
  for (double& e : log_evidence) sum += e = std::exp(e - top);
  for (double& e : log_evidence) e /= sum;
  return log_evidence;
}

Analysis construct(const Mesh& mesh, const Model& model, const Stations& stations, Context& context) {
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
  analysis.problem = build_problem(view, model, analysis.features, overlap, stations, context);
  lap("relate");
  if (has_second_look(model)) {
    const auto labelled = first_labeling(analysis.problem, model, stations, context);
    if (look_again(view, model, analysis.sets, overlap, labelled, stations, context, analysis.features))
      analysis.problem = build_problem(view, model, analysis.features, overlap, stations, context, &analysis.problem);
    lap("second_look");
  }
  if (context.cancelled()) throw Error("interrupted", interrupted_exit_code);
  return analysis;
}

void label(Analysis& analysis, const Model& model, const Stations& stations, const LabelingRequest& request,
           Context& context) {
  Stopwatch watch;
  Solver solver{stations, request, context};
  std::vector<Explained> explained;
  double marginals_ms = 0;
  analysis.classes.clear();
  for (ClassOutcome& posed : pose_classes(analysis.problem, model, stations.probability)) {
    analysis.classes.push_back(solve(std::move(posed), model, analysis.features, solver));
    const ClassOutcome& solved = analysis.classes.back();
    explained.push_back({solved.log_evidence, solved.least_cost});
    marginals_ms += solved.marginals_ms;
  }
  analysis.class_evidence = comparable_evidence(explained);
  analysis.class_probabilities = class_probabilities(analysis.class_evidence);
  analysis.best =
      static_cast<std::size_t>(std::max_element(analysis.class_evidence.begin(), analysis.class_evidence.end()) -
                               analysis.class_evidence.begin());
  std::erase_if(analysis.timings, [](const auto& each) { return each.first == "label" || each.first == "marginals"; });
  analysis.timings.emplace_back("label", watch.lap_ms() - marginals_ms);
  if (stations.marginals) analysis.timings.emplace_back("marginals", marginals_ms);
  if (context.cancelled()) throw Error("interrupted", interrupted_exit_code);
}

Analysis analyze(const Mesh& mesh, const Model& model, const Stations& stations, const LabelingRequest& request,
                 Context& context) {
  Analysis analysis = construct(mesh, model, stations, context);
  label(analysis, model, stations, request, context);
  Stopwatch watch;
  ClassOutcome& best = analysis.classes[analysis.best];
  best.answer = in_most_probable_places(best, model, analysis, stations, context);
  for (auto& [station, ms] : analysis.timings)
    if (station == "label") ms += watch.lap_ms();
  return analysis;
}

}  // namespace toposcope
