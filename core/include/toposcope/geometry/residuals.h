// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// What relations of directions and of ranges share: residuals, their deviations and densities. Angles in rad.

#include "toposcope/relations.h"

namespace toposcope {

/// Least density of an angle among unrelated directions, per rad: it is never 0, or what is unlikely by chance alone
/// would prove the relation.
inline constexpr double least_angle_density = 0.05;

/// True where both shapes have a normal or direction.
bool directed(const FittedShape& first, const FittedShape& second);

/// Standard deviation of the angle between two directions: at most a right angle, by which a direction that is wholly
/// uncertain is off.
double angle_sd(const FittedShape& first, const FittedShape& second);

/// Two directions against lines that are parallel. The tolerance is left to the caller. \pre directed
RelationResult parallel_directions(const FittedShape& first, const FittedShape& second);

/// Two directions against lines at a right angle. The tolerance is left to the caller. \pre directed
RelationResult perpendicular_directions(const FittedShape& first, const FittedShape& second);

/// How far a value lies beyond a range, with the range as the slack of the result. \pre low <= high
void measure_range(RelationResult& result, double value, double low, double high);

}  // namespace toposcope
