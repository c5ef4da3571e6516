// SPDX-License-Identifier: BSD-3-Clause
#include "sample/draw.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <set>

#include "base/errors.h"
#include "base/run_context.h"
#include "mesh/repair.h"
#include "sample/isosurface.h"

namespace toposcope {
namespace {

class RandomSample : public testing::TestWithParam<const char*> {
 protected:
  RandomSample() {
    for (SampleKind& kind : kinds_)
      if (kind.name == GetParam()) kind_ = &kind;
  }
  std::vector<SampleKind> kinds_ = sample_kinds();
  const SampleKind* kind_ = nullptr;
};

TEST_P(RandomSample, TakesFewDrawsAndIsValid) {
  int total = 0, most = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    int draws = 0;
    const auto values = draw_parameters(*kind_, {}, seed, &draws);
    EXPECT_EQ(values.size(), kind_->parameters.size()) << "every parameter has a range";
    EXPECT_NO_THROW(make_solid(kind_->name, check_parameters(*kind_, values)));
    total += draws;
    most = std::max(most, draws);
  }
  RecordProperty("mean_draws", std::to_string(total / 200.0));
  RecordProperty("most_draws", std::to_string(most));
  EXPECT_LT(total, 200 * 8);
  EXPECT_LT(most, 80);
}

TEST_P(RandomSample, RepeatsWithItsSeedAndDiffersWithAnother) {
  EXPECT_EQ(draw_parameters(*kind_, {}, 7), draw_parameters(*kind_, {}, 7));
  EXPECT_NE(draw_parameters(*kind_, {}, 7), draw_parameters(*kind_, {}, 8));
}

TEST_P(RandomSample, EveryRangeIsUsedFromEndToEnd) {
  std::map<std::string, std::pair<double, double>> seen;
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    const auto values = draw_parameters(*kind_, {}, seed);
    for (const RandomRange& range : kind_->ranges) {
      const double share = values.at(range.name) / (range.of.empty() ? 1 : values.at(range.of));
      if (range.high != 1 && !(range.low == 0 && range.high < 1 && range.of.empty())) {
        EXPECT_GE(share, range.low - 1e-12) << range.name;
        EXPECT_LE(share, range.high + 1e-12) << range.name;
      }
      const auto [it, is_new] = seen.emplace(range.name, std::pair(share, share));
      it->second = {std::min(it->second.first, share), std::max(it->second.second, share)};
    }
  }
  for (const RandomRange& range : kind_->ranges)
    EXPECT_GT(seen[range.name].second - seen[range.name].first, 0.5 * (range.high - range.low)) << range.name;
}

TEST_P(RandomSample, CanBeMeshed) {
  RunContext context({.threads = 2});
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    SCOPED_TRACE(seed);
    SampleRequest request;
    request.kind = kind_->name;
    request.faces = 6000;
    request.seed = seed;
    request.random = true;
    Sample sample = make_sample(request, context);
    if (sample.tessellated) repair(sample.mesh, "test");  // it may be unwelded
    EXPECT_TRUE(is_closed_manifold(sample.mesh));
    if (sample.tessellated) continue;  // with the faces that it has, and the parts that were drawn
    EXPECT_NEAR(static_cast<double>(sample.mesh.triangles.size()), 6000, 180);
    const std::size_t parts = std::set<std::uint8_t>(sample.face_part.begin(), sample.face_part.end()).size();
    EXPECT_EQ(parts, sample.part_names.size()) << "every part has faces";
  }
}

TEST_P(RandomSample, PresetsAreValidAndTypical) {
  ASSERT_GE(kind_->presets.size(), 2U);
  EXPECT_TRUE(kind_->presets.front().parameters.empty()) << "the first is the default";
  for (const SamplePreset& preset : kind_->presets) {
    const auto values = preset_parameters(*kind_, preset.name, {});
    EXPECT_TRUE(make_solid(kind_->name, check_parameters(*kind_, values)).typical) << preset.name;
  }
}

TEST_P(RandomSample, SwitchesAndChoicesKeepTheirShares) {
  std::map<std::string, double> sum;
  constexpr int count = 400;
  for (int seed = 1; seed <= count; ++seed)
    for (const auto& [name, value] : draw_parameters(*kind_, {}, static_cast<std::uint64_t>(seed))) sum[name] += value;
  for (const OptionRow& row : kind_->parameters)
    for (const RandomRange& range : kind_->ranges)
      if (range.name == row.name && row.type == OptionType::boolean && row.name != "engines_at_rear") {
        EXPECT_NEAR(sum[row.name] / count, range.high, 0.1) << row.name;
      }
}

TEST_P(RandomSample, PageTellsDefaultsAndRanges) {
  std::ifstream file(std::string(TOPOSCOPE_SOURCE_DIR) + "/docs/guide/sample.md");
  std::string page((std::istreambuf_iterator<char>(file)), {});
  std::erase_if(page, [](char c) { return c == '`'; });
  for (const OptionRow& row : kind_->parameters) {
    const std::string line =
        "| " + row.name + " | " + row.default_value + " | " + describe_range(*kind_, row.name) + " |";
    EXPECT_NE(page.find(line), std::string::npos) << line;
  }
  for (const SamplePreset& preset : kind_->presets)
    EXPECT_NE(page.find(preset.name + " (" + preset.summary), std::string::npos) << preset.name;
}

INSTANTIATE_TEST_SUITE_P(Kinds, RandomSample,
                         testing::Values("cup", "tee", "wye", "cross", "elbow", "tricorner", "airplane", "plate",
                                         "flange"),
                         [](const auto& parameter) { return std::string(parameter.param); });

TEST(DrawParameters, KeepsWhatIsGiven) {
  const SampleKind kind = cup_kind();
  const auto values = draw_parameters(kind, {{"handle", 0}, {"height", 77}}, 3);
  EXPECT_EQ(values.at("handle"), 0);
  EXPECT_EQ(values.at("height"), 77);
  EXPECT_GE(values.at("wall"), 0.03 * 77);
}

TEST(DrawParameters, SaysWhatNoDrawCanMend) {
  try {
    draw_parameters(cup_kind(), {{"wall", 60}}, 1);
    ADD_FAILURE();
  } catch (const UsageError& e) {
    EXPECT_NE(std::string(e.what()).find("random draws"), std::string::npos) << e.what();
    EXPECT_NE(std::string(e.what()).find(" is "), std::string::npos) << e.what();
  }
}

TEST(Presets, AreStartingPointsAndChecked) {
  RunContext context({.threads = 2});
  SampleRequest request;
  request.kind = "cup";
  request.faces = 3000;
  request.preset = "espresso";
  request.parameters = {{"handle", 0}};
  const Sample sample = make_sample(request, context);
  for (const auto& [name, value] : sample.parameters) {
    if (name == "height") {
      EXPECT_EQ(value, 58);
    }
    if (name == "handle") {
      EXPECT_EQ(value, 0);
    }
  }
  request.preset = "expresso";
  EXPECT_THROW(make_sample(request, context), UsageError);
  request.preset = "espresso";
  request.random = true;
  EXPECT_THROW(make_sample(request, context), UsageError);
}

}  // namespace
}  // namespace toposcope
