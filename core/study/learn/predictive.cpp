// SPDX-License-Identifier: BSD-3-Clause
#include "learn/predictive.h"

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>

namespace toposcope {
namespace {

double student(double degrees, double coverage) {
  return boost::math::quantile(boost::math::students_t(degrees), (1 + coverage) / 2);
}

}  // namespace

PredictiveInterval predict(std::span<const double> values, double coverage) {
  const auto n = static_cast<double>(values.size());
  double mean = 0, squares = 0;
  for (const double value : values) mean += std::log(value) / n;
  for (const double value : values) squares += std::pow(std::log(value) - mean, 2);
  double half = std::log(widest);
  if (values.size() > 1)
    half = std::min(
        half, student(n - 1, coverage) * std::max(std::sqrt(squares / (n - 1)), least_spread) * std::sqrt(1 + 1 / n));
  return {std::exp(mean - half), std::exp(mean + half)};
}

double predict_deviation(std::span<const double> sizes, double coverage) {
  const auto n = static_cast<double>(sizes.size());
  double squares = 0;
  for (const double size : sizes) squares += size * size / n;
  return student(n, coverage) * std::sqrt(squares);
}

double predict_share(std::size_t found, std::size_t of) {
  return (static_cast<double>(found) + 1) / (static_cast<double>(of) + 2);
}

}  // namespace toposcope
