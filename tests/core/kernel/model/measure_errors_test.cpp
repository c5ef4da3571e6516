// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/kernel/model/sound_model.h"

namespace toposcope {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

class Measures : public test::ReadModel {
 protected:
  /// The sound model with one measure, at line 35, column 6.
  static std::string with(const std::string& expression) {
    return test::sound_model + "measures:\n  m: " + expression + "\n";
  }
};

TEST_F(Measures, AreReadWithTheirUnits) {
  const std::pair<const char*, const char*> units[] = {
      {"rim.radius", "length"},
      {"rim.radius * edge.length_2 + bottom.area", "area"},
      {"ratio(rim.radius, bb(O).a)", ""},
      {"angle(rim, bottom)", "deg"},
      {"90 - angle(rim, bottom) / 2", "deg"},
      {"max(angle(rim, bottom), 30)", "deg"},
      {"distance(rim, bottom) / bottom.area", "length^-1"},
      {"angle(rim, bottom) / rim.radius", "length^-1 deg"},
      {"along(rim, edge, bottom) - across(rim, rim, bottom) + 0", "length"},
  };
  for (const auto& [text, unit] : units) {
    const Model model = model_from_text(with(text), "m.yaml", &catalog_);
    ASSERT_EQ(model.measures.size(), 1U);
    EXPECT_EQ(model.measures[0].expression.unit(), unit) << text;
    EXPECT_EQ(model.measures[0].expression.text, text);
  }
  const Model model = model_from_text(with("rim.radius + rim.radius * 2 + bb(O).b"), "m.yaml", &catalog_);
  EXPECT_EQ(model.measures[0].expression.quantities.size(), 1U) << "each once";
  EXPECT_EQ(model.measures[0].expression.features(), std::vector<Index>{0});
}

TEST_F(Measures, ErrorsNamePlaceAndRemedy) {
  const test::Change errors[] = {
      {"", "rin.radius", "35:6", "unknown feature 'rin'; did you mean 'rim'?"},
      {"", "rim.radus", "35:10", "shape 'circle' of feature 'rim' has no measure 'radus'; did you mean 'radius'?"},
      {"", "rim", "35:9", "'rim' is a feature, which is no number; write rim.radius"},
      {"", "rim.", "35:10", "expected the name of a measure after 'rim.'"},
      {"", "distance(rim, botom)", "35:20", "unknown feature 'botom'; did you mean 'bottom'?"},
      {"", "distance(rim, rim)", "35:20", "takes two different features"},
      {"", "distance(rim)", "35:18", "expected ',' between the 2 features of distance"},
      {"", "distance(rim, edge, bottom)", "35:24", "expected ')' after the 2 features of distance"},
      {"", "along(rim, bottom)", "35:23", "expected ',' between the 3 features of along"},
      {"", "distanze(rim, edge)", "35:6", "unknown function 'distanze'; did you mean 'distance'?"},
      {"", "rim.radius + angle(rim, edge)", "35:17", "cannot add a length and an angle"},
      {"", "rim.radius + bottom.area", "35:17", "cannot add a length and an area"},
      {"", "ratio(rim.radius, bottom.area)", "35:22", "cannot take the ratio of a length and an area"},
      {"", "ratio(rim.radius)", "35:22", "expected ',' between the two values of ratio"},
      {"", "angle(rim, edge) - ratio(rim.radius, edge.length)", "35:23", "cannot subtract an angle and a number"},
      {"", "bb(w).a + rim.radius", "35:6", "names bb(w), but a measure spans several features; use bb(O)"},
      {"", "bb(O).a", "35:6", "names no feature"},
      {"", "rim.radius edge.length", "35:17", "unexpected 'edge'; join values by an operator"},
  };
  for (const test::Change& change : errors) {
    const std::string error = error_of(with(change.to));
    EXPECT_THAT(error, StartsWith(std::string("m.yaml:") + change.place + ": ")) << change.to;
    EXPECT_THAT(error, HasSubstr(change.says)) << change.to;
  }
}

TEST_F(Measures, FeaturesMayHaveADashInTheirNames) {
  std::string text = with("distance(the-rim, bottom) - the-rim.radius");
  for (std::size_t at = text.find("  rim:"); at != std::string::npos; at = std::string::npos)
    text.replace(at, 6, "  the-rim:");
  for (std::size_t at = text.find("[rim,"); at != std::string::npos; at = text.find("[rim,"))
    text.replace(at, 5, "[the-rim,");
  const Model model = model_from_text(text, "m.yaml", &catalog_);
  EXPECT_EQ(model.measures[0].expression.quantities.size(), 2U);
}

TEST_F(Measures, WithoutACatalogShapesAreNotAsked) {
  EXPECT_EQ(error_of(with("rim.anything + bottom.area"), false), "no error");
  EXPECT_THAT(error_of(with("rum.anything"), false), HasSubstr("unknown feature 'rum'"));
}

}  // namespace
}  // namespace toposcope
