// SPDX-License-Identifier: BSD-3-Clause
#include "base/printable.h"

#include <gtest/gtest.h>

#include "base/assignment.h"

namespace toposcope {
namespace {

TEST(Printable, LeavesNothingThatATerminalObeys) {
  const std::pair<std::string, const char*> cases[] = {
      {"Tüte, 20 €\n\tz", "Tüte, 20 €\n\tz"},
      {"\x1b]0;pwned\x07", "\\u001b]0;pwned\\u0007"},
      {"a\rb\x7f", "a\\u000db\\u007f"},
      {"\xc2\x9b[2J", "\\u009b[2J"},  // the same command in one character
      {"\xe2\x80\xae", "\\u202e"},    // writes backwards
      {"\x9b[2J caf\xe9", "\\x9b[2J caf\\xe9"},
      {"\xc0\x9b \xed\xa0\x80", "\\xc0\\x9b \\xed\\xa0\\x80"},  // UTF-8 that is none
      {"\xe2\x82", "\\xe2\\x82"}};
  for (const auto& [text, shown] : cases) EXPECT_EQ(printable(text), shown);
  EXPECT_EQ(utf8_length("Tüte"), 5U);
  EXPECT_EQ(utf8_length("caf\xe9!"), 3U);
}

TEST(Printable, MessagesAreShortenedWhereTheyCannotBeRead) {
  const std::string path(150, 'p');
  EXPECT_EQ(shortened("file " + path + ": no such file\nsecond"), "file " + path + ": no such file\nsecond");
  EXPECT_LT(shortened("data:base64," + std::string(100'000, 'A') + " is cut").size(), 250U);
  EXPECT_TRUE(shortened("x=" + std::string(309, '9') + ": too large").ends_with("9: too large"));
  std::string words;
  for (int i = 0; i < 10'000; ++i) words += "word ";
  EXPECT_LT(shortened(words).size(), 2100U);
}

TEST(Assignment, IsCutAtItsFirstEqualsSign) {
  EXPECT_EQ(split_assignment("a=b=c"), std::pair(std::string("a"), std::string("b=c")));
  EXPECT_EQ(split_assignment("a="), std::pair(std::string("a"), std::string()));
  EXPECT_FALSE(split_assignment("=b"));
  EXPECT_FALSE(split_assignment("a"));
}

}  // namespace
}  // namespace toposcope
