// SPDX-License-Identifier: BSD-3-Clause
#include "probability/number_costs.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace toposcope {
namespace {

constexpr Index most_there = 1'000'000;

/// log of the probability that there are n.
double log_prior(const InstanceCount& count, Index n) {
  if (n < count.least || (count.most && n > *count.most)) return -std::numeric_limits<double>::infinity();
  if (count.most) return -std::log(static_cast<double>(*count.most - count.least) + 1);
  const double more = n - count.least;
  return -std::log((more + 1) * (more + 2));
}

double log_choose(double n, double k) {
  return std::lgamma(n + 1) - std::lgamma(k + 1) - std::lgamma(n - k + 1);
}

/// log of the probability that k are found.
double log_found(const InstanceCount& count, double detectability, Index k) {
  double top = -std::numeric_limits<double>::infinity(), sum = 0;
  const Index last = count.most.value_or(most_there);
  for (Index n = std::max(k, count.least); n <= last; ++n) {
    const double term =
        log_prior(count, n) + log_choose(n, k) + k * std::log(detectability) + (n - k) * std::log1p(-detectability);
    if (term > top) {
      sum = sum * std::exp(top - term) + 1;
      top = term;
    } else {
      sum += std::exp(term - top);
      if (term < top - 50) break;  // terms rise to one top and fall
    }
  }
  return top + std::log(sum);
}

}  // namespace

std::vector<double> number_costs(const InstanceCount& count, double detectability, double worth, Index most_found) {
  std::vector<double> costs;
  for (Index k = 0; k <= std::min(most_found, count.most.value_or(most_found)); ++k)
    costs.push_back(-std::lgamma(k + 1.0) - log_found(count, detectability, k) +
                    worth * (std::max(k, count.least) - k));
  return costs;
}

}  // namespace toposcope
