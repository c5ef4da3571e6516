// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/working_set_groups.h"

#include <algorithm>

#include "base/errors.h"
#include "toposcope/geometry/point_sets.h"

namespace toposcope {
namespace {
constexpr std::size_t max_groups = 1'000'000;
// Of sets to beginnings of groups: some seconds. Many sets to a group may have billions of beginnings and no end.
constexpr std::size_t max_trials = 200'000'000;
}  // namespace

WorkingSetGroups::WorkingSetGroups(const ModelFeature& feature, const std::vector<std::string>& types,
                                   const MeasuredWorkingSets& sets, const std::vector<bool>& usable) {
  for (const std::string& type : types) {
    std::vector<Index>& candidates = of_type_.emplace_back();
    for (Index s = 0; s < sets.size(); ++s)
      if (sets.type_names[sets.types[s]] == type && (usable.empty() || usable[s])) candidates.push_back(s);
  }
  // A type without a set: no group at all.
  if (std::none_of(of_type_.begin(), of_type_.end(), [](const auto& of) { return of.empty(); }))
    extend(feature, types, sets.overlap);
  chosen_from_ = size();
}

void WorkingSetGroups::extend(const ModelFeature& feature, const std::vector<std::string>& types,
                              const BitMatrix& overlap) {
  const std::size_t position = group_.size();
  if (position == of_type_.size()) {
    groups_.insert(groups_.end(), group_.begin(), group_.end());
    if (size() > max_groups)
      throw UsageError(feature.where.str() + ": feature '" + feature.name + "' has over " + std::to_string(max_groups) +
                       " groups of working sets on this mesh; name fewer working-set types, or let the classifier give "
                       "fewer sets");
    return;
  }
  trials_ += of_type_[position].size();
  if (trials_ > max_trials)
    throw UsageError(feature.where.str() + ": feature '" + feature.name + "' has too many groups of " +
                     std::to_string(of_type_.size()) + " working sets to look through on this mesh; name fewer " +
                     "working-set types, or let the classifier give fewer sets");
  for (Index s : of_type_[position]) {
    bool fits = true;
    for (std::size_t i = 0; i < position && fits; ++i)
      fits = !overlap.get(group_[i], s) && (types[i] != types[position] || group_[i] < s);
    if (!fits) continue;
    group_.push_back(s);
    extend(feature, types, overlap);
    group_.pop_back();
  }
}

void WorkingSetGroups::keep(const std::vector<std::size_t>& groups) {
  std::vector<Index> kept;
  for (const std::size_t g : groups) kept.insert(kept.end(), (*this)[g].begin(), (*this)[g].end());
  groups_ = std::move(kept);
}

void GroupPoints::gather(const MeshView& mesh, const MeasuredWorkingSets& sets, std::span<const Index> group) {
  points.clear();
  vertices.clear();
  areas.clear();
  integrated_mean_curvature.clear();
  offsets.assign(1, 0);
  for (Index s : group) {
    vertices.insert(vertices.end(), sets[s].begin(), sets[s].end());
    for (Index v : sets[s]) {
      points.push_back(mesh.positions[v]);
      areas.push_back(sets.vertex_areas[v]);
      integrated_mean_curvature.push_back(sets.integrated_mean_curvature[v]);
    }
    offsets.push_back(static_cast<Index>(points.size()));
  }
}

Box principal_box(std::span<const Vec3> points) {
  const PrincipalAxes principal = principal_axes(points);
  Box box{principal.centroid, principal.axes, {}};
  for (int k = 0; k < 3; ++k) {
    const auto [low, high] = std::minmax_element(points.begin(), points.end(), [&](const Vec3& p, const Vec3& q) {
      return p.dot(box.axes[k]) < q.dot(box.axes[k]);
    });
    box.sides[k] = (*high - *low).dot(box.axes[k]);
    box.center += ((*high + *low) / 2 - principal.centroid).dot(box.axes[k]) * box.axes[k];
  }
  return box;
}

bool overlap_pairwise(const BitMatrix& overlap, std::span<const Index> a, std::span<const Index> b) {
  if (a.size() != b.size()) return false;
  bool in_order = true, reversed = true;
  for (std::size_t i = 0; i < a.size(); ++i) {
    in_order = in_order && overlap.get(a[i], b[i]);
    reversed = reversed && overlap.get(a[i], b[b.size() - 1 - i]);
  }
  return in_order || reversed;
}

}  // namespace toposcope
