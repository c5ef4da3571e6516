// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "model/model.h"
#include "pipeline/working_sets.h"

namespace toposcope {

/// All groups of pairwise disjoint working sets, one of each of a feature's types; for equal types in ascending order,
/// so that each group comes once.
class WorkingSetGroups {
 public:
  /// \throw UsageError  over a million groups
  WorkingSetGroups(const ModelFeature& feature, const WorkingSets& sets, const BitMatrix& overlap);

  std::size_t arity() const { return of_type_.size(); }
  std::size_t size() const { return groups_.size() / of_type_.size(); }
  std::span<const Index> operator[](std::size_t group) const {
    return std::span(groups_).subspan(group * of_type_.size(), of_type_.size());
  }

 private:
  void extend(const ModelFeature& feature, const BitMatrix& overlap);

  std::vector<std::vector<Index>> of_type_;
  std::vector<Index> group_;
  std::vector<Index> groups_;  ///< one after the other
};

/// The points of a group of working sets, one set after the other.
struct GroupPoints {
  std::vector<Vec3> points;
  std::vector<double> areas;
  std::vector<Index> offsets;

  void gather(const MeshView& mesh, std::span<const double> vertex_areas, const WorkingSets& sets,
              std::span<const Index> group);
};

/// A third of the triangles around each vertex.
std::vector<double> areas_of_vertices(const MeshView& mesh);

}  // namespace toposcope
