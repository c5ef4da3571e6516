// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Two features of one kind of size, compared.

#include <string_view>

#include "toposcope/relations.h"

namespace toposcope {

/// The same measure of two shapes.
struct Sizes {
  const Measure* first = nullptr;
  const Measure* second = nullptr;
};

/// \param name  of the measure; "any": the first that both have and that is above 0, the radius of circles, the extent
///              of planes
/// \return nulls where one of them has none above 0
Sizes common_measure(const FittedShape& first, const FittedShape& second, std::string_view name = "any");

/// How far the ratio of first to second lies beyond low to high, told as a length of the first: of the sum of both it
/// has the share ratio / (1 + ratio), and of two unrelated sizes of that sum any share. The tolerance is left to the
/// caller. \pre 0 <= low <= high
void measure_ratio(RelationResult& result, const Sizes& sizes, double low, double high);

/// A ratio that is as good as none.
inline constexpr double unlimited_ratio = 1e30;

/// As the relations' pages call what cannot be compared.
inline constexpr const char* no_common_measure = "the shapes have no measure in common, or one of them is 0";

}  // namespace toposcope
