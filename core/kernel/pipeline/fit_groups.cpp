// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/fit_groups.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "base/errors.h"
#include "plugin/guard.h"
#include "toposcope/geometry/point_sets.h"

namespace toposcope {
namespace {

constexpr std::size_t grain = 8;

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

/// As far as boxes tell.
GroupVerdict verdict_by_boxes(const ModelFeature& feature, const ShapeStation& station, const ExpressionBoxes& boxes,
                              std::span<const Box> set_boxes) {
  for (Index r = 0; r < feature.ranges.size(); ++r) {
    const Bounds bounds = evaluate(feature.ranges[r], boxes);
    const Interval possible = station.fitter->bounds(feature.ranges[r].measure, set_boxes, Options(station.arguments));
    if (possible.high <= bounds.low) return {GroupStatus::boxed_out, 2 * r, possible.high, bounds.low};
    if (possible.low >= bounds.high) return {GroupStatus::boxed_out, 2 * r + 1, possible.low, bounds.high};
  }
  return {GroupStatus::fitted};
}

/// Once it is fitted.
GroupVerdict verdict_by_fit(const ModelFeature& feature, const ExpressionBoxes& boxes, const FittedShape& shape) {
  if (!shape.summary.usable() || !finite(shape)) return {GroupStatus::unusable};
  for (Index r = 0; r < feature.ranges.size(); ++r) {
    const Bounds bounds = evaluate(feature.ranges[r], boxes);
    const Measure* measure = shape.measure(feature.ranges[r].measure);
    if (!measure && !feature.other_shapes.empty()) continue;  // it bounds another of the shapes
    const double value = measure ? measure->value : std::numeric_limits<double>::quiet_NaN();
    if (!(value > bounds.low)) return {GroupStatus::out_of_range, 2 * r, value, bounds.low};
    if (!(value < bounds.high)) return {GroupStatus::out_of_range, 2 * r + 1, value, bounds.high};
  }
  if (feature.max_fit_error)
    if (const double limit = feature.max_fit_error->evaluate(boxes); shape.rms > limit)
      return {GroupStatus::poor_fit, static_cast<Index>(2 * feature.ranges.size()), shape.rms, limit};
  return {GroupStatus::fitted};
}

/// Fits group after group of a job; one per thread.
class GroupFitter {
 public:
  GroupFitter(const FitJob& job, const ModelRun& run, const MeasuredWorkingSets& sets, GroupFits& fits)
      : job_(job),
        run_(run),
        sets_(sets),
        fits_(fits),
        station_(job.station(run.stations)),
        needs_box_(std::any_of(job.features.begin(), job.features.end(),
                               [&](Index f) { return uses_working_set_box(run.model.features[f]); })) {}

  void fit(std::size_t g) {
    const MeshView& mesh = run_.mesh;
    const std::span<const Index> group = fits_.groups[g];
    set_boxes_.clear();
    for (Index s : group) set_boxes_.push_back(sets_.boxes[s]);
    Box& box = fits_.boxes[g] = set_boxes_.front();
    const bool joint_box = group.size() > 1 && needs_box_;
    if (joint_box) {
      points_.gather(mesh, sets_, group);
      box = oriented_box(points_.points);
    }
    bool wanted = false;
    for (std::size_t i = 0; i < job_.features.size(); ++i) {
      fits_.verdicts[i][g] = verdict_by_boxes(feature(i), station_, {mesh.box, box}, set_boxes_);
      wanted = wanted || fits_.verdicts[i][g].status == GroupStatus::fitted;
    }
    if (!wanted) return;
    if (!joint_box) points_.gather(mesh, sets_, group);
    if (!joint_box && group.size() > 1) box = principal_box(points_.points);
    const FitInput input{points_.points,
                         points_.areas,
                         points_.offsets,
                         set_boxes_,
                         box,
                         mesh.box,
                         edge_of(group),
                         points_.integrated_mean_curvature,
                         &mesh,
                         points_.vertices};
    fits_.shapes[g] = station_.fitter->fit(input, Options(station_.arguments), run_.context);
    for (std::size_t i = 0; i < job_.features.size(); ++i)
      if (GroupVerdict& verdict = fits_.verdicts[i][g]; verdict.status == GroupStatus::fitted)
        verdict = verdict_by_fit(feature(i), {mesh.box, box}, fits_.shapes[g]);
  }

 private:
  /// The mean edge of the mesh, or where the group's own edges are much shorter or longer the mean of these: what is a
  /// tolerance on the whole is none on a small hole.
  double edge_of(std::span<const Index> group) const {
    constexpr double much = 2;
    double sum = 0, count = 0;
    for (const Index s : group) {
      const auto vertices = sets_[s].size();
      sum += static_cast<double>(vertices) * sets_.edges[s];
      count += static_cast<double>(vertices);
    }
    const double mean = run_.mesh.mean_edge, own = sum / count;
    return own > 0 && (own * much < mean || own > much * mean) ? own : mean;
  }
  const ModelFeature& feature(std::size_t i) const { return run_.model.features[job_.features[i]]; }

  const FitJob& job_;
  const ModelRun& run_;
  const MeasuredWorkingSets& sets_;
  GroupFits& fits_;
  const ShapeStation& station_;  ///< the same shape and arguments for all features of the job
  bool needs_box_;               ///< bb(w) itself, not a stand-in
  GroupPoints points_;
  std::vector<Box> set_boxes_;
};

/// Measures, parameters, covariance and outline of a fit, about; and what is kept of its group.
constexpr std::uint64_t bytes_of_a_fit = 1024 + sizeof(FittedShape) + sizeof(Box);

void require_memory(const FitJob& job, std::size_t count, const ModelRun& run) {
  if (count * bytes_of_a_fit <= run.context.memory_budget()) return;
  const ModelFeature& feature = job.feature(run.model);
  throw UsageError(feature.where.str() + ": the fits of feature '" + feature.name + "' to " + std::to_string(count) +
                   " groups of working sets would need about " + std::to_string(count * bytes_of_a_fit) +
                   " bytes, and this run may take " + std::to_string(run.context.memory_budget()) +
                   "; name fewer working-set types, or let the classifier give fewer sets");
}

}  // namespace

GroupFits fit_groups(const FitJob& job, WorkingSetGroups groups, const ModelRun& run, const MeasuredWorkingSets& sets) {
  require_memory(job, groups.size(), run);
  GroupFits fits{std::move(groups)};
  const std::size_t count = fits.groups.size();
  fits.shapes.resize(count);
  fits.boxes.resize(count);
  fits.verdicts.assign(job.features.size(), std::vector<GroupVerdict>(count));
  guard(job.station(run.stations).plugin, [&] {
    run.context.parallel_for(count, grain, [&](std::size_t first, std::size_t last) {
      GroupFitter fitter(job, run, sets, fits);
      for (std::size_t g = first; g < last && !run.context.cancelled(); ++g) fitter.fit(g);
    });
  });
  return fits;
}

}  // namespace toposcope
