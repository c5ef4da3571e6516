// SPDX-License-Identifier: BSD-3-Clause
#include "io/text_cursor.h"

#include <array>
#include <charconv>
#include <cmath>

namespace toposcope {
namespace {

enum : unsigned char { in_word, space, line_end };

constexpr auto kinds = [] {
  std::array<unsigned char, 256> table{};
  for (unsigned char c : {' ', '\t', '\v', '\f', '\0'}) table[c] = space;
  for (unsigned char c : {'\n', '\r'}) table[c] = line_end;
  return table;
}();

bool is_blank(char c) {
  return kinds[static_cast<unsigned char>(c)] == space;
}
bool is_word_end(char c) {
  return kinds[static_cast<unsigned char>(c)] != in_word;
}

/// std::from_chars takes no leading '+'.
std::string_view without_plus(std::string_view word) {
  return word.size() > 1 && word[0] == '+' && word[1] != '-' && word[1] != '+' ? word.substr(1) : word;
}

}  // namespace

void TextCursor::skip_spaces() {
  while (at_ != end_) {
    if (is_blank(*at_)) {
      ++at_;
    } else if (*at_ == '\\' && syntax_.continuations && at_ + 1 != end_ && (at_[1] == '\n' || at_[1] == '\r')) {
      at_ = after_line_end(at_ + 1);
      ++line_;
    } else if (*at_ == '#' && syntax_.comments) {
      while (!at_line_end()) ++at_;
    } else {
      return;
    }
  }
}

std::string_view TextCursor::word() {
  skip_spaces();
  const char* begin = at_;
  while (at_ != end_ && !is_word_end(*at_) &&
         !(*at_ == '\\' && syntax_.continuations && at_ + 1 != end_ && (at_[1] == '\n' || at_[1] == '\r')))
    ++at_;
  return {begin, static_cast<std::size_t>(at_ - begin)};
}

bool TextCursor::find_word() {
  while (true) {
    skip_spaces();
    if (at_ == end_) return false;
    if (!at_line_end()) return true;
    at_ = after_line_end(at_);
    ++line_;
  }
}

void TextCursor::skip_line() {
  while (!word().empty()) {
  }
  if (at_ == end_) return;
  at_ = after_line_end(at_);
  ++line_;
}

std::string_view TextCursor::need_word(std::string_view what) {
  if (!find_word()) fail("the file ends where " + std::string(what) + " should follow; it is cut short");
  return word();
}

double TextCursor::need_number(std::string_view what) {
  return number(need_word(what), what);
}

std::int64_t TextCursor::need_integer(std::string_view what) {
  return integer(need_word(what), what);
}

double TextCursor::number(std::string_view word, std::string_view what) const {
  const std::string_view digits = without_plus(word);
  double value = 0;
  const auto [rest, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error == std::errc::result_out_of_range) {
    // Too small for a double is zero; too large is an error.
    if (digits.find("e-") != digits.npos || digits.find("E-") != digits.npos) return 0;
    fail(quoted(word) + " is beyond the range of numbers; rescale the mesh");
  }
  if (error != std::errc() || rest != digits.data() + digits.size())
    fail("expected " + std::string(what) + " but found " + quoted(word));
  return value;
}

std::int64_t TextCursor::integer(std::string_view word, std::string_view what) const {
  const std::string_view digits = without_plus(word);
  std::int64_t value = 0;
  const auto [rest, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error == std::errc() && rest == digits.data() + digits.size()) return value;
  const double real = number(word, what);
  if (!(std::abs(real) < 9e15) || real != std::floor(real))
    fail("expected " + std::string(what) + ", a whole number, but found " + quoted(word));
  return static_cast<std::int64_t>(real);
}

}  // namespace toposcope
