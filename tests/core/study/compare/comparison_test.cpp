// SPDX-License-Identifier: BSD-3-Clause
#include "compare/comparison.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/study/compare/comparisons_by_hand.h"

namespace toposcope {
namespace {

using test::comparisons_by_hand;
using ::testing::HasSubstr;
using ::testing::StartsWith;

TEST(Comparison, TotalsAreOverAllMeshes) {
  const std::vector<Total> all = totals(comparisons_by_hand());
  ASSERT_EQ(all.size(), 2U);
  EXPECT_EQ(all[0].labeler, "exact");
  EXPECT_EQ(all[0].meshes, 2U);
  EXPECT_EQ(all[0].proven, 2U);
  EXPECT_EQ(all[0].unsound, 0U);
  EXPECT_EQ(all[0].mean_gap, 0);
  EXPECT_NEAR(all[0].mean_posterior, 0.5, 1e-15) << "over the meshes that have one";
  EXPECT_EQ(all[0].median_ms, 3) << "of an even number the middle of the middle two";
  EXPECT_EQ(all[0].worst_ms, 4);
  EXPECT_EQ(all[0].nodes, 30U);
  EXPECT_EQ(all[0].right, 3U);
  EXPECT_EQ(all[0].of, 4U);
  EXPECT_EQ(all[1].proven, 0U);
  EXPECT_EQ(all[1].unsound, 1U);
  EXPECT_EQ(all[1].mean_gap, 2) << "over the sound labellings";
  EXPECT_EQ(all[1].worst_gap, 2);
  EXPECT_TRUE(std::isnan(all[1].mean_posterior));
  EXPECT_TRUE(totals({}).empty());
}

TEST(Comparison, TextSaysWhoAgrees) {
  const std::vector<Comparison> comparisons = comparisons_by_hand();
  EXPECT_EQ(to_text(comparisons[0]),
            "a.ply\n"
            "  labeler                    cost       gap  posterior         ms     nodes  right  guarantee\n"
            "  exact             A        1.50         0        0.5       2.00        10    2/2  optimal\n"
            "  quick:sweeps=a,b  B        3.50         2          -       1.00         0    1/2\n"
            "  A  cup: rim=3 handle=-\n"
            "  B  cup: rim=- handle=-\n"
            "\n");
  EXPECT_THAT(to_text(comparisons[1]), HasSubstr("  A  cup: rim=1 handle=2\n\n")) << "one line for both";
  EXPECT_EQ(
      to_text(totals(comparisons)),
      "all 2 meshes\n"
      "  labeler           optimal  unsound  mean gap     worst  posterior  median ms   worst ms      nodes     "
      "right\n"
      "  exact                   2        0         0         0      0.500       3.00       4.00         30       "
      "3/4\n"
      "  quick:sweeps=a,b        0        1         2         2          -       1.00       1.00          0       "
      "2/4\n");
  EXPECT_EQ(to_text(std::vector<Total>()), "");
}

TEST(Comparison, CsvHasARowForEachLabelerOfEachMeshAndOneForAll) {
  EXPECT_EQ(to_csv(comparisons_by_hand()),
            "mesh,labeler,class,labeling,cost,gap,proven,posterior,time_ms,nodes,right,of,guarantee\n"
            "a.ply,exact,cup,rim=3 handle=-,1.5,0,yes,0.5,2.0000,10,2,2,optimal\n"
            "a.ply,\"quick:sweeps=a,b\",cup,rim=- handle=-,3.5,2,no,,1.0000,0,1,2,\n"
            "meshes/b.ply,exact,cup,rim=1 handle=2,4,0,yes,,4.0000,20,1,2,optimal\n"
            "meshes/b.ply,\"quick:sweeps=a,b\",cup,rim=1 handle=2,,,no,,1.0000,0,1,2,\n"
            ",exact,,,,0,2 of 2,0.5,3.0000,30,3,4,\"mean gap and posterior, median time, sums of nodes and right\"\n"
            ",\"quick:sweeps=a,b\",,,,2,0 of 2,,1.0000,0,2,4,"
            "\"mean gap and posterior, median time, sums of nodes and right\"\n");
}

TEST(Comparison, MarkdownHasARowForEachLabeler) {
  EXPECT_EQ(
      to_markdown(totals(comparisons_by_hand())),
      "| labeler | optimal | unsound | mean gap | worst gap | posterior | median ms | worst ms | nodes | right |\n"
      "|---|---|---|---|---|---|---|---|---|---|\n"
      "| `exact` | 2 of 2 | 0 | 0 | 0 | 0.500 | 3.00 | 4.00 | 30 | 3 of 4 |\n"
      "| `quick:sweeps=a,b` | 0 of 2 | 1 | 2 | 2 | - | 1.00 | 1.00 | 0 | 2 of 4 |\n");
}

TEST(Comparison, JsonHasTheLabelingByFeature) {
  const auto json = nlohmann::json::parse(to_json(comparisons_by_hand()));
  EXPECT_EQ(json["schema"], "toposcope.comparison/1");
  const auto& entry = json["meshes"][0]["labelers"][0];
  EXPECT_EQ(entry["labeling"]["rim"], 3);
  EXPECT_TRUE(entry["labeling"]["handle"].is_null()) << "missing";
  EXPECT_EQ(entry["proven"], true);
  EXPECT_TRUE(json["meshes"][1]["labelers"][1]["cost"].is_null()) << "infinite";
  EXPECT_EQ(json["totals"][1]["unsound"], 1);
}

}  // namespace
}  // namespace toposcope
