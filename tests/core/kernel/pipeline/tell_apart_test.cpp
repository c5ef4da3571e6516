// SPDX-License-Identifier: BSD-3-Clause

// Equal features get a place each, and the probability that any of them is there.

#include "pipeline/tell_apart.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/kernel/pipeline/rows_of_a_grid.h"
#include "pipeline/label.h"
#include "pipeline/most_probable_shapes.h"
#include "pipeline/relate.h"
#include "support/labeling_problems.h"

namespace toposcope {
namespace {

std::string bars(int count) {
  std::string text = "schema: toposcope.model/1\nname: bars\nfeatures:\n";
  for (int i = 0; i < count; ++i) text += "  bar" + std::to_string(i) + ": {worksets: [convex], shape: lgrp1}\n";
  return text;
}

/// Two places, rows 0 and 10, two candidates each; every one costs a little more than to leave the feature out.
struct EqualBars : test::Rows {
  explicit EqualBars(int count, double cost = 0.2) : Rows(bars(count).c_str(), 20) {
    for (const double row : {0.0, 10.0}) {
      add_rows(row, row);
      add_rows(row, row + 1);
    }
    first_look();
    ClassOutcome question = pose_classes(relate(run(), sets, features), model, stations.probability).front();
    for (LabelingVariable& variable : question.problem.variables) {
      variable.costs.assign(variable.domain(), cost);
      variable.costs[0] = 0;
    }
    problem = question.problem;
    posed = label_class(std::move(question), features, run(), {});
    posed.answer = with_most_probable_shapes(posed, features, run());
  }

  bool low(const LabelingProblem& of, Index variable, Index value) const {
    return features.all[of.variables[variable].candidates[value - 1]].shape.centroid.y() < 0;
  }

  /// Probability that some bar is in a place, of all labellings of the problem as it was posed.
  double taken(bool in_low) const {
    const std::vector<Labeling> all = test::all_labelings(problem);
    double sum = 0, some = 0;
    for (const Labeling& labeling : all) {
      sum += std::exp(-labeling.cost);
      for (Index v = 0; v < labeling.values.size(); ++v)
        if (labeling.values[v] > 0 && low(problem, v, labeling.values[v]) == in_low) some += std::exp(-labeling.cost);
    }
    return some / sum;
  }

  LabelingProblem problem;  ///< as it was posed
  ClassOutcome posed;
};

TEST(TellApart, EqualFeaturesHaveAPlaceEachThoughTheCheapestLabellingIsEmpty) {
  const EqualBars bars(2);
  EXPECT_EQ(bars.posed.outcome.labelings.front().values, (std::vector<Index>{0, 0}));
  const std::vector<Index>& answer = bars.posed.answer.values;
  ASSERT_TRUE(answer[0] > 0 && answer[1] > 0);
  EXPECT_NE(bars.low(bars.posed.problem, 0, answer[0]), bars.low(bars.posed.problem, 1, answer[1]));
  for (Index v = 0; v < 2; ++v) {
    const bool in_low = bars.low(bars.posed.problem, v, answer[v]);
    EXPECT_NEAR(probability_of_shape(bars.posed, v, answer[v], bars.features, bars.run()), bars.taken(in_low), 1e-9);
    const std::vector<double>& posterior = bars.posed.outcome.posteriors[v];
    EXPECT_NEAR(std::accumulate(posterior.begin(), posterior.end(), 0.0), 1, 1e-12);
  }
}

TEST(TellApart, AFeatureWithoutAPlaceIsMissing) {
  const EqualBars bars(3);
  const std::vector<Index>& answer = bars.posed.answer.values;
  EXPECT_EQ(std::count(answer.begin(), answer.end(), Index{0}), 1);
  for (Index v = 0; v < 3; ++v) {
    const double p = probability_of_shape(bars.posed, v, answer[v], bars.features, bars.run());
    if (answer[v] == 0)
      EXPECT_NEAR(p, 1, 1e-9);  // there is no third place
    else
      EXPECT_NEAR(p, bars.taken(bars.low(bars.posed.problem, v, answer[v])), 1e-9);
  }
}

TEST(TellApart, WhatIsLabelledKeepsItsPlace) {
  const EqualBars bars(2, -4);
  const std::vector<Index>& answer = bars.posed.answer.values;
  ASSERT_TRUE(answer[0] > 0 && answer[1] > 0);
  for (Index v = 0; v < 2; ++v)
    EXPECT_NEAR(probability_of_shape(bars.posed, v, answer[v], bars.features, bars.run()),
                bars.taken(bars.low(bars.posed.problem, v, answer[v])), 1e-9);
}

TEST(TellApart, PlacesThatAreRatherEmptyHaveNoFeature) {
  const EqualBars bars(2, 4);
  EXPECT_EQ(bars.posed.answer.values, (std::vector<Index>{0, 0}));
}

}  // namespace
}  // namespace toposcope
