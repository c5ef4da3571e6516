// SPDX-License-Identifier: BSD-3-Clause
#include "base/nearest_name.h"

#include <gtest/gtest.h>

namespace toposcope {
namespace {

const std::vector<std::string> features = {"rim", "bottomEdge", "bottom", "handleCon"};

TEST(NearestName, ForgivesTheUsualSlips) {
  EXPECT_EQ(nearest_name("botomEdge", features), "bottomEdge") << "a letter left out";
  EXPECT_EQ(nearest_name("bottommEdge", features), "bottomEdge") << "a letter too many";
  EXPECT_EQ(nearest_name("handlaCon", features), "handleCon") << "a wrong letter";
  EXPECT_EQ(nearest_name("hnadleCon", features), "handleCon") << "neighbours swapped";
  EXPECT_EQ(nearest_name("BOTTOMEDGE", features), "bottomEdge") << "case";
  EXPECT_EQ(nearest_name("botmEdge", features), "bottomEdge") << "the dissertation's own slip in Table 5.1";
  EXPECT_EQ(nearest_name("rmi", features), "rim") << "a swap is one edit: two would be too many in three letters";
}

TEST(NearestName, SaysNothingWhereNothingIsNear) {
  EXPECT_EQ(nearest_name("spout", features), "");
  EXPECT_EQ(nearest_name("", features), "");
  EXPECT_EQ(nearest_name("x", {"y"}), "") << "no letter is left";
  EXPECT_EQ(nearest_name("rim", {}), "");
}

TEST(NearestName, TakesTheNearestAndOfEqualsTheFirst) {
  EXPECT_EQ(nearest_name("rim3", {"rim1", "rim2"}), "rim1");
  EXPECT_EQ(nearest_name("bottomEdgf", {"bottomEdges", "bottomEdge"}), "bottomEdge");
}

TEST(NearestName, RemedyListsWhatThereIs) {
  EXPECT_EQ(name_remedy("Rim", features), "did you mean 'rim'?");
  EXPECT_EQ(name_remedy("spout", features), "known are: rim, bottomEdge, bottom, handleCon");
  EXPECT_EQ(name_remedy("spout", {}), "there are none");
}

}  // namespace
}  // namespace toposcope
