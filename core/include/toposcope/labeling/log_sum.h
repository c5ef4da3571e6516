// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "toposcope/labeling/tools.h"

namespace toposcope::factors {

/// -log of the sum of exp(-cost), shifted by the least cost so that nothing that counts underflows.
inline double soft_min(const double* costs, std::size_t count) {
  const double least = *std::min_element(costs, costs + count);
  if (!(least < forbidden)) return forbidden;
  double sum = 0;
  for (std::size_t i = 0; i < count; ++i) sum += std::exp(least - costs[i]);
  return least - std::log(sum);
}

/// Costs turned into probabilities that sum to 1. \pre one is finite
inline void normalize(const double* costs, std::size_t count, double* probabilities) {
  const double least = *std::min_element(costs, costs + count);
  double sum = 0;
  for (std::size_t i = 0; i < count; ++i) sum += probabilities[i] = std::exp(least - costs[i]);
  for (std::size_t i = 0; i < count; ++i) probabilities[i] /= sum;
}

}  // namespace toposcope::factors
