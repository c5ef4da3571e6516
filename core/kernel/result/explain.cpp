// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/sha256.h"
#include "mesh/content_hash.h"
#include "model/model_words.h"
#include "pipeline/most_probable_shapes.h"
#include "result/relation_report.h"
#include "result/result.h"
#include "toposcope/labeling/tools.h"

namespace toposcope {
namespace {

/// Reads one labelling of the best class.
class Explainer {
 public:
  Explainer(const Analysis& analysis, const ModelRun& run)
      : analysis_(analysis), run_(run), posed_(analysis.classes[analysis.best]), best_(posed_.answer) {}

  RelationReport relation(Index constraint, const Labeling& labeling) const {
    return report_relation(run_, posed_, analysis_.features, constraint, labeling);
  }

  FeatureReport feature(Index model_feature) const {
    FeatureReport report;
    report.name = run_.model.features[model_feature].name;
    report.shape_plugin = run_.model.features[model_feature].shape.plugin;
    const auto found = std::find(posed_.features.begin(), posed_.features.end(), model_feature);
    if (found == posed_.features.end()) {
      report.probability = 1;
      report.missing.reason = "class '" + posed_.name + "' has no such feature";
      return report;
    }
    const Index v = static_cast<Index>(found - posed_.features.begin());
    const Index value = best_.values[v];
    report.present = value > 0;
    report.probability = probability(v, value);
    if (report.present) {
      const ConstructedFeature& made = constructed(v, value);
      if (posed_.sides && posed_.sides->named[v]) report.probability *= posed_.sides->probability;
      report.evidence = -price_over_missing(best_, v).cost;
      report.shape = made.shape;
      report.shape_plugin = made.plugin;
      report.working_sets = made.sets;
      report.triangles = triangles_of(made);
      for (Index t : report.triangles) report.faces.push_back(analysis_.mesh.input->face_origin()[t]);
      std::sort(report.faces.begin(), report.faces.end());
      report.faces.erase(std::unique(report.faces.begin(), report.faces.end()), report.faces.end());
    } else {
      report.missing = why_missing(model_feature, v);
      if (report.probability < 0.5) report.missing.reason += "; " + why_unlikely(v, report.probability);
    }
    return report;
  }

 private:
  const ConstructedFeature& constructed(Index variable, Index value) const {
    return analysis_.features.all[posed_.problem.variables[variable].candidates[value - 1]];
  }

  double probability(Index v, Index value) const {
    if (posed_.outcome.posteriors.empty()) return std::numeric_limits<double>::quiet_NaN();
    return probability_of_shape(posed_, v, value, analysis_.features, run_);
  }

  /// Triangles of the input whose faces have two vertices in the working sets.
  std::vector<Index> triangles_of(const ConstructedFeature& made) const {
    const MeshView& view = run_.mesh;
    std::vector<bool> inside(view.vertex_count(), false), which(view.face_count());
    for (Index s : made.sets)
      for (Index v : analysis_.sets[s]) inside[v] = true;
    for (Index f = 0; f < view.face_count(); ++f) {
      const auto& [a, b, c] = view.triangles[f];
      which[f] = inside[a] + inside[b] + inside[c] >= 2;
    }
    return analysis_.mesh.input_triangles(which);
  }

  /// Of a feature that is missing though it more likely is not: why no shape stands for it.
  std::string why_unlikely(Index v, double missing) const {
    const double most = most_of_a_shape(posed_, v, analysis_.features, run_);
    const std::string there = fmt::format("it is there with {:.3f}, ", 1 - missing);
    return there + (most > missing
                        ? fmt::format("but no labelling has it in its most probable shape ({:.3f}) beside the "
                                      "most probable shapes of the others",
                                      most)
                        : fmt::format("but as no one shape with more than {:.3f}", most));
  }

