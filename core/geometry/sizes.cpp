// SPDX-License-Identifier: BSD-3-Clause
#include "toposcope/geometry/sizes.h"

#include <cmath>

#include "toposcope/geometry/residuals.h"

namespace toposcope {

Sizes common_measure(const FittedShape& first, const FittedShape& second, std::string_view name) {
  for (const Measure& a : first.measures) {
    if (name != "any" && a.name != name) continue;
    for (const Measure& b : second.measures)
      if (a.name == b.name && a.value > 0 && b.value > 0) return {&a, &b};
  }
  return {};
}

void measure_ratio(RelationResult& result, const Sizes& sizes, double low, double high) {
  const double first = sizes.first->value, sum = first + sizes.second->value;
  const auto share = [&](double ratio) { return ratio < unlimited_ratio ? sum * ratio / (1 + ratio) : sum; };
  measure_range(result, first, share(low), share(high));
  const double bound = std::abs(first - share(low)) <= std::abs(first - share(high)) ? low : high;
  result.sd =
      bound < unlimited_ratio ? std::hypot(sizes.first->sd, bound * sizes.second->sd) / (1 + bound) : sizes.second->sd;
  result.clutter_density = 1 / sum;
}

}  // namespace toposcope
