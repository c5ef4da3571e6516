// SPDX-License-Identifier: BSD-3-Clause
#include "model/expression_parser.h"

#include <algorithm>

namespace toposcope {
namespace {

/// Whether the lower bound reaches the upper one on boxes of all proportions, so that no mesh has a value between them.
/// A part's box may be longer than the whole's, along a diagonal, but not by much on any side.
bool never_holds(const Expression& low, const Expression& high) {
  constexpr double shares[] = {1, 0.5, 0.1, 0.01};
  for (const double b : shares)
    for (const double c : shares)
      for (const double size : shares)
        for (const double wb : shares)
          for (const double wc : shares) {
            ExpressionBoxes boxes;
            boxes.object.sides = {1, b, b * c};
            constexpr double longer = 1.5;
            const double a = longer * size;
            boxes.worksets.sides = {a, std::min(a * wb, longer * b), std::min(a * wb * wc, longer * b * c)};
            if (low.evaluate(boxes) < high.evaluate(boxes)) return false;
          }
  return true;
}

struct RangeParser final : ExpressionParser {
  using ExpressionParser::ExpressionParser;

  bool at_measure() const {
    const Token& token = peek();
    const bool reserved = token.text == "bb" || token.text == "pi" || token.text == "min" || token.text == "max";
    return token.kind == Token::Kind::name && !reserved &&
           (tokens[next + 1].is_comparison() || tokens[next + 1].kind == Token::Kind::end);
  }

  ParsedRange range(int dimension) {
    struct Operand {
      std::optional<Parsed> bound;
      Token token;
    };
    std::vector<Operand> operands;
    std::vector<Token> signs;
    ParsedRange result;
    while (true) {
      const Token token = peek();
      if (at_measure()) {
        if (!result.variable.empty())
          fail(token, "a second free name, '" + std::string(token.text) + "' after '" + result.variable +
                          "'; a range has one, which stands for the measure");
        result.variable = token.text;
        ++next;
        operands.push_back({std::nullopt, token});
      } else {
        operands.push_back({expression(), token});
      }
      if (peek().kind == Token::Kind::end) break;
      if (!peek().is_comparison()) fail(peek(), "expected < or >, found " + shown(peek()));
      if (operands.size() == 3) fail(peek(), "a range has at most two comparisons, as in 'low < r < high'");
      signs.push_back(tokens[next++]);
    }
    if (signs.empty()) fail(operands[0].token, "a range compares, as in 'low < r < high'; add a bound");
    if (result.variable.empty())
      fail(operands[0].token, "no name stands for the measure; write the range as in 'low < r < high'");
    if (signs.size() == 2 && signs[0].text[0] != signs[1].text[0])
      fail(signs[1], "the comparisons point different ways; write 'low < r < high'");
    if (signs.size() == 2 && operands[1].bound)
      fail(operands[1].token, "the measure must stand between its bounds, as in 'low < r < high'");

    const bool rising = signs[0].text[0] == '<';
    std::optional<Parsed> bounds[2];  // low, high
    for (std::size_t i = 0; i < operands.size(); ++i) {
      if (!operands[i].bound) continue;
      const bool before = i == 0;
      bounds[before == rising ? 0 : 1] = operands[i].bound;
    }
    for (const auto& bound : bounds)
      if (bound && dimension != any_dimension && !bound->expression.fits(dimension))
        fail(bound->first, "'" + bound->expression.text() + "' is " +
                               dimension_in_words(bound->expression.dimension()) + ", but '" + result.variable +
                               "' is " + dimension_in_words(dimension));
    if (bounds[0] && bounds[1]) {
      const Expression &low = bounds[0]->expression, &high = bounds[1]->expression;
      if (!low.fits(high.dimension()) && !high.fits(low.dimension()))
        fail(operands[2].token, "cannot compare " + dimension_in_words(low.dimension()) + " and " +
                                    dimension_in_words(high.dimension()) + "; the bounds of a range must agree");
      if (never_holds(low, high))
        fail(operands[0].token, "no value lies between '" + low.text() + "' and '" + high.text() +
                                    "'; the lower bound must be less than the upper");
    }
    if (bounds[0]) result.low = bounds[0]->expression;
    if (bounds[1]) result.high = bounds[1]->expression;
    return result;
  }
};

}  // namespace

Expression Expression::parse(std::string_view text, const SourceLocation& where) {
  ExpressionParser parser(text, where);
  Expression result = parser.expression().expression;
  const ExpressionToken& rest = parser.peek();
  if (rest.kind != ExpressionToken::Kind::end)
    parser.fail(rest, "unexpected " + ExpressionParser::shown(rest) + " after '" + result.text() +
                          "'; join values by an operator");
  return result;
}

ParsedRange parse_range(std::string_view text, const SourceLocation& where, int dimension) {
  return RangeParser(text, where).range(dimension);
}

}  // namespace toposcope
