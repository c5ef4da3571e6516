// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "model/model.h"
#include "pipeline/measured_working_sets.h"

namespace toposcope {

/// All groups of pairwise disjoint working sets, one of each of a feature's types; for equal types in ascending order,
/// so that each group comes once.
class WorkingSetGroups {
 public:
  /// \param types   of the group's sets: the feature's worksets or those of its second look
  /// \param usable  per set; empty: all are
  /// \throw UsageError  over a million groups, or too many beginnings of groups to look through
  WorkingSetGroups(const ModelFeature& feature, const std::vector<std::string>& types, const MeasuredWorkingSets& sets,
                   const std::vector<bool>& usable = {});

  /// Keeps these groups alone, ascending.
  void keep(const std::vector<std::size_t>& groups);
  /// How many there were before `keep`.
  std::size_t chosen_from() const { return chosen_from_; }

  std::size_t arity() const { return of_type_.size(); }
  std::size_t size() const { return groups_.size() / of_type_.size(); }
  std::span<const Index> operator[](std::size_t group) const {
    return std::span(groups_).subspan(group * of_type_.size(), of_type_.size());
  }

 private:
  void extend(const ModelFeature& feature, const std::vector<std::string>& types, const BitMatrix& overlap);

  std::vector<std::vector<Index>> of_type_;
  std::vector<Index> group_;
  std::vector<Index> groups_;  ///< one after the other
  std::size_t chosen_from_ = 0, trials_ = 0;
};

/// The points of a group of working sets, one set after the other.
struct GroupPoints {
  std::vector<Vec3> points;
  std::vector<Index> vertices;
  std::vector<double> areas, integrated_mean_curvature;
  std::vector<Index> offsets;

  void gather(const MeshView& mesh, const MeasuredWorkingSets& sets, std::span<const Index> group);
};

/// The box along the principal axes: a stand-in for bb(w) of many groups, of which few are kept.
Box principal_box(std::span<const Vec3> points);

/// Whether each set of one group overlaps its counterpart of the other, in the same order or the reverse.
bool overlap_pairwise(const BitMatrix& overlap, std::span<const Index> a, std::span<const Index> b);

}  // namespace toposcope
