// SPDX-License-Identifier: BSD-3-Clause
#include "model/expression_tokens.h"

#include <charconv>
#include <string>

#include "base/errors.h"

namespace toposcope {
namespace {

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}
bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}
bool is_space(char c) {
  return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

/// A whole UTF-8 character, so that a message never shows half of one.
std::string_view character_at(std::string_view text, std::size_t offset) {
  std::size_t end = offset + 1;
  while (end < text.size() && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) ++end;
  return text.substr(offset, end - offset);
}

}  // namespace

SourceLocation place_in(const SourceLocation& where, std::size_t offset) {
  return {where.file, where.line, where.column + static_cast<int>(offset)};
}

std::vector<ExpressionToken> cut_expression(std::string_view text, const SourceLocation& where) {
  using Kind = ExpressionToken::Kind;
  std::vector<ExpressionToken> tokens;
  std::size_t at = 0;
  while (true) {
    while (at < text.size() && is_space(text[at])) ++at;
    if (at == text.size()) break;
    const char first = text[at];
    const char second = at + 1 < text.size() ? text[at + 1] : '\0';
    ExpressionToken token{Kind::symbol, {}, at, 0};
    std::size_t end = at + 1;
    if (is_digit(first) || (first == '.' && is_digit(second))) {
      token.kind = Kind::number;
      const auto [stop, error] = std::from_chars(text.data() + at, text.data() + text.size(), token.value);
      end = static_cast<std::size_t>(stop - text.data());
      if (error != std::errc())
        throw UsageError(place_in(where, at).str() + ": the number '" + std::string(text.substr(at, end - at)) +
                         "' cannot be held; use one between 1e-300 and 1e300");
    } else if (is_letter(first)) {
      token.kind = Kind::name;
      while (end < text.size() && (is_letter(text[end]) || is_digit(text[end]))) ++end;
    } else if ((first == '<' || first == '>') && second == '=') {
      ++end;
    } else if (std::string_view("+-*/(),.<>[]").find(first) == std::string_view::npos) {
      throw UsageError(place_in(where, at).str() + ": unexpected character '" + std::string(character_at(text, at)) +
                       "'; an expression is made of numbers, + - * / ( ), min, max, pi, bb(O).a and bb(w).a");
    }
    token.text = text.substr(at, end - at);
    tokens.push_back(token);
    at = end;
  }
  tokens.push_back({Kind::end, {}, text.size(), 0});
  return tokens;
}

}  // namespace toposcope
