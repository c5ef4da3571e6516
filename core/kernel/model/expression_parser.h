// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The grammar of expressions, for those that add names or comparisons to it.

#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

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
    std::optional<double> constant = std::nullopt;
    int angle = 0;  ///< power of degrees: 0 but for measures
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
  virtual ~ExpressionParser() = default;

  /// A name that the language itself does not have.
  virtual Part named(const Token& token) {
    fail(token, "unknown name '" + std::string(token.text) +
                    "'; an expression names only bb(O), bb(w), min, max and pi, and a range its measure once, alone "
                    "between the comparison signs");
  }

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

  void emit(Operation operation, double value = 0, std::uint32_t index = 0) {
    program.code.push_back({operation, value, index});
  }

  Part combine(Operation operation, const Part& left, const Part& right, const Token& token, const Part& unit) {
    emit(operation);
    Part result = unit;
    const auto unknown = [](const Part& part) { return part.literal_zero && !part.constant; };
    const bool scales = operation == Operation::multiply || operation == Operation::divide;
    result.literal_zero = unit.literal_zero || (scales && (unknown(left) || unknown(right)));  // still unknown
    if (left.constant && right.constant) {
      result.constant = apply(operation, *left.constant, *right.constant);
      if (!std::isfinite(*result.constant)) fail(token, "the value is not finite; use smaller numbers");
    }
    return result;
  }

  static std::string unit_in_words(const Part& part) { return quantity_in_words(part.dimension, part.angle); }

  /// The unit that two parts share; the literal 0 takes the other's, and a number beside an angle counts degrees.
  Part common_unit(const Part& left, const Part& right, const Token& token, const std::string& verb) const {
    const auto unit = [](const Part& part) { return Part{.dimension = part.dimension, .angle = part.angle}; };
    const auto counts_degrees = [](const Part& number, const Part& angle) {
      return number.constant && number.dimension == 0 && angle.dimension == 0 && angle.angle == 1;
    };
    if (left.literal_zero || counts_degrees(left, right)) return unit(right);
    if (right.literal_zero || counts_degrees(right, left)) return unit(left);
    if (left.dimension == right.dimension && left.angle == right.angle) return unit(left);
    fail(token, "cannot " + verb + " " + unit_in_words(left) + " and " + unit_in_words(right) +
                    "; multiply or divide by a side of a box so that both agree");
  }

  Part sum() {
    if (++depth > max_depth)
      fail(peek(), "the expression nests deeper than " + std::to_string(max_depth) + " levels; write it flatter");
    Part left = product();
    while (peek().is("+") || peek().is("-")) {
      const Token token = tokens[next++];
      const bool plus = token.is("+");
      const Part right = product();
      const Part unit = common_unit(left, right, token, plus ? "add" : "subtract");
      left = combine(plus ? Operation::add : Operation::subtract, left, right, token, unit);
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
        left = combine(Operation::multiply, left, right, token,
                       {.dimension = left.dimension + right.dimension, .angle = left.angle + right.angle});
      } else {
        if (right.constant && *right.constant == 0) fail(divisor, "division by zero; divide by another number");
        left = combine(Operation::divide, left, right, token,
                       {.dimension = left.dimension - right.dimension, .angle = left.angle - right.angle});
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
    return named(token);
  }

  Part number(double value, bool literal_zero) {
    emit(Operation::constant, value);
    return {.literal_zero = literal_zero, .constant = value};
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
         static_cast<std::uint32_t>(side.text[0] - 'a'));
    return {.dimension = 1};
  }

  Part extreme(Operation operation) {
    const std::string name = operation == Operation::minimum ? "min" : "max";
    expect("(", "after " + name);
    Part left = sum();
    if (!peek().is(",")) fail(peek(), name + " takes two or more values, separated by commas; found " + shown(peek()));
    while (accept(",")) {
      const Token argument = peek();
      const Part right = sum();
      left = combine(operation, left, right, argument, common_unit(left, right, argument, "compare"));
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
      if (height > max_stack)
        fail(first,
             "the expression needs more than " + std::to_string(max_stack) + " intermediate values; write it flatter");
    }
  }
};

}  // namespace toposcope
