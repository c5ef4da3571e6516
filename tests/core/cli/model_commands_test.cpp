// SPDX-License-Identifier: BSD-3-Clause

// The commands that lead from a mesh to a model, as a user runs them.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "support/program.h"

namespace toposcope::test {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

TEST(ModelNew, WritesAModelThatRuns) {
  const TemporaryFolder folder;
  const std::string file = (folder / "vase.yaml").string(), mesh = (folder / "bowl.ply").string();
  const Outcome made = toposcope("model new vase -o " + file);
  ASSERT_EQ(made.exit_code, 0) << made.err;
  EXPECT_THAT(read_text(file), HasSubstr("\nname: vase\n"));
  ASSERT_EQ(toposcope("sample cup --set handle=false --faces 3000 -o " + mesh).exit_code, 0);
  const json result = json::parse(toposcope("run " + mesh + " --json --model " + file).out);
  EXPECT_TRUE(result["features"]["rim"]["present"]);
  EXPECT_NEAR(result["measures"]["height"]["value"], 95, 2);
  const Outcome again = toposcope("model new vase -o " + file);
  EXPECT_EQ(again.exit_code, 2);
  EXPECT_THAT(again.err, HasSubstr("is there already"));
  EXPECT_THAT(toposcope("model new 'a b' -o " + (folder / "x.yaml").string()).err, HasSubstr("name"));
  EXPECT_EQ(toposcope("model new mug --from cup -o " + (folder / "mug.yaml").string()).exit_code, 0);
  EXPECT_THAT(toposcope("model new mug --from cub -o " + (folder / "y.yaml").string()).err,
              HasSubstr("did you mean 'cup'?"));
}

TEST(ModelProbe, NamesTheBoundThatKeepsTheNearestOut) {
  const TemporaryFolder folder;
  const std::string file = (folder / "m.yaml").string(), mesh = (folder / "cup.ply").string();
  ASSERT_EQ(toposcope("sample cup --faces 3000 -o " + mesh).exit_code, 0);
  write_text(file,
             "schema: toposcope.model/1\nname: m\nfeatures:\n"
             "  rim: {worksets: [convex], shape: circle, ranges: {radius: 0.9*bb(O).a < r, coverage: 0.5 < c}}\n"
             "  bottom: {worksets: [planar], shape: plane, max_fit_error: bb(O).c/50}\n"
             "relationships:\n  r1: {features: [rim, bottom], type: parallel}\n");
  const Outcome said = toposcope("run " + mesh + " --model " + file);
  EXPECT_THAT(said.out, HasSubstr("break 0.9*bb(O).a < radius = ")) << "parameter, value and bound";
  EXPECT_THAT(said.out, HasSubstr("(the nearest has "));
  const json rim =
      json::parse(toposcope("model probe " + file + " " + mesh + " --feature rim --json").out)["features"]["rim"];
  EXPECT_EQ(rim["kept"], 0);
  ASSERT_EQ(rim["changes"].size(), 1U);
  EXPECT_TRUE(rim["changes_suffice"]);
  EXPECT_EQ(rim["changes"][0]["bound"], "0.9*bb(O).a < radius");
  EXPECT_LT(rim["changes"][0]["value"], rim["changes"][0]["limit"]);
  // The remedy, taken, lets a candidate in.
  std::string changed = read_text(file);
  const std::string remedy = rim["changes"][0]["remedy"];
  changed.replace(changed.find("0.9*bb(O).a < r"), 15, remedy);
  write_text(file, changed);
  EXPECT_GT(json::parse(
                toposcope("model probe " + file + " " + mesh + " --feature rim --json").out)["features"]["rim"]["kept"],
            0);
  const json bottom = json::parse(toposcope("model probe " + file + " " + mesh + " --json").out)["features"]["bottom"];
  EXPECT_TRUE(bottom["candidates"][0]["measures"].contains("area"));
  EXPECT_EQ(bottom["candidates"][0]["relations"][0]["name"], "r1");
  EXPECT_THAT(toposcope("model probe " + file + " " + mesh + " --feature rum").err, HasSubstr("did you mean 'rim'?"));
}

TEST(ModelLearn, SetsRangesFromMarkedMeshes) {
  const TemporaryFolder folder;
  const std::string file = (folder / "m.yaml").string(), learned = (folder / "learned.yaml").string();
  std::string truths;
  for (int seed = 1; seed <= 3; ++seed) {
    const std::string stem = (folder / ("cup" + std::to_string(seed))).string();
    ASSERT_EQ(
        toposcope("sample cup --random --faces 3000 --seed " + std::to_string(seed) + " -o " + stem + ".ply").exit_code,
        0);
    truths += " " + stem + ".truth.json";
  }
  write_text(file,
             "schema: toposcope.model/1\nname: m\nfeatures:\n"
             "  rim: {worksets: [convex], shape: circle, ranges: {radius: 0 < r < bb(O).a}}  # open\n"
             "  bottom: {worksets: [planar], shape: plane, max_fit_error: bb(O).c/50}\n"
             "relationships:\n  r1: {features: [rim, bottom], type: parallel}\n");
  const Outcome said = toposcope("model learn " + file + " --from" + truths + " -o " + learned);
  ASSERT_EQ(said.exit_code, 0) << said.err;
  EXPECT_THAT(said.out, HasSubstr("(was 0 < radius < bb(O).a)"));
  const std::string text = read_text(learned);
  EXPECT_THAT(text, HasSubstr("# open; learned from cup1.truth.json, cup2.truth.json, cup3.truth.json"));
  EXPECT_THAT(text, HasSubstr("detectability: 0.8"));
  EXPECT_EQ(toposcope("model check " + learned).exit_code, 0);
  // Truth that does not fit the model.
  ASSERT_EQ(toposcope("sample tee --faces 3000 -o " + (folder / "tee.ply").string()).exit_code, 0);
  const Outcome wrong =
      toposcope("model learn " + file + " --from " + (folder / "tee.truth.json").string() + " -o " + learned);
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_THAT(wrong.err, HasSubstr("marks none of the features of model 'm'"));
}

}  // namespace
}  // namespace toposcope::test
