// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/option_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <clocale>

#include "base/errors.h"

namespace toposcope {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

const std::vector<OptionRow> table = {
    {"tolerance", OptionType::real, "deg", "5", "0", "90", "largest angle"},
    {"count", OptionType::integer, "", "80", "1", "", "how many"},
    {"smooth", OptionType::boolean, "", "true", "", "", "whether to smooth"},
    {"method", OptionType::text, "", "robust", "", "", "how to fit", "robust|powell"},
    {"label", OptionType::text, "", "none", "", "", "any text"},
};

std::string error_of(const std::vector<GivenOption>& given, const std::vector<OptionRow>& rows = table) {
  try {
    check_options(rows, given, "shape 'circle'");
    return "";
  } catch (const UsageError& error) {
    EXPECT_EQ(error.exit_code, 2);
    EXPECT_THAT(error.what(), ::testing::StartsWith("shape 'circle': "));
    return error.what();
  }
}

TEST(OptionCheck, FillsInDefaultsInTheTablesOrder) {
  const auto values = check_options(table, {}, "x");
  ASSERT_EQ(values.size(), table.size());
  for (std::size_t i = 0; i < table.size(); ++i) EXPECT_EQ(values[i].name, table[i].name);
  const Options options(values);
  EXPECT_EQ(options.real("tolerance"), 5);
  EXPECT_EQ(options.integer("count"), 80);
  EXPECT_TRUE(options.boolean("smooth"));
  EXPECT_EQ(options.text("method"), "robust");
}

TEST(OptionCheck, TakesWhatIsGiven) {
  const std::vector<GivenOption> given = {
      {"method", "powell"}, {"tolerance", "1.5e1"}, {"smooth", "false"}, {"count", "1"}, {"label", "5 x"}};
  const auto values = check_options(table, given, "x");
  const Options options(values);
  EXPECT_EQ(options.real("tolerance"), 15);
  EXPECT_EQ(options.integer("count"), 1);
  EXPECT_FALSE(options.boolean("smooth"));
  EXPECT_EQ(options.text("method"), "powell");
  EXPECT_EQ(options.text("label"), "5 x");
}

TEST(OptionCheck, BoundsAreInclusive) {
  EXPECT_EQ(error_of({{"tolerance", "0"}}), "");
  EXPECT_EQ(error_of({{"tolerance", "90"}}), "");
  EXPECT_THAT(error_of({{"tolerance", "90.0001"}}),
              AllOf(HasSubstr("'tolerance'"), HasSubstr("'90.0001'"), HasSubstr("from 0 to 90 (deg)"), HasSubstr("5")));
  EXPECT_THAT(error_of({{"tolerance", "-1e-300"}}), HasSubstr("from 0 to 90"));
  EXPECT_THAT(error_of({{"count", "0"}}), HasSubstr("of at least 1"));
}

TEST(OptionCheck, WholeStringMustBeANumber) {
  for (const char* text : {"", " 5", "5 ", "5deg", "5,5", "nan", "inf", "1e999", "0x5"})
    EXPECT_THAT(error_of({{"tolerance", text}}), HasSubstr("a number")) << "'" << text << "'";
  for (const char* text : {"1.0", "1e2", "99999999999", "", "true"})
    EXPECT_THAT(error_of({{"count", text}}), HasSubstr("a whole number")) << "'" << text << "'";
  for (const char* text : {"1", "yes", "True", ""})
    EXPECT_THAT(error_of({{"smooth", text}}), HasSubstr("true or false")) << "'" << text << "'";
}

TEST(OptionCheck, SuggestsTheNearestName) {
  EXPECT_THAT(error_of({{"tolerence", "5"}}), HasSubstr("did you mean 'tolerance'?"));
  EXPECT_THAT(error_of({{"method", "powel"}}), AllOf(HasSubstr("one of robust, powell"), HasSubstr("mean 'powell'?")));
  EXPECT_THAT(error_of({{"zzzzzz", "5"}}), HasSubstr("known are: tolerance, count, smooth, method, label"));
  EXPECT_THAT(error_of({{"a", "5"}}, {}), HasSubstr("there are none"));
}

TEST(OptionCheck, GivenTwiceOrNotAtAll) {
  EXPECT_THAT(error_of({{"count", "5"}, {"count", "6"}}), HasSubstr("given twice"));
  const std::vector<OptionRow> required = {{"segments", OptionType::integer, "", "", "1", "", "number of segments"}};
  EXPECT_THAT(error_of({}, required), AllOf(HasSubstr("'segments' is not given"), HasSubstr("number of segments")));
  EXPECT_EQ(error_of({{"segments", "3"}}, required), "");
}

TEST(OptionCheck, OneMayNotExceedAnother) {
  const std::vector<OptionRow> range = {{"min", OptionType::real, "", "0", "", "", "least", "", "max"},
                                        {"max", OptionType::real, "", "5", "", "", "greatest"}};
  EXPECT_NO_THROW(check_table(range, "arguments"));
  EXPECT_EQ(error_of({{"min", "5"}}, range), "");
  EXPECT_THAT(error_of({{"min", "6"}}, range), HasSubstr("min = 6 is above max = 5; exchange them"));
  EXPECT_THAT(error_of({{"min", "2.5"}, {"max", "-1"}}, range), HasSubstr("min = 2.5 is above max = -1"));
}

TEST(OptionCheck, DecimalPointIsAPointInEveryLocale) {
  const std::string before = std::setlocale(LC_NUMERIC, nullptr);
  if (std::setlocale(LC_NUMERIC, "de_DE.UTF-8") == nullptr) GTEST_SKIP() << "locale de_DE.UTF-8 is not installed";
  const auto values = check_options(table, std::vector<GivenOption>{{"tolerance", "2.5"}}, "x");
  EXPECT_EQ(to_string(table[0], values[0]), "2.5");
  std::setlocale(LC_NUMERIC, before.c_str());
  EXPECT_EQ(values[0].number, 2.5);
}

TEST(OptionCheck, ValuesAreWrittenSoThatTheyReadBackTheSame) {
  const std::vector<GivenOption> given = {{"tolerance", "0.1"}, {"method", "powell"}, {"smooth", "false"}};
  const auto values = check_options(table, given, "x");
  EXPECT_EQ(to_string(table[0], values[0]), "0.1");
  EXPECT_EQ(to_string(table[1], values[1]), "80");
  EXPECT_EQ(to_string(table[2], values[2]), "false");
  EXPECT_EQ(to_string(table[3], values[3]), "powell");
}

TEST(OptionTable, UnsoundRowsAreRefused) {
  EXPECT_NO_THROW(check_table(table, "options"));
  const auto refused = [](const OptionRow& row) {
    try {
      check_table(std::vector<OptionRow>{row}, "options");
      return std::string();
    } catch (const UsageError& error) {
      return std::string(error.what());
    }
  };
  EXPECT_THAT(refused({"Max Edge", OptionType::real, "", "1", "", "", "x"}), HasSubstr("lower-case"));
  EXPECT_THAT(refused({"max", OptionType::real, "", "1", "", "", ""}), HasSubstr("meaning is empty"));
  EXPECT_THAT(refused({"max", OptionType::real, "", "1", "2", "1", "x"}), HasSubstr("minimum 2 is above maximum 1"));
  EXPECT_THAT(refused({"max", OptionType::real, "", "3", "1", "2", "x"}), HasSubstr("cannot be '3'"));
  EXPECT_THAT(refused({"max", OptionType::integer, "", "1", "0.5", "", "x"}), HasSubstr("bound '0.5'"));
  EXPECT_THAT(refused({"max", OptionType::boolean, "", "true", "0", "", "x"}), HasSubstr("no bounds"));
  EXPECT_THAT(refused({"max", OptionType::text, "", "c", "", "", "x", "a|b"}), HasSubstr("one of a, b"));
  EXPECT_THAT(refused({"max", OptionType::text, "", "a", "a|b", "", "x"}), HasSubstr("'choices'"));
  EXPECT_THAT(refused({"max", OptionType::real, "", "1", "", "", "x", "1|2"}), HasSubstr("for a text"));
  EXPECT_THAT(refused({"min", OptionType::real, "", "1", "", "", "x", "", "max"}), HasSubstr("'max'"));
  EXPECT_THAT(refused({"min", OptionType::real, "", "1", "", "", "x", "", "min"}), HasSubstr("another number"));
  EXPECT_THAT(refused({"min", OptionType::text, "", "1", "", "", "x", "", "max"}), HasSubstr("at a number"));
  std::vector<OptionRow> twice = {table[0], table[0]};
  EXPECT_THROW(check_table(twice, "options"), UsageError);
}

}  // namespace
}  // namespace toposcope
