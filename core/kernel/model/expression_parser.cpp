// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "base/errors.h"
#include "model/expression_program.h"
#include "model/expression_tokens.h"

namespace toposcope {

/// Recursive descent over the tokens; writes postfix code as it goes.
struct ExpressionParser {
  using Token = ExpressionToken;

  /// What is known of a part of the expression before any box is.
  struct Part {
    int dimension = 0;
    bool literal_zero = false;
    std::optional<double> constant;
  };

  static constexpr int max_depth = 64;

  std::string_view text;
  const SourceLocation& where;
  std::vector<Token> tokens;
  std::size_t next = 0;
  int depth = 0;
  Expression::Program program;

  ExpressionParser(std::string_view text_to_parse, const SourceLocation& place)
      : text(text_to_parse), where(place), tokens(cut_expression(text_to_parse, place)) {}

  const Token& peek() const { return tokens[next]; }
  bool accept(std::string_view symbol) {
    if (!peek().is(symbol)) return false;
    ++next;
    return true;
  }
  [[noreturn]] void fail(const Token& token, const std::string& message) const {
    throw UsageError(place_in(where, token.offset).str() + ": " + message);
  }
  static std::string shown(const Token& token) {
    return token.kind == Token::Kind::end ? "the end of the expression" : "'" + std::string(token.text) + "'";
  }
  void expect(std::string_view symbol, std::string_view after) {
    if (!accept(symbol))
      fail(peek(), "expected '" + std::string(symbol) + "' " + std::string(after) + ", found " + shown(peek()));
  }

  void emit(Operation operation, double value = 0, std::uint8_t side = 0) {
    program.code.push_back({operation, value, side});
  }

  Part combine(Operation operation, const Part& left, const Part& right, const Token& token, int dimension) {
    emit(operation);
    Part result{dimension, false, std::nullopt};
    if (left.constant && right.constant) {
      result.constant = apply(operation, *left.constant, *right.constant);
      if (!std::isfinite(*result.constant)) fail(token, "the value is not finite; use smaller numbers");
    }
    return result;
  }

  /// The dimension that two parts share; the literal 0 takes the other's.
  int common_dimension(const Part& left, const Part& right, const Token& token, const std::string& verb) const {
    if (left.literal_zero) return right.dimension;
    if (right.literal_zero || left.dimension == right.dimension) return left.dimension;
    fail(token, "cannot " + verb + " " + dimension_in_words(left.dimension) + " and " +
                    dimension_in_words(right.dimension) + "; multiply or divide by a side of a box so that both agree");
  }

  Part sum() {
    if (++depth > max_depth)
      fail(peek(), "the expression nests deeper than " + std::to_string(max_depth) + " levels; write it flatter");
    Part left = product();
    while (peek().is("+") || peek().is("-")) {
      const Token token = tokens[next++];
      const bool plus = token.is("+");
      const Part right = product();
      const int dimension = common_dimension(left, right, token, plus ? "add" : "subtract");
      left = combine(plus ? Operation::add : Operation::subtract, left, right, token, dimension);
    }
    --depth;
    return left;
  }

  Part product() {
    Part left = signed_part();
    while (peek().is("*") || peek().is("/")) {
      const Token token = tokens[next++];
      const Token divisor = peek();
      const Part right = signed_part();
      if (token.is("*")) {
        left = combine(Operation::multiply, left, right, token, left.dimension + right.dimension);
      } else {
        if (right.constant && *right.constant == 0) fail(divisor, "division by zero; divide by another number");
        left = combine(Operation::divide, left, right, token, left.dimension - right.dimension);
      }
    }
    return left;
  }

  Part signed_part() {
    bool negative = false;
    while (accept("-")) negative = !negative;
    Part part = primary();
    if (!negative) return part;
    emit(Operation::negate);
    if (part.constant) part.constant = -*part.constant;
    return part;
  }

