// SPDX-License-Identifier: BSD-3-Clause
// The dissertation's pipeline sums nothing up; its classes are compared all the same.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "support/program.h"

namespace toposcope::test {
namespace {

TEST(CrispClasses, ATeeIsATeeUnderTheDissertationsPipeline) {
  const TemporaryFolder folder;
  const std::string tee = (folder / "tee.ply").string();
  ASSERT_EQ(toposcope("sample tee --faces 8000 -o " + tee).exit_code, 0);
  const Outcome outcome = toposcope("run " + tee + " --model neal-1999/pipe-fitting --pipeline neal-1999 --json");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const nlohmann::json result = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(result["class"], "tee");
  double sum = 0;
  for (const auto& probability : result["class_probabilities"]) sum += probability.get<double>();
  EXPECT_GT(sum, 0.5);
  EXPECT_LE(sum, 1 + 1e-9);
}

}  // namespace
}  // namespace toposcope::test
