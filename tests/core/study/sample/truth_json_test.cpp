// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>

#include "core/study/sample/sample_fixture.h"
#include "support/program.h"

namespace toposcope {
namespace {

using test::feature;
using test::make;
using test::value;

TEST(TruthJson, HasFeaturesGroupsAndParts) {
  const Sample sample = make({.kind = "cup", .faces = 2000});
  const auto json = nlohmann::json::parse(truth_json(sample, "cup.ply"));
  EXPECT_EQ(json.at("mesh"), "cup.ply");
  EXPECT_EQ(json.at("class"), "cup");
  const auto& rim = json.at("features").at("rim");
  EXPECT_EQ(rim.at("shape"), "circle");
  EXPECT_EQ(rim.at("points").size(), rim.at("vertices").size());
  EXPECT_EQ(rim.at("parameters").at("normal"), (std::vector<double>{0, 0, 1}));
  EXPECT_TRUE(rim.at("parameters").at("radius").is_number());
  const auto& handle = json.at("features").at("handleCon");
  EXPECT_EQ(handle.at("groups").size(), 2U);
  EXPECT_EQ(handle.at("groups")[0].at("name"), "upper");
  EXPECT_EQ(handle.at("groups")[0].at("points").size(), handle.at("groups")[0].at("vertices").size());
  EXPECT_EQ(handle.at("parameters").at("endpoints").size(), 2U);
  EXPECT_EQ(handle.at("parameters").at("closed"), false);
  std::set<std::size_t> faces;
  for (const auto& [name, list] : json.at("parts").items())
    for (const std::size_t f : list) EXPECT_TRUE(faces.insert(f).second) << "a face in two parts";
  EXPECT_EQ(faces.size(), sample.mesh.triangles.size());
}

TEST(TruthJson, MissingHandleHasNoPoints) {
  const Sample sample = make({.kind = "cup", .parameters = {{"handle", 0}}, .faces = 2000});
  const auto json = nlohmann::json::parse(truth_json(sample));
  EXPECT_TRUE(json.at("features").at("handleCon").at("points").empty());
  EXPECT_TRUE(json.at("features").at("handleCon").at("groups").empty());
}

TEST(TruthJson, IsReadBackAsItWasMade) {
  const test::TemporaryFolder folder;
  for (const char* kind : {"cup", "airplane", "tee"}) {
    SCOPED_TRACE(kind);
    const Sample sample = make({.kind = kind, .faces = 5000});
    const Truth& made = sample.truth;
    test::write_text(folder / "object.truth.json", truth_json(sample));
    const Truth read = read_truth(folder / "object.truth.json");
    EXPECT_EQ(read.class_name, made.class_name);
    ASSERT_EQ(read.features.size(), made.features.size());
    for (const TruthFeature& wanted : made.features) {
      SCOPED_TRACE(wanted.name);
      const TruthFeature& got = feature(read.features, wanted.name);
      EXPECT_EQ(got.shape, wanted.shape);
      EXPECT_EQ(got.points, wanted.points);
      EXPECT_EQ(got.vertices, wanted.vertices);
      ASSERT_EQ(got.parameters.size(), wanted.parameters.size());
      for (const auto& [name, values] : wanted.parameters) {
        ASSERT_EQ(value(got, name).size(), values.size()) << name;
        // Beside a band the normal is brought to length 1 once more.
        for (std::size_t i = 0; i < values.size(); ++i) EXPECT_DOUBLE_EQ(value(got, name)[i], values[i]) << name;
      }
      ASSERT_EQ(got.groups.size(), wanted.groups.size());
      for (std::size_t g = 0; g < wanted.groups.size(); ++g) {
        EXPECT_EQ(got.groups[g].name, wanted.groups[g].name);
        EXPECT_EQ(got.groups[g].members, wanted.groups[g].members);
        EXPECT_EQ(got.groups[g].centroid, wanted.groups[g].centroid);
      }
      EXPECT_EQ(got.band().has_value(), wanted.band().has_value());
    }
  }
}

}  // namespace
}  // namespace toposcope