  MissingReport why_missing(Index model_feature, Index v) const {
    MissingReport report;
    const LabelingVariable& variable = posed_.problem.variables[v];
    if (variable.candidates.empty()) {
      report.reason = no_candidate(run_.model.features[model_feature],
                                   analysis_.features.of_feature[analysis_.origin(model_feature)].count);
      return report;
    }
    report.conflict = conflict_of_missing(posed_.problem, best_, v, run_.context);
    Labeling trial = best_;
    Index nearest = 0, in_conflict = 0;
    Price least{std::numeric_limits<std::size_t>::max(), 0};
    for (Index value = 1; value < variable.domain(); ++value) {
      trial.values[v] = value;
      if (!meets_exclusions(posed_.problem, trial.values)) {
        ++in_conflict;
        continue;
      }
      if (const Price price = price_over_missing(trial, v); price < least) {
        least = price;
        nearest = value;
      }
    }
    if (nearest == 0) {
      report.reason =
          "all " + std::to_string(in_conflict) + " candidates share their place with other labelled features";
      return report;
    }
    trial.values[v] = nearest;
    report.nearest_cost = least.cost;
    report.nearest = constructed(v, nearest).shape;
    for (Index c = 0; c < posed_.problem.constraints.size(); ++c) {
      const auto& scope = posed_.problem.constraints[c].scope;
      if (std::find(scope.begin(), scope.end(), v) == scope.end()) continue;
      RelationReport relation_report = relation(c, trial);
      if (relation_report.tested && !relation_report.satisfied) report.failed.push_back(std::move(relation_report));
    }
    report.reason = report.failed.empty()
                        ? "the nearest candidate does not stand out from the rest of the mesh"
                        : "the nearest candidate breaks " + std::to_string(report.failed.size()) + " relationship(s)";
    return report;
  }

  /// What labelling variable v adds over leaving it missing, all else as it is: relationships forbidden, and cost
  /// without these.
  struct Price {
    std::size_t forbidden;
    double cost;
    auto operator<=>(const Price&) const = default;  // NOLINT(modernize-use-nullptr): the check misreads <=>
  };
  Price price_over_missing(const Labeling& labeling, Index v) const {
    const LabelingVariable& variable = posed_.problem.variables[v];
    Price price{0, variable.costs[labeling.values[v]] - variable.costs[0]};
    for (const LabelingConstraint& constraint : posed_.problem.constraints) {
      if (std::find(constraint.scope.begin(), constraint.scope.end(), v) == constraint.scope.end()) continue;
      const double cost = constraint.costs[table_entry(posed_.problem, constraint, labeling.values)];
      if (cost < forbidden)
        price.cost += cost;
      else
        ++price.forbidden;
    }
    return price;
  }

  static std::string no_candidate(const ModelFeature& feature, const CandidateCount& count) {
    std::string types;
    for (const std::string& type : feature.worksets) types += (types.empty() ? "" : " + ") + type;
    if (count.groups == 0) return "no working set of type " + types;
    std::string reason =
        "none of " + std::to_string(count.groups) + " groups of working sets of type " + types + " became a candidate:";
    for (const BoundCount& bound : count.bounds)
      reason +=
          fmt::format(" {} break {} = {:.4g}{};", bound.groups, bound.words, bound.limit,
                      std::isfinite(bound.nearest) ? fmt::format(" (the nearest has {:.4g})", bound.nearest) : "");
    if (count.unusable > 0)
      reason += fmt::format(" {} are without a usable {};", count.unusable, shapes_in_words(feature));
    if (reason.back() == ';') reason.pop_back();
    return reason;
  }

