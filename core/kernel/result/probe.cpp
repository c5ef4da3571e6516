// SPDX-License-Identifier: BSD-3-Clause
#include "result/probe.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "model/model_words.h"
#include "pipeline/construct_features.h"
#include "result/relation_report.h"
#include "toposcope/labeling/tools.h"

namespace toposcope {
namespace {

std::string joined(const std::vector<std::string>& words) {
  return fmt::format("{}", fmt::join(words, " + "));
}

/// The bound of a feature that costs groups and whose nearest value misses it least.
const BoundCount* nearest_bound(const CandidateCount& count) {
  const BoundCount* nearest = nullptr;
  double least = std::numeric_limits<double>::infinity();
  for (const BoundCount& each : count.bounds) {
    const double miss = std::abs(each.nearest - each.limit) / std::max(std::abs(each.limit), 1e-300);
    if (!(miss < least)) continue;
    least = miss;
    nearest = &each;
  }
  return nearest;
}

/// "radius < 0.57*bb(O).a": the value with some room, over the longest side to the power of its dimension.
std::string roomy_bound(const BoundCount& bound, const ModelFeature& feature, double side) {
  const Index r = bound.bound / 2;
  const bool is_error = r >= feature.ranges.size();
  const bool upper = is_error || bound.bound % 2 == 1;
  const Expression& old = is_error ? *feature.max_fit_error : upper ? *feature.ranges[r].high : *feature.ranges[r].low;
  const int dimension = old.dimension();
  const double value = bound.nearest + (upper ? 0.02 : -0.02) * std::abs(bound.nearest);  // so that it is within
  std::string text = fmt::format("{:.3g}", dimension == 0 ? value : value / std::pow(side, dimension));
  for (int k = 0; k < dimension; ++k) text += "*bb(O).a";
  const std::string name = is_error ? "max_fit_error" : feature.ranges[r].measure;
  return upper ? name + " < " + text : text + " < " + name;
}

/// Takes away one bound of a feature.
void open_bound(ModelFeature& feature, Index bound) {
  if (bound / 2 >= feature.ranges.size())
    feature.max_fit_error.reset();
  else if (bound % 2 == 1)
    feature.ranges[bound / 2].high.reset();
  else
    feature.ranges[bound / 2].low.reset();
}

double value_of(const FittedShape& shape, const ModelFeature& feature, Index bound) {
  if (bound / 2 >= feature.ranges.size()) return shape.rms;
  const Measure* measure = shape.measure(feature.ranges[bound / 2].measure);
  return measure ? measure->value : std::numeric_limits<double>::quiet_NaN();
}

/// How far a shape misses the bounds that were opened, in parts of each.
double miss_of(const FittedShape& shape, const ModelFeature& feature, const std::vector<BoundCount>& opened) {
  double sum = 0;
  for (const BoundCount& each : opened)
    sum += std::abs(value_of(shape, feature, each.bound) - each.limit) / std::max(std::abs(each.limit), 1e-300);
  return std::isnan(sum) ? std::numeric_limits<double>::infinity() : sum;
}

/// Gives the bounds the values of the group that came in and misses them least: what was nearest to one bound may have
/// missed another.
void take_values(const ConstructedFeatures& constructed, const ModelFeature& feature, Index index,
                 std::vector<BoundCount>& opened) {
  const std::vector<Index>& in = constructed.of_feature[index].constructed;
  const auto nearest = *std::min_element(in.begin(), in.end(), [&](Index a, Index b) {
    return miss_of(constructed.all[a].shape, feature, opened) < miss_of(constructed.all[b].shape, feature, opened);
  });
  const FittedShape& shape = constructed.all[nearest].shape;
  std::erase_if(opened, [&](BoundCount& each) {
    each.nearest = value_of(shape, feature, each.bound);
    const bool upper = each.bound / 2 >= feature.ranges.size() || each.bound % 2 == 1;
    return upper ? each.nearest < each.limit : each.nearest > each.limit;
  });
}

/// Opens the bound whose nearest value misses it least, again and again, until a group comes in.
void find_changes(const Analysis& analysis, const Model& model, const Stations& stations, Index feature,
                  Context& context, FeatureProbe& probed) {
  Model opened = model;
  CandidateCount count = probed.count;
  std::vector<BoundCount> gone;
  for (std::size_t round = 0; round <= 2 * model.features[feature].ranges.size(); ++round) {
    const BoundCount* bound = nearest_bound(count);
    if (!bound) break;
    gone.push_back(*bound);
    open_bound(opened.features[feature], bound->bound);
    const ModelRun run{analysis.mesh.view(), opened, stations, context};
    const ConstructedFeatures constructed = construct_features(run, analysis.sets);
    count = constructed.of_feature[feature].count;
    if (count.kept == 0) continue;
    probed.enough = true;
    take_values(constructed, model.features[feature], feature, gone);
    break;
  }
  for (const BoundCount& bound : gone)
    probed.changes.push_back({bound.words, bound.nearest, bound.limit,
                              roomy_bound(bound, model.features[feature], analysis.mesh.view().box.a())});
}

}  // namespace

FeatureProbe probe(const Analysis& analysis, const Model& model, const Stations& stations, Index feature,
                   std::size_t most, Context& context) {
  const ModelRun run{analysis.mesh.view(), model, stations, context};
  const ClassOutcome& posed = analysis.classes[analysis.best];
  const ModelFeature& asked = model.features[feature];
  FeatureProbe probed{
      asked.name, joined(asked.worksets), shapes_in_words(asked), analysis.features.of_feature[feature].count, {}, {},
      false};
  const auto place = std::find(posed.features.begin(), posed.features.end(), feature);
  if (place == posed.features.end()) return probed;
  const auto v = static_cast<Index>(place - posed.features.begin());
  const LabelingVariable& variable = posed.problem.variables[v];
  if (variable.candidates.empty()) find_changes(analysis, model, stations, feature, context, probed);
  Labeling trial = posed.answer;
  trial.values[v] = 0;
  const double missing = cost_of(posed.problem, trial.values);
  for (Index value = 1; value < variable.domain() && probed.candidates.size() < most; ++value) {
    ProbedCandidate& candidate = probed.candidates.emplace_back();
    trial.values[v] = value;
    candidate.rank = value;
    candidate.labelled = posed.answer.values[v] == value;
    candidate.in_conflict = !meets_exclusions(posed.problem, trial.values);
    candidate.probability = posed.outcome.posteriors.empty() ? std::numeric_limits<double>::quiet_NaN()
                                                             : posed.outcome.posteriors[v][value];
    candidate.evidence = analysis.features.of_feature[feature].evidence[value - 1];
    candidate.cost = cost_of(posed.problem, trial.values) - missing;
    candidate.shape = analysis.features.all[variable.candidates[value - 1]].shape;
    for (Index c = 0; c < posed.problem.constraints.size(); ++c) {
      const auto& scope = posed.problem.constraints[c].scope;
      if (std::find(scope.begin(), scope.end(), v) != scope.end())
        candidate.relations.push_back(report_relation(run, posed, analysis.features, c, trial));
    }
  }
  return probed;
}

}  // namespace toposcope
