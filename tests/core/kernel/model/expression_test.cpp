// SPDX-License-Identifier: BSD-3-Clause
#include "model/expression.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <clocale>
#include <cmath>
#include <locale>

#include "base/errors.h"

namespace toposcope {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

// Sides without common factors, so that no wrong side gives the right value.
const ExpressionBoxes boxes = {.object = {.sides = {7, 5, 3}}, .worksets = {.sides = {1.75, 0.6875, 0.40625}}};
const SourceLocation start{"m.yaml", 4, 11};

double value(const std::string& text) {
  return Expression::parse(text, start).evaluate(boxes);
}

std::string expression_error(const std::string& text) {
  try {
    Expression::parse(text, start);
    return "no error";
  } catch (const UsageError& error) {
    return error.what();
  }
}

std::string range_error(const std::string& text, int dimension = 1) {
  try {
    parse_range(text, start, dimension);
    return "no error";
  } catch (const UsageError& error) {
    return error.what();
  }
}

TEST(Expression, ValuesAreThoseOfArithmetic) {
  EXPECT_EQ(value("1 + 2 * 3"), 7);
  EXPECT_EQ(value("(1 + 2) * 3"), 9);
  EXPECT_EQ(value("8 - 4 - 2"), 2) << "left to right";
  EXPECT_EQ(value("8 / 4 / 2"), 1) << "left to right";
  EXPECT_EQ(value("-2 * -3"), 6);
  EXPECT_EQ(value("- -2 - -(1)"), 3);
  EXPECT_EQ(value("1.5e1 + .5"), 15.5);
  EXPECT_EQ(value("min(3, 2, 4) + max(3, 2, 4)"), 6);
  EXPECT_DOUBLE_EQ(value("2*pi"), 2 * std::acos(-1.0));
}

TEST(Expression, NamesTheSidesOfBothBoxes) {
  EXPECT_EQ(value("bb(O).a"), 7);
  EXPECT_EQ(value("bb(O).b"), 5);
  EXPECT_EQ(value("bb(O).c"), 3);
  EXPECT_EQ(value("bb(w).a"), 1.75);
  EXPECT_EQ(value("bb(w).b"), 0.6875);
  EXPECT_EQ(value("bb(w).c"), 0.40625);
  EXPECT_EQ(value(" bb ( w ) . c /2 "), 0.203125);
  EXPECT_EQ(value("max(bb(O).c, bb(O).a/2) - 2*bb(w).a"), 0);
}

TEST(Expression, ScalesByItsDimension) {
  const ExpressionBoxes twice = {.object = {.sides = {14, 10, 6}}, .worksets = {.sides = {3.5, 1.375, 0.8125}}};
  for (const char* text : {"3/4", "bb(O).a/bb(w).b", "bb(O).a - bb(w).c/2", "max(bb(w).a, bb(O).b)*bb(O).c",
                           "bb(O).a*bb(O).b*bb(O).c", "1/bb(O).a"}) {
    const Expression expression = Expression::parse(text, start);
    EXPECT_DOUBLE_EQ(expression.evaluate(twice), std::pow(2, expression.dimension()) * expression.evaluate(boxes))
        << text;
  }
}

TEST(Expression, KnowsItsDimensionAndBoxes) {
  const Expression ratio = Expression::parse("bb(O).a/bb(w).a", start);
  EXPECT_EQ(ratio.dimension(), 0);
  EXPECT_TRUE(ratio.uses_object());
  EXPECT_TRUE(ratio.uses_worksets());
  const Expression area = Expression::parse("  pi*bb(O).a*bb(O).a/4 ", start);
  EXPECT_EQ(area.dimension(), 2);
  EXPECT_FALSE(area.uses_worksets());
  EXPECT_EQ(area.text(), "pi*bb(O).a*bb(O).a/4");
  EXPECT_FALSE(Expression::parse("3", start).uses_object());
}

TEST(Expression, OnlyTheLiteralZeroFitsEveryDimension) {
  EXPECT_TRUE(Expression::parse("0", start).fits(1));
  EXPECT_TRUE(Expression::parse("0.0", start).fits(2));
  EXPECT_FALSE(Expression::parse("1", start).fits(1));
  EXPECT_FALSE(Expression::parse("1 - 1", start).fits(1)) << "a zero that is computed is a number";
  EXPECT_EQ(Expression::parse("0 + bb(O).a", start).dimension(), 1);
  EXPECT_EQ(Expression::parse("max(bb(O).a*bb(O).b, 0)", start).dimension(), 2);
}

struct DecimalComma : std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
};

