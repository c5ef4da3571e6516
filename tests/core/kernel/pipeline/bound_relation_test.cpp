// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/bound_relation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "base/errors.h"
#include "core/kernel/pipeline/hand_made_run.h"

namespace toposcope {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

/// Gives back its argument `min` as the residual.
struct EchoTester final : RelationTester {
  RelationResult test(const RelationInput&, const Options& arguments, Context&) const override {
    RelationResult result;
    result.residual = arguments.real("min");
    result.tolerance = 7;
    result.clutter_density = 1;
    return result;
  }
};

struct BoundRelations : ::testing::Test, test::HandMadeRun {
  BoundRelations() {
    for (const char* name : {"bar", "rod"}) add_feature(name, 1, nullptr);
    add_relationship(0, 1, std::make_shared<EchoTester>());
    stations.relationships[0].defaults = {{"min", 1, ""}};
  }
  RelationResult test() const {
    const ConstructedFeature bar, rod;
    const ConstructedFeature* const given[] = {&bar, &rod};
    return test_relationship(run(), 0, given);
  }
  template <class Refusal>
  std::string refusal() const {
    try {
      test();
    } catch (const Refusal& error) {
      return error.what();
    }
    return "none";
  }
};

TEST_F(BoundRelations, ArgumentsAreTheModelsOrTheDefaults) {
  EXPECT_EQ(test().residual, 1);
  model.relationships[0].arguments = {{"min", expression("bb(O).a/3")}};
  EXPECT_NEAR(test().residual, 3, 1e-9);
}

TEST_F(BoundRelations, TheModelsToleranceIsInTheResidualsUnit) {
  EXPECT_EQ(test().tolerance, 7) << "the relation's own";
  model.relationships[0].tolerance = expression("bb(O).a/3");
  EXPECT_NEAR(test().tolerance, 3, 1e-9);
  model.relationships[0].tolerance = expression("90");
  stations.relationships[0].unit = "deg";
  EXPECT_NEAR(test().tolerance, pi / 2, 1e-15);
}

TEST_F(BoundRelations, AnArgumentThatIsNoNumberIsRefused) {
  model.relationships[0].arguments = {{"min", expression("bb(O).a/(bb(O).a - bb(O).a)")}};
  EXPECT_THAT(refusal<UsageError>(),
              AllOf(HasSubstr("min 'bb(O).a/(bb(O).a - bb(O).a)' is inf"), HasSubstr("must be a number")));
}

TEST_F(BoundRelations, AnArgumentAboveWhatItMayNotExceedIsRefused) {
  OptionRow min{"min", OptionType::real, "length", "", "", "", "least"};
  min.not_above = "max";
  stations.relationships[0].arguments = {min, {"max", OptionType::real, "length", "", "", "", "most"}};
  model.relationships[0].arguments = {{"min", expression("2")}, {"max", expression("bb(O).a/3")}};
  EXPECT_EQ(test().residual, 2);
  model.relationships[0].arguments = {{"min", expression("4")}, {"max", expression("bb(O).a/3")}};
  EXPECT_THAT(refusal<UsageError>(), AllOf(HasSubstr("min = 4 is above max = "), HasSubstr("exchange")));
}

TEST_F(BoundRelations, AResultThatIsNoneIsThePluginsFault) {
  stations.relationships[0].defaults = {{"min", -1, ""}};
  EXPECT_THAT(refusal<PluginError>(), AllOf(HasSubstr("'apart'"), HasSubstr("residual")));
}

TEST_F(BoundRelations, TheSameTestIsOfOneTesterWithOneToleranceAndArguments) {
  add_relationship(1, 0, stations.relationships[0].tester);
  stations.relationships[1].defaults = stations.relationships[0].defaults;
  const ModelRun on = run();
  const auto same = [&] { return BoundRelation(on, 0).same_test(BoundRelation(on, 1)); };
  EXPECT_TRUE(same());
  model.relationships[1].tolerance = expression("bb(O).a");
  EXPECT_FALSE(same());
  model.relationships[1].tolerance.reset();
  stations.relationships[1].defaults[0].number = 2;
  EXPECT_FALSE(same());
  stations.relationships[1].defaults[0].number = 1;
  stations.relationships[1].tester = std::make_shared<EchoTester>();
  EXPECT_FALSE(same());
}

}  // namespace
}  // namespace toposcope
