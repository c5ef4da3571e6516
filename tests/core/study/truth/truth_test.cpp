// SPDX-License-Identifier: BSD-3-Clause
#include "truth/truth.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/errors.h"
#include "support/program.h"
#include "support/refusal.h"

namespace toposcope {
namespace {

using ::testing::HasSubstr;

class TruthFile : public ::testing::Test {
 protected:
  Truth read(const std::string& text) {
    test::write_text(folder_ / "cup.truth.json", text);
    return read_truth(folder_ / "cup.truth.json");
  }
  std::string refusal(const std::string& text) {
    return test::refusal([&] { read(text); });
  }
  test::TemporaryFolder folder_;
};

TEST_F(TruthFile, MarksGroupsBandsAndTheFrame) {
  const Truth truth = read(R"({"mesh": "cup.off", "class": "cup", "frame": {"mean_edge": 0.5, "bbox_diagonal": 20},
      "features": {"rim": {"points": [[1, 2, 3], [4, 5, 6]],
                           "parameters": {"center": [0, 0, 1], "normal": [0, 0, 2], "band": [5, 3]}},
                   "bottom": {"points": []},
                   "handleCon": {"groups": [{"name": "upper", "points": [[0, 0, 0], [2, 0, 0]]},
                                            {"name": "lower", "points": [[9, 9, 9]], "centroid": [9, 9, 8]}]}}})");
  EXPECT_EQ(truth.class_name, "cup");
  EXPECT_EQ(truth.mean_edge, 0.5);
  EXPECT_EQ(truth.diagonal, 20);
  const TruthFeature* rim = truth.find("rim");
  ASSERT_TRUE(rim);
  ASSERT_EQ(rim->points.size(), 2U);
  EXPECT_EQ(rim->points[1], Vec3(4, 5, 6));
  ASSERT_TRUE(rim->band());
  EXPECT_EQ(rim->band()->center, Vec3(0, 0, 1));
  EXPECT_EQ(rim->band()->inner, 3);
  EXPECT_EQ(rim->band()->outer, 5);
  EXPECT_EQ(rim->band()->normal, Vec3::UnitZ());
  EXPECT_FALSE(truth.find("bottom")->exists());
  EXPECT_FALSE(truth.find("bottom")->band());
  const TruthFeature* handle = truth.find("handleCon");
  ASSERT_EQ(handle->groups.size(), 2U);
  EXPECT_EQ(handle->groups[0].centroid, Vec3(1, 0, 0)) << "the mean of its points";
  EXPECT_EQ(handle->groups[1].centroid, Vec3(9, 9, 8)) << "as given";
  EXPECT_EQ(handle->points, (std::vector<Vec3>{{0, 0, 0}, {2, 0, 0}, {9, 9, 9}}));
  EXPECT_EQ(handle->groups[1].members, std::vector<Index>{2});
  EXPECT_EQ(truth.find("lid"), nullptr);
}

TEST_F(TruthFile, MarksOfGroupsCountOnce) {
  const Truth truth = read(R"({"class": "cup", "features": {"handleCon": {
      "shape": "line-group", "points": [[0, 0, 0], [9, 9, 9]], "vertices": [7, 4],
      "groups": [{"points": [[0, 0, 0]], "vertices": [7]}, {"points": [[9, 9, 9]], "vertices": [4]}],
      "parameters": {"endpoints": [[1, 2, 3], [4, 5, 6]], "closed": false, "radius": 2}}}})");
  const TruthFeature& handle = truth.features.at(0);
  EXPECT_EQ(handle.shape, "line-group");
  EXPECT_EQ(handle.points.size(), 2U);
  EXPECT_EQ(handle.vertices, (std::vector<Index>{7, 4}));
  const std::vector<std::pair<std::string, std::vector<double>>> parameters = {
      {"closed", {0}}, {"endpoints", {1, 2, 3, 4, 5, 6}}, {"radius", {2}}};
  EXPECT_EQ(handle.parameters, parameters);
}

TEST_F(TruthFile, RefusalsNameFileAndMember) {
  for (const auto& [text, words] : std::vector<std::pair<std::string, std::string>>{
           {"{", "is no JSON"},
           {"[]", "a JSON object"},
           {R"({"class": "cup"})", "/features: expected an object"},
           {R"({"features": {"rim": {}}})", "/features/rim: expected an object with 'points' or 'groups'"},
           {R"({"features": {"rim": {"points": [[1, 2]]}}})", "/features/rim/points/0: expected three numbers"},
           {R"({"features": {"rim": {"points": [[1, 2, "x"]]}}})", "/features/rim/points/0/2: expected a number"},
           {R"({"features": {"h": {"groups": [{"points": []}]}}})", "/features/h/groups/0/points"},
           {R"({"features": {"r": {"points": [[1, 2, 3]], "vertices": []}}})",
            "/features/r/vertices: expected as many"},
           {R"({"features": {"r": {"points": [[1, 2, 3]], "vertices": [-1]}}})", "/features/r/vertices/0: expected a"},
           {R"({"features": {"r": {"points": [], "parameters": {"radius": "wide"}}}})",
            "/parameters/radius: expected a"},
           {R"({"features": {"r": {"points": [], "parameters": {"band": [1, 2]}}}})",
            "/parameters: 'band' is two radii"},
           {R"({"features": {}, "frame": {"mean_edge": 0}})", "/frame/mean_edge: expected a length above 0"},
       }) {
    EXPECT_THAT(refusal(text), HasSubstr("cup.truth.json:"));
    EXPECT_THAT(refusal(text), HasSubstr(words));
  }
  EXPECT_THROW(read_truth(folder_ / "absent.truth.json"), UsageError);
}

TEST_F(TruthFile, IsFoundBesideItsMesh) {
  EXPECT_EQ(truth_beside(folder_ / "cup.ply"), "");
  test::write_text(folder_ / "cup.truth.json", "{}");
  EXPECT_EQ(truth_beside(folder_ / "cup.ply"), folder_ / "cup.truth.json");
}

}  // namespace
}  // namespace toposcope
