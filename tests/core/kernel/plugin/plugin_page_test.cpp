// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/plugin_page.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/errors.h"

namespace toposcope {
namespace {

using ::testing::HasSubstr;

PluginManifest plugin() {
  PluginManifest manifest;
  manifest.options = {{"method", OptionType::text, "", "fast", "", "", "a|b", "fast|slow"},
                      {"scale", OptionType::real, "mean-edges", "1", "0.05", "20", "how far"},
                      {"count", OptionType::integer, "", "", "1", "", "how many"},
                      {"exact", OptionType::boolean, "", "true", "", "", "to the last bit"}};
  return manifest;
}

TEST(PluginPage, TablesAreMadeAndAllElseIsLeftAlone) {
  const std::string before = "# p\n\n<!-- table: options -->\nold\n<!-- end of table -->\n\n| my | table |\n";
  const std::string page = with_tables(before, plugin());
  EXPECT_EQ(page,
            "# p\n\n<!-- table: options -->\n"
            "| option | type | unit | default | range | meaning |\n|---|---|---|---|---|---|\n"
            "| `method` | text | | `fast` | `fast`, `slow` | a\\|b |\n"
            "| `scale` | real | mean-edges | 1 | 0.05 to 20 | how far |\n"
            "| `count` | integer | | must be given | 1 or more | how many |\n"
            "| `exact` | boolean | | true | | to the last bit |\n"
            "<!-- end of table -->\n\n| my | table |\n");
  EXPECT_EQ(with_tables(page, plugin()), page) << "made twice it is the same";
}

std::string error(const std::string& page) {
  try {
    with_tables(page, plugin());
  } catch (const UsageError& thrown) {
    return thrown.what();
  }
  return "";
}

TEST(PluginPage, WrongBlocksAreNamedByTheirLine) {
  EXPECT_THAT(error("# p\n"), HasSubstr("no place for the table of its options"));
  EXPECT_THAT(error("# p\n<!-- table: options -->\n"), HasSubstr("line 2: the table 'options' never ends"));
  EXPECT_THAT(error("<!-- table: colours -->\n<!-- end of table -->\n"), HasSubstr("there is no table 'colours'"));
  EXPECT_THAT(error("a\nb\n<!-- end of table -->\n"), HasSubstr("line 3: no table ends here"));
  EXPECT_THAT(error("<!-- table: options -->\n<!-- table: options -->\n"), HasSubstr("line 2: the table of line 1"));
}

}  // namespace
}  // namespace toposcope
