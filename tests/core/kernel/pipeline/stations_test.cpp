// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/stations.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/errors.h"
#include "pipeline/filters.h"
#include "plugin/plugin_host.h"
#include "support/meshes.h"
#include "support/plugins.h"

namespace toposcope {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Pair;

TEST(MakeFilter, TakesOptionsAsWrittenAndTellsAll) {
  const GivenOption given[] = {{"faces", "100"}};
  const FilterStation made = make_filter(test::host(), "decimate", given, "the scan");
  EXPECT_EQ(made.id, "decimate");
  EXPECT_EQ(made.use.kind, "filters");
  EXPECT_EQ(made.use.id, "decimate");
  EXPECT_EQ(made.use.options.size(), test::host().catalog().require(PluginKind::filters, "decimate").options.size());
  EXPECT_THAT(made.use.options, Contains(Pair("faces", "100")));
  const Mesh grid(test::make_grid(20, 20), "grid");
  EXPECT_LE(apply_filters(grid, {&made, 1}, test::context()).view().face_count(), 100U);
}

TEST(MakeFilter, SaysWhoAskedForWhatIsNotThere) {
  const auto refusal = [](const char* id, const std::vector<GivenOption>& given) -> std::string {
    try {
      make_filter(test::host(), id, given, "the scan");
    } catch (const UsageError& error) {
      return error.what();
    }
    return "none";
  };
  EXPECT_THAT(refusal("decimat", {}), AllOf(HasSubstr("the scan"), HasSubstr("decimate")));
  EXPECT_THAT(refusal("decimate", {{"faces", "few"}}), HasSubstr("the scan: filter 'decimate'"));
}

}  // namespace
}  // namespace toposcope
