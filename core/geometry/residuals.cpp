// SPDX-License-Identifier: BSD-3-Clause
#include "toposcope/geometry/residuals.h"

#include <algorithm>
#include <cmath>

#include "toposcope/geometry/lines.h"

namespace toposcope {

bool directed(const FittedShape& first, const FittedShape& second) {
  return first.orientation != Orientation::none && second.orientation != Orientation::none;
}

double angle_sd(const FittedShape& first, const FittedShape& second) {
  return std::min(std::hypot(first.direction_sd, second.direction_sd), pi / 2);
}

RelationResult parallel_directions(const FittedShape& first, const FittedShape& second) {
  const double angle = line_angle(first.direction, second.direction);
  RelationResult result;
  result.residual = angle;
  result.sd = angle_sd(first, second);
  result.dof = 2;
  result.clutter_density = angle > 0 ? std::sin(angle) / angle : 1;
  return result;
}

RelationResult perpendicular_directions(const FittedShape& first, const FittedShape& second) {
  RelationResult result;
  result.residual = pi / 2 - line_angle(first.direction, second.direction);
  result.sd = angle_sd(first, second);
  result.dof = 1;
  result.clutter_density = std::max(std::cos(result.residual), least_angle_density);
  return result;
}

void measure_range(RelationResult& result, double value, double low, double high) {
  result.residual = std::max({0.0, low - value, value - high});
  result.dof = 1;
  result.slack = high - low;
}

}  // namespace toposcope
