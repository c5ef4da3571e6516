// SPDX-License-Identifier: BSD-3-Clause
#include "learn/observe.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "base/errors.h"
#include "model/model_words.h"
#include "pipeline/analysis.h"
#include "pipeline/bound_relation.h"
#include "probability/likelihood.h"
#include "toposcope/geometry/point_sets.h"
#include "truth/judgement.h"

namespace toposcope {
namespace {

/// The shape of the marks themselves, each group of them a set.
FittedShape fit_marks(const TruthFeature& truth, const FeatureStation& station, const ModelRun& run) {
  std::vector<Vec3> points;
  std::vector<Index> offsets = {0};
  std::vector<Box> boxes;
  const auto close_set = [&] {
    boxes.push_back(oriented_box(std::span(points).subspan(offsets.back())));
    offsets.push_back(static_cast<Index>(points.size()));
  };
  for (const TruthGroup& group : truth.groups) {
    for (const Index member : group.members) points.push_back(truth.points[member]);
    if (points.size() > offsets.back()) close_set();
  }
  if (truth.groups.empty()) {
    points = truth.points;
    close_set();
  }
  const std::vector<double> areas(points.size(), run.mesh.mean_edge * run.mesh.mean_edge);
  return station.fitter->fit({points, areas, offsets, boxes, oriented_box(points), run.mesh.box, run.mesh.mean_edge},
                             Options(station.arguments), run.context);
}

class Observer {
 public:
  Observer(const Analysis& analysis, const ModelRun& run, const Truth& truth)
      : analysis_(analysis), run_(run), truth_(truth) {
    scale_.mean_edge = truth.mean_edge.value_or(analysis.mesh.input->view().mean_edge);
    scale_.diagonal = truth.diagonal.value_or(run.mesh.box.diagonal());
  }

  SeenFeature feature(Index f) {
    SeenFeature seen;
    right_.push_back(nullptr);
    const TruthFeature* known = truth_.find(run_.model.features[f].name);
    seen.marked = known != nullptr;
    if (!known || !known->exists()) return seen;
    seen.exists = true;
    right_.back() = right_candidate(f, *known);
    seen.offered = right_.back() != nullptr;
    if (seen.offered) {
      note_measures(f, right_.back()->shape, seen);
      return seen;
    }
    const FittedShape shape = fit_marks(*known, run_.stations.features[f], run_);
    if (!shape.summary.usable()) return seen;
    note_measures(f, shape, seen);
    note_broken(f, shape, oriented_box(known->points), seen);
    return seen;
  }

  SeenRelation relation(Index r) const {
    SeenRelation seen;
    seen.unit = run_.stations.relationships[r].unit;
    std::vector<const ConstructedFeature*> given;
    for (const Index f : run_.model.relationships[r].features) given.push_back(right_[f]);
    if (std::find(given.begin(), given.end(), nullptr) != given.end()) return seen;
    const RelationResult result = test_relationship(run_, r, given);
    seen.tested = true;
    seen.applicable = result.applicable;
    seen.satisfied = violation(result) <= 1;
    const double unit = seen.unit == "deg" ? pi / 180 : run_.mesh.box.a();
    seen.residual = result.residual / unit;
    seen.tolerance = result.tolerance / unit;
    return seen;
  }

 private:
  /// The candidate that is nearest to the marks, if it is near enough.
  const ConstructedFeature* right_candidate(Index f, const TruthFeature& known) const {
    const ConstructedFeature* best = nullptr;
    double least = 1;
    for (const Index candidate : analysis_.features.of_feature[f].constructed) {
      const ConstructedFeature& made = analysis_.features.all[candidate];
      const double excess = excess_of(made.shape, *made.fitter, known, scale_);
      if (!(excess <= least)) continue;
      least = excess;
      best = &made;
    }
    return best;
  }

  void note_measures(Index f, const FittedShape& shape, SeenFeature& seen) const {
    for (const Range& range : run_.model.features[f].ranges) {
      const Measure* measure = shape.measure(range.measure);
      if (!measure || !(measure->value > 0)) continue;
      // The literal 0 has no dimension: the other bound tells.
      const int power = std::max(range.low ? range.low->dimension() : 0, range.high ? range.high->dimension() : 0);
      for (const double side : run_.mesh.box.sides)
        seen.measures[range.measure].push_back(measure->value / std::pow(side, power));
    }
  }

  void note_broken(Index f, const FittedShape& shape, const Box& box, SeenFeature& seen) const {
    const ModelFeature& feature = run_.model.features[f];
    const ExpressionBoxes boxes{run_.mesh.box, box};
    for (Index r = 0; r < feature.ranges.size(); ++r) {
      const Range& range = feature.ranges[r];
      const Measure* measure = shape.measure(range.measure);
      if (!measure) continue;
      const auto note = [&](Index bound, double limit) {
        seen.broken.push_back(fmt::format("{} = {:.4g}, and the marks have {:.4g}", bound_in_words(feature, bound),
                                          limit, measure->value));
      };
      if (range.low && !(measure->value > range.low->evaluate(boxes))) note(2 * r, range.low->evaluate(boxes));
      if (range.high && !(measure->value < range.high->evaluate(boxes))) note(2 * r + 1, range.high->evaluate(boxes));
    }
  }

  const Analysis& analysis_;
  const ModelRun& run_;
  const Truth& truth_;
  Judgement scale_;
  std::vector<const ConstructedFeature*> right_;  ///< per feature; null: none
};

}  // namespace

Observation observe(const Mesh& mesh, const Truth& truth, const std::string& source, const Model& model,
                    const Stations& stations, Context& context) {
  const bool any = std::any_of(model.features.begin(), model.features.end(),
                               [&](const ModelFeature& feature) { return truth.find(feature.name); });
  if (!any) {
    std::string marked;
    for (const TruthFeature& feature : truth.features) marked += (marked.empty() ? "" : ", ") + feature.name;
    throw UsageError(source + ": marks none of the features of model '" + model.name + "'; it has marks of " +
                     (marked.empty() ? "nothing" : marked) + "; mark features by the names that the model gives them");
  }
  const Analysis analysis = construct(mesh, model, stations, context);
  const ModelRun run{analysis.mesh.view(), model, stations, context};
  Observer observer(analysis, run, truth);
  Observation observation{source, {}, {}};
  for (Index f = 0; f < model.features.size(); ++f) observation.features.push_back(observer.feature(f));
  for (Index r = 0; r < model.relationships.size(); ++r) observation.relations.push_back(observer.relation(r));
  return observation;
}

}  // namespace toposcope
