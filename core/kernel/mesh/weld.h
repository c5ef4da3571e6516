// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "toposcope/types.h"

namespace toposcope {

/// For each point `among` those asked for the first of them at exactly the same place (-0 is 0); any other point, and
/// one that is not finite, stands for itself.
std::vector<Index> first_at_same_place(std::span<const Vec3> points, const std::vector<bool>& among);

/// Points that are nearly at one place.
struct NearPlaces {
  std::vector<Index> first;  ///< for each point the first of those it is joined with, else itself
  Index joined = 0;          ///< points that are joined with an earlier one
  double distance = 0;       ///< the greatest that was bridged
};

/// Joins points `among` those asked for whose distances are rounding against the shortest edge: below a thousandth of
/// it, where the next greater distance is ten times as large at least. Without such a gap nothing is joined.
NearPlaces first_at_near_place(std::span<const Vec3> points, const std::vector<bool>& among, double shortest_edge);

}  // namespace toposcope
