// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/fit_groups.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <mutex>
#include <stdexcept>

#include "base/errors.h"
#include "core/kernel/pipeline/hand_made_run.h"

namespace toposcope {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// The length of a row; some rows go wrong.
struct RowFitter final : test::MeanFitter {
  FittedShape fit(const FitInput& input, const Options& arguments, Context& context) const override {
    FittedShape shape = MeanFitter::fit(input, arguments, context);
    shape.measures = {{"length", static_cast<double>(input.points.size() - 1), 0}};
    switch (static_cast<int>(std::round(shape.centroid.y() + 4.5))) {
      case 2:
        shape.summary.termination = Termination::degenerate;
        break;
      case 3:
        shape.rms = std::numeric_limits<double>::quiet_NaN();
        break;
      case 4:
        shape.measures[0].value = 2.5;
        break;
      case 5:
        shape.measures.clear();
        break;
      case 6:
        shape.rms = 1.5;
        break;
      case 7:
        throw std::runtime_error("row 7");
      default:
        break;
    }
    const std::lock_guard lock(mutex);
    points.assign(input.points.begin(), input.points.end());
    areas.assign(input.areas.begin(), input.areas.end());
    offsets.assign(input.set_offsets.begin(), input.set_offsets.end());
    return shape;
  }
  /// At most what the boxes are long.
  Interval bounds(std::string_view, std::span<const Box> boxes, const Options&) const override {
    double longest = 0;
    for (const Box& box : boxes) longest += box.a();
    return {0, longest};
  }

  mutable std::mutex mutex;
  mutable std::vector<Vec3> points;  ///< of the last fit
  mutable std::vector<double> areas;
  mutable std::vector<Index> offsets;
};

std::vector<GroupStatus> statuses(const GroupFits& fits, std::size_t feature) {
  std::vector<GroupStatus> all;
  for (const GroupVerdict& each : fits.verdicts[feature]) all.push_back(each.status);
  return all;
}

struct FitGroups : ::testing::Test, test::HandMadeRun {
  GroupFits fit(const FitJob& job) {
    measure();
    return fit_groups(job, WorkingSetGroups(job.feature(model), job.types(model), sets), run(), sets);
  }
  ModelFeature& add_rod() {
    ModelFeature& rod = add_feature("rod", 1, fitter);
    rod.ranges = {{"length", expression("3"), expression("4.5"), {}}};
    rod.max_fit_error = expression("bb(O).a/9");  // one
    return rod;
  }
  std::shared_ptr<RowFitter> fitter = std::make_shared<RowFitter>();
};

TEST_F(FitGroups, EachConditionByHand) {
  add_rod();
  add_set(0, 3);  // a box of length 2 holds no length above 3
  for (int row = 1; row < 7; ++row) add_set(row);
  const GroupFits fits = fit({{0}});
  using enum GroupStatus;
  ASSERT_EQ(fits.verdicts.size(), 1U);
  EXPECT_THAT(statuses(fits, 0),
              ElementsAre(boxed_out, fitted, unusable, unusable, out_of_range, out_of_range, poor_fit));
  EXPECT_EQ(fits.verdicts[0][0].bound, 0U) << "the lower bound of the first range";
  EXPECT_NEAR(fits.verdicts[0][0].value, 2, 1e-9) << "what its box allows at most";
  EXPECT_EQ(fits.verdicts[0][0].limit, 3);
  EXPECT_EQ(fits.verdicts[0][6].bound, 2U) << "max_fit_error";
  EXPECT_EQ(fits.verdicts[0][6].value, 1.5);
  EXPECT_EQ(fitter->fits, 6) << "what its box rules out is not fitted";
  EXPECT_NEAR(fits.shapes[1].centroid.y(), -3.5, 1e-12);
  EXPECT_NEAR(fits.boxes[1].a(), 4, 1e-9);
}

TEST_F(FitGroups, FeaturesShareAFitAndJudgeItEachForItself) {
  add_rod();
  add_feature("any", 1, fitter);
  add_set(0, 3);
  add_set(1);
  const GroupFits fits = fit({{0, 1}});
  using enum GroupStatus;
  EXPECT_THAT(statuses(fits, 0), ElementsAre(boxed_out, fitted));
  EXPECT_THAT(statuses(fits, 1), Each(fitted));
  EXPECT_EQ(fitter->fits, 2);
}

TEST_F(FitGroups, OfSeveralSetsHaveAllTheirPoints) {
  add_feature("pair", 2, fitter).max_fit_error = expression("bb(w).b");
  add_set(0);
  add_set(1);
  const GroupFits fits = fit({{0}});
  ASSERT_EQ(fits.groups.size(), 1U);
  EXPECT_EQ(fits.verdicts[0][0].status, GroupStatus::fitted);
  EXPECT_NEAR(fits.boxes[0].a(), 4, 1e-9);
  EXPECT_NEAR(fits.boxes[0].b(), 1, 1e-9);
  EXPECT_THAT(fitter->offsets, ElementsAre(0, 5, 10));
  ASSERT_EQ(fitter->points.size(), 10U);
  for (std::size_t i = 0; i < 10; ++i) EXPECT_NEAR(fitter->points[i].y(), i < 5 ? -4.5 : -3.5, 1e-12);
  // Six half quads meet at an inner vertex, a third of each is its own.
  EXPECT_EQ(std::count_if(fitter->areas.begin(), fitter->areas.end(), [](double a) { return std::abs(a - 1) < 1e-12; }),
            3);
}

TEST_F(FitGroups, OfASecondLookAreOfItsTypes) {
  add_feature("pair", 1, fitter).second_look = {"convex", "convex"};
  add_set(0);
  add_set(1);
  EXPECT_EQ(fit({{0}, true}).groups.arity(), 2U);
  EXPECT_EQ(fit({{0}, false}).groups.arity(), 1U);
}

TEST_F(FitGroups, AFitThatThrowsIsThePluginsFault) {
  add_feature("rod", 1, fitter);
  add_set(7);
  try {
    fit({{0}});
    FAIL() << "the fitter threw";
  } catch (const PluginError& error) {
    EXPECT_THAT(error.what(), ::testing::AllOf(HasSubstr("'mean'"), HasSubstr("row 7")));
  }
}

}  // namespace
}  // namespace toposcope