  Part primary() {
    const Token token = tokens[next];
    if (token.kind == Token::Kind::end) fail(token, "the expression ends where a value should stand; complete it");
    ++next;
    if (token.kind == Token::Kind::number) return number(token.value, token.value == 0);
    if (token.is("(")) {
      const Part part = sum();
      expect(")", "to close the parenthesis");
      return part;
    }
    if (token.kind == Token::Kind::symbol)
      fail(token, "expected a number, bb(...), min, max, pi or '(', found " + shown(token));
    if (token.text == "pi") return number(pi, false);
    if (token.text == "bb") return box_side();
    if (token.text == "min") return extreme(Operation::minimum);
    if (token.text == "max") return extreme(Operation::maximum);
    fail(token, "unknown name '" + std::string(token.text) +
                    "'; an expression names only bb(O), bb(w), min, max and pi, and a range its measure once, alone "
                    "between the comparison signs");
  }

  Part number(double value, bool literal_zero) {
    emit(Operation::constant, value);
    return {0, literal_zero, value};
  }

  Part box_side() {
    expect("(", "after bb");
    const Token box = tokens[next];
    if (box.text != "O" && box.text != "w")
      fail(box, "bb takes O (the object) or w (the working sets), found " + shown(box));
    ++next;
    expect(")", "after bb(" + std::string(box.text));
    expect(".", "and a side (a, b or c) after the box");
    const Token side = tokens[next];
    if (side.text != "a" && side.text != "b" && side.text != "c")
      fail(side, "a box has the sides a, b and c, longest first; found " + shown(side));
    ++next;
    emit(box.text == "O" ? Operation::object_side : Operation::workset_side, 0,
         static_cast<std::uint8_t>(side.text[0] - 'a'));
    return {1, false, std::nullopt};
  }

  Part extreme(Operation operation) {
    const std::string name = operation == Operation::minimum ? "min" : "max";
    expect("(", "after " + name);
    Part left = sum();
    if (!peek().is(",")) fail(peek(), name + " takes two or more values, separated by commas; found " + shown(peek()));
    while (accept(",")) {
      const Token argument = peek();
      const Part right = sum();
      left = combine(operation, left, right, argument, common_dimension(left, right, argument, "compare"));
    }
    expect(")", "after the values of " + name);
    return left;
  }

  /// One expression, up to a comparison sign or the end.
  struct Parsed {
    Expression expression;
    Token first;
    std::optional<double> constant;
  };
  Parsed expression() {
    const Token first = peek();
    program = {};
    const Part part = sum();
    program.dimension = part.dimension;
    program.literal_zero = part.literal_zero;
    check_stack(first);
    Parsed parsed;
    parsed.first = first;
    parsed.constant = part.constant;
    const Token& last = tokens[next - 1];
    parsed.expression.text_ = text.substr(first.offset, last.offset + last.text.size() - first.offset);
    parsed.expression.program_ = std::make_shared<const Expression::Program>(std::move(program));
    return parsed;
  }

  void check_stack(const Token& first) const {
    std::size_t height = 0;
    for (const Instruction& step : program.code) {
      if (step.operation < Operation::negate) ++height;
      if (step.operation > Operation::negate) --height;
      if (height > Expression::Program::max_stack)
        fail(first, "the expression needs more than " + std::to_string(Expression::Program::max_stack) +
                        " intermediate values; write it flatter");
    }
  }

  // ---- ranges ----

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
      if (bounds[0]->constant && bounds[1]->constant && *bounds[0]->constant >= *bounds[1]->constant)
        fail(operands[0].token, "no value lies between '" + low.text() + "' and '" + high.text() +
                                    "'; the lower bound must be less than the upper");
    }
    if (bounds[0]) result.low = bounds[0]->expression;
    if (bounds[1]) result.high = bounds[1]->expression;
    return result;
  }
};

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
  return ExpressionParser(text, where).range(dimension);
}

}  // namespace toposcope
