// SPDX-License-Identifier: BSD-3-Clause
#include "probability/likelihood.h"

#include <gtest/gtest.h>

#include <cmath>

namespace toposcope {
namespace {

const ProbabilityModel model{.sample_spacing = 4,
                             .fit_error_scale = 2,
                             .unexplained_cost = 1,
                             .relation_exception = 0.01,
                             .certainty = 0.99,
                             .crisp = true,
                             .max_candidates = 10};

FittedShape shape(double explained, double rms, double unexplained = 0) {
  FittedShape s;
  s.explained = explained;
  s.rms = rms;
  s.unexplained = unexplained;
  return s;
}

TEST(FitEvidence, GrowsWithWhatIsExplained) {
  EXPECT_GT(fit_evidence(model, shape(80, 1), 2), fit_evidence(model, shape(40, 1), 2));
  EXPECT_NEAR(fit_evidence(model, shape(80, 0), 2), 80.0 / 4, 1e-12);
}

TEST(FitEvidence, FallsWithErrorAndWithWhatIsLeftOut) {
  EXPECT_GT(fit_evidence(model, shape(80, 1), 2), fit_evidence(model, shape(80, 1.5), 2));
  EXPECT_GT(fit_evidence(model, shape(80, 1), 2), fit_evidence(model, shape(80, 1, 5), 2));
  EXPECT_LT(fit_evidence(model, shape(80, 4), 2), 0) << "a shape two sd off explains less than clutter does";
}

RelationResult relation(double residual, int dof, double clutter_density) {
  RelationResult r;
  r.residual = residual;
  r.tolerance = 0.2;
  r.dof = dof;
  r.clutter_density = clutter_density;
  return r;
}

/// The densities under "holds" integrate to one: the expected ratio of unrelated to held is one.
TEST(RelationEvidence, HoldsIsADensity) {
  ProbabilityModel no_exception = model;
  no_exception.relation_exception = 1e-300;
  for (int dof : {1, 2, 3}) {
    double integral = 0;
    const double step = 1e-4;
    for (double r = step / 2; r < 2; r += step)
      integral += step * std::pow(r, dof - 1) * std::exp(relation_evidence(no_exception, relation(r, dof, 1.0)));
    EXPECT_NEAR(integral, 1, 1e-3) << dof;
  }
}

TEST(RelationEvidence, RangeIsADensityOverTheValue) {
  ProbabilityModel no_exception = model;
  no_exception.relation_exception = 1e-300;
  RelationResult r = relation(0, 1, 1.0);
  r.slack = 3;
  double integral = 3 * std::exp(relation_evidence(no_exception, r));
  const double step = 1e-4;  // one shoulder of half the mass of each side
  for (double d = step / 2; d < 2; d += step) {
    r.residual = d;
    integral += step * std::exp(relation_evidence(no_exception, r));
  }
  EXPECT_NEAR(integral, 1, 1e-3);
}

TEST(RelationEvidence, IsBoundedBelowByTheException) {
  EXPECT_NEAR(relation_evidence(model, relation(100, 1, 1)), std::log(0.01), 1e-9);
  RelationResult unfit;
  unfit.applicable = false;
  EXPECT_NEAR(relation_evidence(model, unfit), std::log(0.01), 1e-12);
  EXPECT_EQ(relation_probability(model, unfit), 0);
  EXPECT_TRUE(std::isinf(violation(unfit)));
}

TEST(RelationEvidence, UncertainFitsAreJudgedLessSharply) {
  RelationResult sure = relation(0.3, 1, 1), unsure = sure;
  unsure.sd = 0.3;
  EXPECT_GT(relation_evidence(model, unsure), relation_evidence(model, sure));
}

TEST(RelationEvidence, ProbabilityAgreesWithBayes) {
  const RelationResult r = relation(0.05, 1, 0.8);
  const double sd = 0.2 / 2.5;
  const double holds = 0.99 * std::sqrt(2 / pi) / sd * std::exp(-0.5 * (0.05 / sd) * (0.05 / sd));
  EXPECT_NEAR(relation_probability(model, r), holds / (holds + 0.01 * 0.8), 1e-9);
}

TEST(DetectabilityCosts, AreMinusLogsAndNeverCertain) {
  const DetectabilityCosts half = detectability_costs(model, 0.25);
  EXPECT_NEAR(half.present, -std::log(0.25), 1e-12);
  EXPECT_NEAR(half.missing, -std::log(0.75), 1e-12);
  EXPECT_NEAR(detectability_costs(model, 1).missing, -std::log(0.01), 1e-9);
  EXPECT_TRUE(std::isfinite(detectability_costs(model, 0).present));
}

}  // namespace
}  // namespace toposcope
