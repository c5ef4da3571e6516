// SPDX-License-Identifier: BSD-3-Clause

// What is reported has each feature in its most probable shape, however many candidates share it.

#include "pipeline/most_probable_shapes.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/kernel/pipeline/rows_of_a_grid.h"
#include "pipeline/relate.h"
#include "toposcope/labeling/tools.h"

namespace toposcope {
namespace {

/// Of a bar the candidates are the first row, the first two rows, which is the same shape, and the rows 8 and 12.
struct MostProbableShapes : ::testing::Test, test::Rows {
  MostProbableShapes() : Rows(test::two_bars, 20) {
    add_rows(0, 0);
    add_rows(0, 1);
    add_rows(8, 8);
    add_rows(12, 12);
    first_look();
    posed = pose_classes(relate(run(), sets, features), model, stations.probability).front();
    for (const std::vector<Index>& group : {std::vector<Index>{0}, {1}, {2}, {3}}) {
      const std::vector<Index>& all = posed.problem.variables[0].candidates;
      const auto at = std::find_if(all.begin(), all.end(), [&](Index c) { return features.all[c].sets == group; });
      value_of.push_back(static_cast<Index>(at - all.begin()) + 1);
    }
  }

  /// \param of  posterior of *missing* and of the four candidates of the bar; the rod is missing
  Labeling answer(const std::vector<double>& of, Index label) {
    posed.outcome.posteriors.assign(2, std::vector<double>(5, 0));
    posed.outcome.posteriors[0][0] = of[0];
    for (std::size_t i = 0; i < 4; ++i) posed.outcome.posteriors[0][value_of[i]] = of[i + 1];
    posed.outcome.posteriors[1][0] = 1;
    posed.outcome.labelings = {{{label, 0}, 0}};
    posed.outcome.labelings.front().cost = cost_of(posed.problem, posed.outcome.labelings.front().values);
    return with_most_probable_shapes(posed, features, run());
  }

  ClassOutcome posed;
  std::vector<Index> value_of;  ///< of the bar, by set
};

TEST_F(MostProbableShapes, CandidatesOfOneShapeCountTogether) {
  const Labeling moved = answer({0.1, 0.25, 0.25, 0.05, 0.35}, value_of[3]);
  EXPECT_TRUE(moved.values[0] == value_of[0] || moved.values[0] == value_of[1]);
  EXPECT_NEAR(probability_of_shape(posed, 0, moved.values[0], features, run()), 0.5, 1e-12);
  EXPECT_NEAR(probability_of_shape(posed, 0, value_of[3], features, run()), 0.35, 1e-12);
  // Of the two the one of least cost, and the cost is that of the labelling.
  const std::vector<double>& costs = posed.problem.variables[0].costs;
  const auto cost = [&](Index set) {
    return cost_of(posed.problem, std::vector<Index>{value_of[set], moved.values[1]});
  };
  EXPECT_EQ(moved.cost, std::min(cost(0), cost(1)));
  EXPECT_LT(costs[moved.values[0]], forbidden);
}

TEST_F(MostProbableShapes, TheLabelStaysWhereNoShapeHasMore) {
  EXPECT_EQ(answer({0.1, 0.15, 0.15, 0.25, 0.35}, value_of[3]).values[0], value_of[3]);
  EXPECT_EQ(answer({0, 0.2, 0.2, 0, 0.6}, value_of[3]).values[0], value_of[3]);
  EXPECT_EQ(answer({0, 0.3, 0.3, 0.2, 0.2}, value_of[1]).values[0], value_of[1]) << "it is of the best shape";
}

TEST_F(MostProbableShapes, MissingStandsForItself) {
  EXPECT_EQ(answer({0.45, 0.1, 0.05, 0.1, 0.3}, value_of[3]).values[0], 0U);
  EXPECT_NE(answer({0.3, 0.2, 0.2, 0.1, 0.2}, 0).values[0], 0U);
}

TEST_F(MostProbableShapes, WithoutPosteriorsTheLabellingOfLeastCostIsReported) {
  const Labeling first = answer({0.1, 0.25, 0.25, 0.05, 0.35}, value_of[3]);
  posed.outcome.posteriors.clear();
  EXPECT_EQ(with_most_probable_shapes(posed, features, run()).values[0], value_of[3]);
  EXPECT_NE(first.values[0], value_of[3]);
}

}  // namespace
}  // namespace toposcope
