// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/fit_groups.h"

#include <algorithm>
#include <cmath>

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

}  // namespace

GroupFits fit_groups(const FitJob& job, const WorkingSetGroups& groups, const FitGround& ground, Context& context) {
  const MeshView& mesh = ground.mesh;
  GroupFits result;
  result.shapes.resize(groups.size());
  result.boxes.resize(groups.size());
  result.fates.assign(job.features.size(), std::vector<Fate>(groups.size(), Fate::boxed_out));
  const bool needs_box = std::any_of(job.features.begin(), job.features.end(),
                                     [&](Index f) { return uses_working_set_box(ground.model.features[f]); });
  context.parallel_for(groups.size(), grain, [&](std::size_t first, std::size_t last) {
    GroupPoints at;
    std::vector<Box> boxes_of_group;
    for (std::size_t g = first; g < last && !context.cancelled(); ++g) {
      const std::span<const Index> group = groups[g];
      boxes_of_group.clear();
      for (Index s : group) boxes_of_group.push_back(ground.set_boxes[s]);
      Box& box = result.boxes[g] = boxes_of_group.front();
      const bool joint_box = group.size() > 1 && needs_box;
      if (joint_box) {
        at.gather(mesh, ground.of_vertices, ground.sets, group);
        box = oriented_box(at.points);
      }
      bool wanted = false;
      for (std::size_t i = 0; i < job.features.size(); ++i) {
        result.fates[i][g] = fate_before(ground.model.features[job.features[i]], job, {mesh.box, box}, boxes_of_group);
        wanted = wanted || result.fates[i][g] == Fate::fitted;
      }
      if (!wanted) continue;
      if (!joint_box) at.gather(mesh, ground.of_vertices, ground.sets, group);
      if (!joint_box && group.size() > 1) box = principal_box(at.points);
      const FitInput input{at.points, at.areas,   at.offsets,     boxes_of_group,
                           box,       mesh.box,   mesh.mean_edge, at.integrated_mean_curvature,
                           &mesh,     at.vertices};
      result.shapes[g] = job.fitter->fit(input, Options(*job.arguments), context);
      for (std::size_t i = 0; i < job.features.size(); ++i)
        if (Fate& fate = result.fates[i][g]; fate == Fate::fitted)
          fate = fate_after(ground.model.features[job.features[i]], {mesh.box, box}, result.shapes[g]);
    }
  });
  return result;
}

}  // namespace toposcope
