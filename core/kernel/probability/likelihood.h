// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include "toposcope/labeling.h"
#include "toposcope/relations.h"
#include "toposcope/shapes.h"

namespace toposcope {

/// The constants of the probabilistic model (docs/theory/probabilities.md), from the pipeline's `probability` section.
struct ProbabilityModel {
  double sample_spacing;       ///< mean edges between independent samples of a shape
  double fit_error_scale;      ///< mean edges: sd of a point's distance from its shape, where the model says nothing
  double unexplained_cost;     ///< nats per independent sample that the shape leaves out
  double relation_exception;   ///< probability that a relationship fails although its features are right
  double certainty;            ///< detectability is held below this: nothing is certain
  bool crisp;                  ///< a relationship beyond its tolerance is forbidden; else it only costs
  std::size_t max_candidates;  ///< kept per feature, the best by evidence
};

/// log L_f(c) / L_0(c): the evidence of a fit against clutter, in nats.
/// \param fit_error_sd  mesh unit
double fit_evidence(const ProbabilityModel& model, const FittedShape& shape, double fit_error_sd);

/// log of "holds" against "unrelated", in nats; at least log(relation_exception).
double relation_evidence(const ProbabilityModel& model, const RelationResult& result);

/// Probability that the relationship holds, given its residual; relation_exception is the prior that it does not.
double relation_probability(const ProbabilityModel& model, const RelationResult& result);

/// residual / tolerance; infinite where the relation does not apply.
double violation(const RelationResult& result);

/// Costs of present (before the evidence is taken off) and missing: -log det(f), -log(1 - det(f)).
struct DetectabilityCosts {
  double present, missing;
};
DetectabilityCosts detectability_costs(const ProbabilityModel& model, double detectability);

}  // namespace toposcope