TEST(Expression, ReadsTheSameInACommaDecimalLocale) {
  // Streams follow the first of these, strtod the second (where such a locale is installed).
  const std::locale before = std::locale::global(std::locale(std::locale(), new DecimalComma));
  const std::string c_before = std::setlocale(LC_ALL, nullptr);
  for (const char* name : {"fr_FR.UTF-8", "de_DE.UTF-8"}) std::setlocale(LC_ALL, name);
  double read = 0;
  EXPECT_NO_THROW(read = value("1.5"));
  std::setlocale(LC_ALL, c_before.c_str());
  std::locale::global(before);
  EXPECT_EQ(read, 1.5);
}

struct BadText {
  const char* text;
  int column;  ///< of the offending token, the text beginning in column 11
  const char* says;
};

TEST(Expression, ErrorsPointAtTheOffendingToken) {
  const BadText bad[] = {
      {"", 11, "the expression ends where a value should stand"},
      {"1 +", 14, "the expression ends"},
      {"1 + * 2", 15, "found '*'"},
      {"2 bb(O).a", 13, "unexpected 'bb'"},
      {"2(3)", 12, "unexpected '('"},
      {"(1 + 2", 17, "expected ')'"},
      {"1 + 2)", 16, "unexpected ')'"},
      {"bb(O).d", 17, "sides a, b and c"},
      {"bb(0).a", 14, "bb takes O"},
      {"bb(W).a", 14, "bb takes O"},
      {"bb(O):a", 16, "unexpected character ':'"},
      {"bb(O)", 16, "a side"},
      {"1 ^ 2", 13, "unexpected character '^'"},
      {"1 \xE2\x89\xA4 2", 13, "unexpected character '\xE2\x89\xA4'"},
      {"radius", 11, "unknown name 'radius'"},
      {"min(1)", 16, "two or more values"},
      {"max 1, 2", 15, "expected '('"},
      {"1/0", 13, "division by zero"},
      {"1/(2 - 2)", 13, "division by zero"},
      {"1e999", 11, "cannot be held"},
      {"1e300*1e300", 16, "not finite"},
      {"bb(O).a + 1", 19, "cannot add a length and a number"},
      {"bb(O).a - bb(O).a*bb(O).b", 19, "cannot subtract a length and an area"},
      {"min(bb(O).a, 2)", 24, "cannot compare a length and a number"},
      {"bb(O).a*bb(O).b*bb(O).c + bb(w).a", 35, "cannot add a volume and a length"},
      {"1 < 2", 13, "unexpected '<'"},
  };
  for (const BadText& b : bad) {
    EXPECT_THAT(expression_error(b.text), StartsWith("m.yaml:4:" + std::to_string(b.column) + ": ")) << b.text;
    EXPECT_THAT(expression_error(b.text), HasSubstr(b.says)) << b.text;
  }
}

TEST(Expression, RefusesWhatWouldOverflowAStack) {
  EXPECT_THAT(expression_error(std::string(10000, '(')), HasSubstr("nests deeper"));
  std::string right_nested = "1", minus_signs(10000, '-');
  for (int i = 0; i < 40; ++i) right_nested = "1+(" + right_nested + ")";
  EXPECT_THAT(expression_error(right_nested), HasSubstr("intermediate values"));
  EXPECT_EQ(value(minus_signs + "1"), 1) << "an even number of signs";
  std::string long_sum = "1";
  for (int i = 1; i < 10000; ++i) long_sum += "+1";
  EXPECT_EQ(value(long_sum), 10000);
}

TEST(Expression, UsesItsWholeStackSoundly) {
  // The deepest expression that is accepted: every level holds one value back.
  std::string nested = "1";
  for (int i = 1; i < 32; ++i) nested = "1+(" + nested + ")";
  EXPECT_EQ(value(nested), 32);
  EXPECT_THAT(expression_error("1+(" + nested + ")"), HasSubstr("intermediate values"));
}

