// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/constructed_features.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "pipeline/same_shape.h"
#include "pipeline/working_set_groups.h"
#include "plugin/plugin_host.h"
#include "toposcope/geometry.h"

namespace toposcope {
namespace {

constexpr std::size_t grain = 8;

/// Features that ask for the same shape of the same types share their fits.
struct FitJob {
  const ModelFeature* feature;  ///< the first of them
  const std::vector<std::string>* types;
  const std::vector<OptionValue>* arguments;
  const ShapeFitter* fitter;
  std::vector<Index> features;
};

std::vector<FitJob> fit_jobs(const Model& model, const Stations& stations) {
  std::vector<FitJob> jobs;
  for (Index f = 0; f < model.features.size(); ++f) {
    const ModelFeature& feature = model.features[f];
    const auto same = std::find_if(jobs.begin(), jobs.end(), [&](const FitJob& job) {
      return job.feature->shape.plugin == feature.shape.plugin && job.feature->worksets == feature.worksets &&
             *job.arguments == stations.shape_arguments[f];
    });
    if (same != jobs.end())
      same->features.push_back(f);
    else
      jobs.push_back({&feature,
                      &feature.worksets,
                      &stations.shape_arguments[f],
                      stations.shapes.at(feature.shape.plugin).get(),
                      {f}});
  }
  return jobs;
}

struct Bounds {
  double low, high;
};
Bounds evaluate(const Range& range, const ExpressionBoxes& boxes) {
  const Interval all;
  return {range.low ? range.low->evaluate(boxes) : all.low, range.high ? range.high->evaluate(boxes) : all.high};
}

bool uses_working_set_box(const ModelFeature& feature) {
  const auto uses = [](const std::optional<Expression>& e) { return e && e->uses_worksets(); };
  return uses(feature.max_fit_error) || std::any_of(feature.ranges.begin(), feature.ranges.end(),
                                                    [&](const Range& r) { return uses(r.low) || uses(r.high); });
}

/// A fit with a number that is none would poison every relation it enters.
bool finite(const FittedShape& shape) {
  const double numbers[] = {shape.rms,          shape.explained,   shape.unexplained,     shape.coverage,
                            shape.direction_sd, shape.centroid_sd, shape.direction.sum(), shape.centroid.sum()};
  return std::all_of(std::begin(numbers), std::end(numbers), [](double x) { return std::isfinite(x); });
}

enum class Fate : std::uint8_t { boxed_out, unusable, out_of_range, poor_fit, fitted };

/// What becomes of a group for one feature, as far as boxes tell.
Fate fate_before(const ModelFeature& feature, const FitJob& job, const ExpressionBoxes& boxes,
                 std::span<const Box> set_boxes) {
  for (const Range& range : feature.ranges) {
    const Bounds bounds = evaluate(range, boxes);
    const Interval possible = job.fitter->bounds(range.measure, set_boxes, Options(*job.arguments));
    if (possible.high <= bounds.low || possible.low >= bounds.high) return Fate::boxed_out;
  }
  return Fate::fitted;
}

/// The same once it is fitted.
Fate fate_after(const ModelFeature& feature, const ExpressionBoxes& boxes, const FittedShape& shape) {
  if (!shape.summary.usable() || !finite(shape)) return Fate::unusable;
  for (const Range& range : feature.ranges) {
    const Bounds bounds = evaluate(range, boxes);
    const Measure* measure = shape.measure(range.measure);
    if (!measure || !(measure->value > bounds.low && measure->value < bounds.high)) return Fate::out_of_range;
  }
  if (feature.max_fit_error && shape.rms > feature.max_fit_error->evaluate(boxes)) return Fate::poor_fit;
  return Fate::fitted;
}

/// The fits of one job, with their fates for each of its features; one entry per group.
struct JobResult {
  std::vector<FittedShape> shapes;
  std::vector<Box> boxes;
  std::vector<std::vector<Fate>> fates;  ///< per feature of the job, per group
};

JobResult run_job(const FitJob& job, const WorkingSetGroups& groups, const MeshView& mesh, const Model& model,
                  const WorkingSets& sets, std::span<const double> vertex_areas, std::span<const Box> set_boxes,
                  Context& context) {
  JobResult result;
  result.shapes.resize(groups.size());
  result.boxes.resize(groups.size());
  result.fates.assign(job.features.size(), std::vector<Fate>(groups.size(), Fate::boxed_out));
  const bool needs_box = std::any_of(job.features.begin(), job.features.end(),
                                     [&](Index f) { return uses_working_set_box(model.features[f]); });
  context.parallel_for(groups.size(), grain, [&](std::size_t first, std::size_t last) {
    GroupPoints at;
    std::vector<Box> boxes_of_group;
    for (std::size_t g = first; g < last && !context.cancelled(); ++g) {
      const std::span<const Index> group = groups[g];
      boxes_of_group.clear();
      for (Index s : group) boxes_of_group.push_back(set_boxes[s]);
      Box& box = result.boxes[g] = boxes_of_group.front();
      const bool joint_box = group.size() > 1 && needs_box;
      if (joint_box) {
        at.gather(mesh, vertex_areas, sets, group);
        box = oriented_box(at.points);
      }
      bool wanted = false;
      for (std::size_t i = 0; i < job.features.size(); ++i) {
        result.fates[i][g] = fate_before(model.features[job.features[i]], job, {mesh.box, box}, boxes_of_group);
        wanted = wanted || result.fates[i][g] == Fate::fitted;
      }
      if (!wanted) continue;
      if (!joint_box) at.gather(mesh, vertex_areas, sets, group);
      if (!joint_box && group.size() > 1) box = principal_box(at.points);
      const FitInput input{at.points, at.areas, at.offsets, boxes_of_group, box, mesh.box, mesh.mean_edge};
      result.shapes[g] = job.fitter->fit(input, Options(*job.arguments), context);
      for (std::size_t i = 0; i < job.features.size(); ++i)
        if (Fate& fate = result.fates[i][g]; fate == Fate::fitted)
          fate = fate_after(model.features[job.features[i]], {mesh.box, box}, result.shapes[g]);
    }
  });
  return result;
}

void count(CandidateCount& count, std::span<const Fate> fates) {
  count.groups += fates.size();
  for (Fate fate : fates) switch (fate) {
      case Fate::boxed_out:
        ++count.boxed_out;
        break;
      case Fate::unusable:
        ++count.unusable;
        break;
      case Fate::out_of_range:
        ++count.out_of_range;
        break;
      case Fate::poor_fit:
        ++count.poor_fit;
        break;
      case Fate::fitted:
        ++count.kept;
        break;
    }
}

/// Half of the greatest error that the model allows is a typical one; where it says nothing, the pipeline does.
double fit_error_sd(const ModelFeature& feature, const MeshView& mesh, const Box& worksets, const Stations& stations) {
  if (feature.max_fit_error)
    return positive_on_mesh(*feature.max_fit_error, {mesh.box, worksets}, feature.where, "max_fit_error") / 2;
  return stations.probability.fit_error_scale * mesh.mean_edge;
}

/// A candidate there was, or behind them a group that may become one.
struct Choice {
  double cost;  ///< log of the number of choices less the evidence
  std::size_t place;
  const FittedShape* shape;
  std::span<const Index> sets;
  bool operator<(const Choice& other) const { return cost != other.cost ? cost < other.cost : place < other.place; }
};

/// Of the groups from `first` on, those in the same places with the same shape become one choice, the best: it gets the
/// sum of their likelihoods. Nested sets make many such groups, none of which would stand out by itself.
/// \param choices  ascending
void join_levels(std::vector<Choice>& choices, std::size_t first, const ShapeFitter& fitter, double same,
                 const BitMatrix& overlap) {
  std::vector<Choice> joined;
  for (const Choice& choice : choices) {
    const auto like = std::find_if(joined.begin(), joined.end(), [&](const Choice& other) {
      return choice.place >= first && same_places(overlap, choice.sets, other.sets) &&
             same_shape(fitter, *choice.shape, *other.shape, same);
    });
    if (like == joined.end())
      joined.push_back(choice);
    else
      like->cost -= std::log1p(std::exp(like->cost - choice.cost));
  }
  std::sort(joined.begin(), joined.end());
  choices = std::move(joined);
}

/// Adds the candidates of each feature of a job to those that `out` has, of which the best are kept.
void select(const FitJob& job, const WorkingSetGroups& groups, const JobResult& result, const MeshView& mesh,
            const Model& model, const WorkingSets& sets, std::span<const double> vertex_areas,
            std::optional<std::size_t> chosen_from, const BitMatrix& overlap, const Stations& stations,
            ConstructedFeatures& out) {
  constexpr Index unmade = std::numeric_limits<Index>::max();
  std::vector<Index> made(groups.size(), unmade);  // into out.all
  std::vector<Choice> choices;
  GroupPoints at;
  for (std::size_t i = 0; i < job.features.size(); ++i) {
    const ModelFeature& feature = model.features[job.features[i]];
    FeatureCandidates& candidates = out.of_feature[job.features[i]];
    count(candidates.count, result.fates[i]);
    const FeatureCandidates old = candidates;
    const std::size_t before = old.constructed.size();
    const auto fitted = static_cast<double>(std::count(result.fates[i].begin(), result.fates[i].end(), Fate::fitted));
    // Of groups that were not tried as many would have passed as of those that were.
    const double tried = static_cast<double>(std::max<std::size_t>(1, groups.size()));
    const double ways = std::max(1.0, fitted * (chosen_from ? static_cast<double>(*chosen_from) / tried : 1));
    choices.clear();
    for (std::size_t c = 0; c < before; ++c) {
      const ConstructedFeature& constructed = out.all[old.constructed[c]];
      choices.push_back({std::log(old.ways[c]) - old.evidence[c], c, &constructed.shape, constructed.sets});
    }
    for (Index g = 0; g < groups.size(); ++g) {
      if (result.fates[i][g] != Fate::fitted) continue;
      const FittedShape& shape = result.shapes[g];
      const double evidence =
          fit_evidence(stations.probability, shape, fit_error_sd(feature, mesh, result.boxes[g], stations));
      choices.push_back({std::log(ways) - evidence, before + g, &shape, groups[g]});
    }
    std::sort(choices.begin(), choices.end());
    const std::size_t all = choices.size();
    if (chosen_from) join_levels(choices, before, *job.fitter, mesh.mean_edge, overlap);
    choices.resize(std::min(choices.size(), stations.probability.max_candidates));
    candidates.count.beaten += all - choices.size();
    candidates.count.kept -= all - choices.size();
    candidates.constructed.clear();
    candidates.evidence.clear();
    candidates.ways.clear();
    for (const Choice& choice : choices) {
      const std::size_t place = choice.place;
      candidates.ways.push_back(place < before ? old.ways[place] : ways);
      candidates.evidence.push_back(std::log(candidates.ways.back()) - choice.cost);
      if (place < before) {
        candidates.constructed.push_back(old.constructed[place]);
        continue;
      }
      const Index g = static_cast<Index>(place - before);
      if (made[g] == unmade) {
        made[g] = static_cast<Index>(out.all.size());
        ConstructedFeature& constructed = out.all.emplace_back();
        constructed.sets.assign(groups[g].begin(), groups[g].end());
        constructed.shape = result.shapes[g];
        at.gather(mesh, vertex_areas, sets, groups[g]);
        constructed.points = at.points;
        constructed.box = groups.arity() == 1 ? result.boxes[g] : oriented_box(constructed.points);
      }
      candidates.constructed.push_back(made[g]);
    }
  }
}

/// Of the sets that a feature of the model asks for.
std::vector<Box> boxes_of(const WorkingSets& sets, const Model& model, const MeshView& mesh, Context& context) {
  std::vector<char> asked(sets.type_names.size(), 0);
  for (const ModelFeature& feature : model.features)
    for (const std::vector<std::string>* types : {&feature.worksets, &feature.second_look})
      for (std::size_t t = 0; t < asked.size(); ++t)
        if (std::find(types->begin(), types->end(), sets.type_names[t]) != types->end()) asked[t] = 1;
  std::vector<Box> boxes(sets.size());
  context.parallel_for(sets.size(), grain, [&](std::size_t first, std::size_t last) {
    std::vector<Vec3> points;
    for (std::size_t s = first; s < last; ++s) {
      if (asked[sets.types[s]] == 0) continue;
      points.clear();
      for (Index v : sets[s]) points.push_back(mesh.positions[v]);
      boxes[s] = oriented_box(points);
    }
  });
  return boxes;
}

void construct(const FitJob& job, const WorkingSetGroups& groups, const MeshView& mesh, const Model& model,
               const WorkingSets& sets, std::span<const double> vertex_areas, std::optional<std::size_t> chosen_from,
               const BitMatrix& overlap, const Stations& stations, Context& context, ConstructedFeatures& features) {
  const JobResult result = guard(job.feature->shape.plugin, [&] {
    return run_job(job, groups, mesh, model, sets, vertex_areas, features.set_boxes, context);
  });
  select(job, groups, result, mesh, model, sets, vertex_areas, chosen_from, overlap, stations, features);
}

}  // namespace

ConstructedFeatures construct_features(const MeshView& mesh, const Model& model, const WorkingSets& sets,
                                       const BitMatrix& overlap, const Stations& stations, Context& context) {
  ConstructedFeatures features;
  features.set_boxes = boxes_of(sets, model, mesh, context);
  features.of_feature.resize(model.features.size());
  const std::vector<double> vertex_areas = areas_of_vertices(mesh);
  const std::vector<FitJob> jobs = fit_jobs(model, stations);
  for (std::size_t j = 0; j < jobs.size(); ++j) {
    const WorkingSetGroups groups(*jobs[j].feature, *jobs[j].types, sets, overlap);
    construct(jobs[j], groups, mesh, model, sets, vertex_areas, {}, overlap, stations, context, features);
    context.progress(static_cast<double>(j + 1) / static_cast<double>(jobs.size()));
  }
  return features;
}

void construct_more(const MeshView& mesh, const Model& model, const WorkingSets& sets, Index feature,
                    const WorkingSetGroups& groups, std::size_t chosen_from, const BitMatrix& overlap,
                    const Stations& stations, Context& context, ConstructedFeatures& features) {
  const ModelFeature& asking = model.features[feature];
  const FitJob job{&asking,
                   &asking.second_look,
                   &stations.shape_arguments[feature],
                   stations.shapes.at(asking.shape.plugin).get(),
                   {feature}};
  construct(job, groups, mesh, model, sets, areas_of_vertices(mesh), chosen_from, overlap, stations, context, features);
}

}  // namespace toposcope
