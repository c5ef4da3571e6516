// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

namespace toposcope {

/// Where the next of a few values will lie.
struct PredictiveInterval {
  double low = 0, high = 0;
};

/// Of positive values whose logarithms are normal: m - t s sqrt(1 + 1/n) to m + t s sqrt(1 + 1/n), t the quantile of
/// Student's distribution with n - 1 degrees of freedom (Geisser 1993, Predictive Inference, section 2.2.2). Spreads
/// below `least_spread` are taken as that: a few alike are not all alike. Never wider than a factor of `widest` each
/// way, which is also what a single value gets. \param values    at least one, all above 0 \param coverage  0 to 1
PredictiveInterval predict(std::span<const double> values, double coverage);

/// The same of deviations from 0 whose sizes are given: r = t sqrt(mean of their squares), with n degrees of freedom,
/// since their mean is known.
double predict_deviation(std::span<const double> sizes, double coverage);

/// Share of the next ones that will be there, of n of which k are: (k + 1) / (n + 2), the mean when all shares are
/// equally likely beforehand (Laplace 1774).
double predict_share(std::size_t found, std::size_t of);

inline constexpr double least_spread = 0.02;  ///< of logarithms
inline constexpr double widest = 3;

}  // namespace toposcope