TEST(Range, ReadsBothBoundsInEitherDirection) {
  for (const char* text : {"bb(w).c/2 < r < bb(O).a", "bb(O).a > r > bb(w).c/2", "bb(w).c/2 <= r <= bb(O).a"}) {
    const ParsedRange range = parse_range(text, start, 1);
    EXPECT_EQ(range.variable, "r");
    ASSERT_TRUE(range.low && range.high) << text;
    EXPECT_EQ(range.low->evaluate(boxes), 0.203125) << text;
    EXPECT_EQ(range.high->evaluate(boxes), 7) << text;
    EXPECT_EQ(range.low->text(), "bb(w).c/2");
    EXPECT_EQ(range.high->text(), "bb(O).a");
  }
}

TEST(Range, ReadsOneBound) {
  for (const char* text : {"r < bb(O).a", "bb(O).a > r", "bb(O).a >= r"}) {
    const ParsedRange range = parse_range(text, start, 1);
    ASSERT_TRUE(range.high && !range.low) << text;
    EXPECT_EQ(range.high->evaluate(boxes), 7);
  }
  for (const char* text : {"bb(O).c < r", "r > bb(O).c", "r >= bb(O).c"}) {
    const ParsedRange range = parse_range(text, start, 1);
    ASSERT_TRUE(range.low && !range.high) << text;
    EXPECT_EQ(range.low->evaluate(boxes), 3);
  }
}

TEST(Range, TakesAnyNameForTheMeasureAndZeroForAnyDimension) {
  EXPECT_EQ(parse_range("0 < length_3 < bb(w).a", start, 1).variable, "length_3");
  EXPECT_TRUE(parse_range("0 < area < bb(O).a*bb(O).b", start, 2).high);
  EXPECT_TRUE(parse_range("0 < x < bb(O).a", start, any_dimension).high);
}

TEST(Range, ErrorsPointAtTheOffendingToken) {
  const BadText bad[] = {
      {"", 11, "ends where a value"},
      {"r", 11, "add a bound"},
      {"bb(O).a", 11, "add a bound"},
      {"bb(O).b < bb(O).a", 11, "no name stands for the measure"},
      {"a < b", 15, "second free name, 'b'"},
      {"0 < r > bb(O).a", 17, "different ways"},
      {"r < bb(O).a < bb(O).b", 15, "between its bounds"},
      {"0 < r < bb(O).b < bb(O).a", 27, "at most two"},
      {"0 < r, 1", 15, "unknown name 'r'"},
      {"0 < 2*r < bb(O).a", 17, "unknown name 'r'"},
      {"< r < bb(O).a", 11, "found '<'"},
      {"0 < r <", 18, "ends where a value"},
      {"0 < r < 2", 19, "'2' is a number, but 'r' is a length"},
      {"bb(O).a*bb(O).b < r < bb(O).a", 11, "is an area, but 'r' is a length"},
  };
  for (const BadText& b : bad) {
    EXPECT_THAT(range_error(b.text), StartsWith("m.yaml:4:" + std::to_string(b.column) + ": ")) << b.text;
    EXPECT_THAT(range_error(b.text), HasSubstr(b.says)) << b.text;
  }
  EXPECT_THAT(range_error("2 < n < 1", 0), StartsWith("m.yaml:4:11: no value lies between '2' and '1'"));
  EXPECT_THAT(range_error("2 < n < bb(O).a", any_dimension),
              StartsWith("m.yaml:4:19: cannot compare a number and a length"));
}

TEST(Range, WhatHoldsOnNoMeshIsRefused) {
  for (const char* text :
       {"bb(O).a < r < bb(O).c", "bb(O).b < r < bb(w).c/2 - bb(O).c", "2*bb(w).a < r < bb(w).a", "bb(O).a < r < 0"})
    EXPECT_THAT(range_error(text), HasSubstr("no value lies between")) << text;
  for (const char* text :
       {"bb(O).c < r < bb(O).a", "bb(w).a < r < bb(O).c", "bb(O).a < r < 100*bb(O).c", "0 < r < bb(w).c"})
    EXPECT_EQ(range_error(text), "no error") << text;
}

}  // namespace
}  // namespace toposcope
