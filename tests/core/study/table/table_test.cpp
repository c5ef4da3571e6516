// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "table/table_json.h"

namespace toposcope {
namespace {

Table by_hand() {
  Table table{.title = "Cups", .id = "cups"};
  Column wide{"faces", "number"};
  wide.width = 7;
  table.columns = {"mesh", wide, {"distance", "number", "mean edges", "{:.2f}"}, ""};
  table.rows = {{"größe", 5000U, 0.125, "a|b"}, {"b,\"c\"", Cell(), std::nan(""), ""}};
  table.note = "By hand.";
  return table;
}

TEST(Table, AsTextHasColumnsOfTheWidthOfTheirCells) {
  EXPECT_EQ(to_text(by_hand()),
            "Cups\n"
            "  mesh     faces  distance\n"
            "  größe     5000      0.12  a|b\n"
            "  b,\"c\"        -         -\n"
            "  By hand.\n")
      << "words begin at the left, numbers end at the right, and no line ends in spaces";
}

TEST(Table, AsMarkdown) {
  Table table = by_hand();
  const std::string rows =
      "| mesh | faces | distance |  |\n"
      "|---|---|---|---|\n"
      "| größe | 5000 | 0.12 | a\\|b |\n"
      "| b,\"c\" | - | - |  |\n";
  EXPECT_EQ(to_markdown(table), "**Cups**\n\n" + rows + "\nBy hand.\n");
  table.title = table.note = "";
  EXPECT_EQ(to_markdown(table), rows);
  EXPECT_EQ(markdown_header(table.columns) + markdown_row(table.columns, table.rows[0]) +
                markdown_row(table.columns, table.rows[1]),
            rows);
}

TEST(Table, AsCsvQuotesWhatItMustAndLeavesNothingEmpty) {
  EXPECT_EQ(to_csv(by_hand()), "mesh,faces,distance,\ngröße,5000,0.12,a|b\n\"b,\"\"c\"\"\",,,\n");
}

TEST(Table, AsJsonKeepsKindsUnitsAndNumbers) {
  Table table = by_hand();
  EXPECT_EQ(to_json(table).dump(),
            R"({"id":"cups","title":"Cups","columns":[{"name":"mesh","unit":null,"kind":"text"},)"
            R"({"name":"faces","unit":null,"kind":"number"},{"name":"distance","unit":"mean edges","kind":"number"},)"
            R"({"name":"","unit":null,"kind":"text"}],"rows":[["größe",5000,0.125,"a|b"],["b,\"c\"",null,null,""]]})");
  table.links = {"a.html", ""};
  EXPECT_EQ(to_json(table)["links"], (nlohmann::ordered_json{"a.html", nullptr}));
}

TEST(Table, OneBelowTheOther) {
  EXPECT_EQ(to_text(std::vector<Table>{by_hand(), by_hand()}), "\n" + to_text(by_hand()) + "\n" + to_text(by_hand()));
  EXPECT_EQ(to_markdown(std::vector<Table>{by_hand()}), "\n" + to_markdown(by_hand()));
}

TEST(Cell, WhatIsNoFiniteNumberIsNothing) {
  const auto nothing = [](const Cell& cell) { return std::holds_alternative<std::monostate>(cell.value()); };
  EXPECT_TRUE(nothing(std::numeric_limits<double>::infinity()));
  EXPECT_TRUE(nothing(std::optional<std::size_t>()));
  EXPECT_FALSE(nothing(std::optional<std::size_t>(0)));
  EXPECT_TRUE(nothing(share(0, 0)));
  EXPECT_EQ(std::get<double>(share(1, 4).value()), 0.25);
}

}  // namespace
}  // namespace toposcope