  const Analysis& analysis_;
  const ModelRun& run_;
  const ClassOutcome& posed_;
  const Labeling& best_;
};

FamilyReport report_family(const FamilyCount& count, const Model& model) {
  const ModelFeature& feature = model.features[count.feature];
  FamilyReport report;
  report.name = feature.name;
  report.allowed = count_in_words(feature.count);
  report.found = count.found;
  report.numbers = count.numbers;
  report.probability =
      count.found < count.numbers.size() ? count.numbers[count.found] : std::numeric_limits<double>::quiet_NaN();
  if (count.beyond && count.beyond->first > 0.5) {
    report.more = count.beyond->first;
    report.likely = count.beyond->second;
  }
  return report;
}

}  // namespace

Result explain(const Analysis& analysis, const Model& given_model, const std::string& mesh_path,
               const Stations& given_stations, Context& context) {
  const Model& model = analysis.written_out(given_model);
  const Stations& stations = analysis.written_out(given_stations);
  const ClassOutcome& posed = analysis.classes[analysis.best];
  const LabelingOutcome& outcome = posed.outcome;
  const ModelRun run{analysis.mesh.view(), model, stations, context};
  const Explainer explainer(analysis, run);
  const MeshView& input = analysis.mesh.input->view();

  Result result;
  result.mesh_path = mesh_path;
  result.mesh_hash = content_hash(*analysis.mesh.input);
  result.vertices = input.vertex_count();
  result.faces = analysis.mesh.input->input_faces();
  result.box = input.box;
  result.mean_edge = input.mean_edge;
  if (analysis.mesh.coarse) {
    const MeshView& coarse = analysis.mesh.base();
    result.analysed = {coarse.vertex_count(), coarse.face_count(), coarse.mean_edge};
  }
  result.model = model.name;
  result.model_hash = sha256_of_text(model.document);
  result.log_evidence = posed.log_evidence;
  result.guarantee = outcome.guarantee;
  result.probabilities = posed.probabilities;
  result.probability_exactness = outcome.posterior_exactness;
  result.probability_error = outcome.posterior_error;
  result.optimal = outcome.optimal;
  result.working_sets = analysis.sets.size();
  result.timings = analysis.timings;
  result.plugins = stations.uses;
  for (std::size_t c = 0; c < analysis.classes.size(); ++c) {
    const ClassOutcome& each = analysis.classes[c];
    result.classes.push_back({each.name, each.log_evidence, each.least_cost, analysis.class_probabilities[c],
                              model.classes.empty() || each.complete});
  }
  if (!model.classes.empty() && posed.complete && analysis.class_evidence[analysis.best] > 0)
    result.class_name = posed.name;
  for (Index f = 0; f < model.features.size(); ++f) result.features.push_back(explainer.feature(f));
  for (Index f = 0; f < given_model.features.size(); ++f)
    result.candidates.emplace_back(given_model.features[f].name, analysis.features.of_feature[f].count);
  for (const FamilyCount& count : posed.families) result.families.push_back(report_family(count, given_model));
  result.sides = posed.sides;
  std::vector<const FittedShape*> found;
  for (const FeatureReport& report : result.features) found.push_back(report.present ? &report.shape : nullptr);
  result.measurements = measure(model, found, result.box);
  const Labeling& best = posed.answer;
  for (Index c = 0; c < posed.problem.constraints.size(); ++c) result.relations.push_back(explainer.relation(c, best));
  const auto present = std::count_if(best.values.begin(), best.values.end(), [](Index value) { return value > 0; });
  result.status = present == 0 ? "none" : present == std::ssize(best.values) ? "labelled" : "partial";
  for (std::size_t k = 0; k < outcome.labelings.size(); ++k) {
    if (outcome.labelings[k].values == best.values) continue;
    AlternativeReport& alternative = result.alternatives.emplace_back();
    alternative.cost = outcome.labelings[k].cost;
    // Not a number without evidence: `min` keeps its first argument then.
    alternative.probability = std::min(std::exp(-outcome.labelings[k].cost - outcome.log_evidence), 1.0);
    for (Index v = 0; v < best.values.size(); ++v)
      alternative.candidates.emplace_back(posed.problem.variables[v].name,
                                          static_cast<int>(outcome.labelings[k].values[v]));
  }
  return result;
}

}  // namespace toposcope
