// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/working_set_groups.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "base/errors.h"

namespace toposcope {
namespace {
constexpr std::size_t max_groups = 1'000'000;
}

WorkingSetGroups::WorkingSetGroups(const ModelFeature& feature, const WorkingSets& sets, const BitMatrix& overlap) {
  for (const std::string& type : feature.worksets) {
    std::vector<Index>& candidates = of_type_.emplace_back();
    for (Index s = 0; s < sets.size(); ++s)
      if (sets.type_names[sets.types[s]] == type) candidates.push_back(s);
  }
  // A type without a set: no group at all.
  if (std::none_of(of_type_.begin(), of_type_.end(), [](const auto& of) { return of.empty(); }))
    extend(feature, overlap);
}

void WorkingSetGroups::extend(const ModelFeature& feature, const BitMatrix& overlap) {
  const std::size_t position = group_.size();
  if (position == of_type_.size()) {
    groups_.insert(groups_.end(), group_.begin(), group_.end());
    if (size() > max_groups)
      throw UsageError(feature.where.str() + ": feature '" + feature.name + "' has over " + std::to_string(max_groups) +
                       " groups of working sets on this mesh; name fewer working-set types, or let the classifier give "
                       "fewer sets");
    return;
  }
  for (Index s : of_type_[position]) {
    bool fits = true;
    for (std::size_t i = 0; i < position && fits; ++i)
      fits = !overlap.get(group_[i], s) && (feature.worksets[i] != feature.worksets[position] || group_[i] < s);
    if (!fits) continue;
    group_.push_back(s);
    extend(feature, overlap);
    group_.pop_back();
  }
}

void GroupPoints::gather(const MeshView& mesh, std::span<const double> vertex_areas, const WorkingSets& sets,
                         std::span<const Index> group) {
  points.clear();
  areas.clear();
  offsets.assign(1, 0);
  for (Index s : group) {
    for (Index v : sets[s]) {
      points.push_back(mesh.positions[v]);
      areas.push_back(vertex_areas[v]);
    }
    offsets.push_back(static_cast<Index>(points.size()));
  }
}

std::vector<double> areas_of_vertices(const MeshView& mesh) {
  std::vector<double> areas(mesh.vertex_count(), 0);
  for (const auto& [a, b, c] : mesh.triangles) {
    const double third =
        (mesh.positions[b] - mesh.positions[a]).cross(mesh.positions[c] - mesh.positions[a]).norm() / 6;
    for (Index v : {a, b, c}) areas[v] += third;
  }
  return areas;
}

}  // namespace toposcope
