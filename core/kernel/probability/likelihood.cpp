// SPDX-License-Identifier: BSD-3-Clause
#include "probability/likelihood.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace toposcope {
namespace {

/// A tolerance is where a user stops believing: so many standard deviations.
constexpr double tolerance_in_sd = 2.5;

/// log density of a residual r >= 0 that sums up `dof` normal components of standard deviation `sd`, divided by
/// r^(dof - 1): the factor that it shares with the density of unrelated features.
double log_chi_density(double r, double sd, int dof) {
  const double x = r / sd;
  const double k = dof;
  return (1 - k / 2) * std::log(2.0) - std::lgamma(k / 2) - x * x / 2 - k * std::log(sd);
}

/// log of (1 - exception) times the density under "holds" over that of unrelated features.
double log_holds(const ProbabilityModel& model, const RelationResult& result) {
  const double sd = std::hypot(result.tolerance / tolerance_in_sd, result.sd);
  double ratio;
  if (result.slack > 0) {
    // Uniform over the range with normal shoulders.
    const double width = result.slack + sd * std::sqrt(pi / 2);
    const double x = result.residual / sd;
    ratio = -x * x / 2 - std::log(width) - std::log(result.clutter_density);
  } else {
    ratio = log_chi_density(result.residual, sd, result.dof) - std::log(result.clutter_density);
  }
  const double samples = std::max(1.0, result.samples / model.sample_spacing);
  return std::log1p(-model.relation_exception) + samples * ratio;
}

/// log(exp(a) + exp(b)), safe for large terms.
double log_add(double a, double b) {
  return std::max(a, b) + std::log1p(std::exp(-std::abs(a - b)));
}

}  // namespace

double fit_evidence(const ProbabilityModel& model, const FittedShape& shape, double fit_error_sd) {
  const double x = shape.rms / fit_error_sd;
  const double per_sample = 1 - x * x / 2;
  return (shape.explained * per_sample - shape.unexplained * model.unexplained_cost) / model.sample_spacing;
}

double relation_evidence(const ProbabilityModel& model, const RelationResult& result) {
  const double exception = std::log(model.relation_exception);
  return result.applicable ? log_add(log_holds(model, result), exception) : exception;
}

double relation_probability(const ProbabilityModel& model, const RelationResult& result) {
  if (!result.applicable) return 0;
  return 1 / (1 + std::exp(std::log(model.relation_exception) - log_holds(model, result)));
}

double violation(const RelationResult& result) {
  return result.applicable ? result.residual / result.tolerance : std::numeric_limits<double>::infinity();
}

DetectabilityCosts detectability_costs(const ProbabilityModel& model, double detectability) {
  const double present = std::clamp(detectability, 1 - model.certainty, model.certainty);
  return {-std::log(present), -std::log1p(-present)};
}

}  // namespace toposcope
