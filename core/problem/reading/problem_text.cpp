// SPDX-License-Identifier: BSD-3-Clause
#include "reading/problem_text.h"

#include <charconv>
#include <cmath>

#include "base/errors.h"
#include "base/text_file.h"

namespace toposcope {
namespace {

bool is_space(char c) {
  return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\f' || c == '\v';
}

std::string_view without_plus(std::string_view word) {
  return word.size() > 1 && word[0] == '+' && word[1] != '-' && word[1] != '+' ? word.substr(1) : word;
}

}  // namespace

void ProblemText::advance() {
  if (text_[at_] == '\n') {
    ++line_;
    line_begin_ = at_ + 1;
  }
  ++at_;
}

void ProblemText::skip() {
  while (at_ < text_.size()) {
    const bool hash = syntax_.comments && text_[at_] == '#' && at_ == line_begin_;
    const bool slashes = syntax_.comments && text_.substr(at_, 2) == "//";
    if (hash || slashes) {
      while (at_ < text_.size() && text_[at_] != '\n') advance();
    } else if (is_space(text_[at_]) || separates(text_[at_])) {
      advance();
    } else {
      return;
    }
  }
}

ProblemToken ProblemText::next() {
  skip();
  ProblemToken token{{}, line_, at_ - line_begin_ + 1, at_ >= text_.size(), false};
  if (token.end) return token;
  if (syntax_.quotes && text_[at_] == '"') {
    const std::size_t close = text_.find('"', at_ + 1);
    if (close == text_.npos || text_.substr(at_, close - at_).find('\n') != text_.npos)
      fail(token, "the quote is not closed on its line; close it with '\"'");
    token.text = text_.substr(at_ + 1, close - at_ - 1);
    token.quoted = true;
    at_ = close + 1;
    return token;
  }
  const std::size_t first = at_++;
  if (syntax_.single.find(text_[first]) == text_.npos)
    while (at_ < text_.size() && !is_space(text_[at_]) && !separates(text_[at_]) &&
           syntax_.single.find(text_[at_]) == text_.npos && !(syntax_.quotes && text_[at_] == '"') &&
           !(syntax_.comments && text_.substr(at_, 2) == "//"))
      ++at_;
  token.text = text_.substr(first, at_ - first);
  return token;
}

ProblemToken ProblemText::peek() {
  const ProblemText saved = *this;
  const ProblemToken token = next();
  *this = saved;
  return token;
}

ProblemToken ProblemText::need(std::string_view what) {
  const ProblemToken token = next();
  if (token.end) fail(token, "the file ends where " + std::string(what) + " should follow; it is cut short");
  return token;
}

double ProblemText::number(const ProblemToken& token, std::string_view what) const {
  const std::string_view digits = without_plus(token.text);
  double value = 0;
  const auto [rest, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  const bool whole = rest == digits.data() + digits.size();
  if (error == std::errc::result_out_of_range && whole && digits.find_first_of("eE") + 1 < digits.size() &&
      digits[digits.find_first_of("eE") + 1] == '-')
    return 0;  // too small for a double
  if (token.end || error != std::errc() || !whole || !std::isfinite(value))
    fail(token, "expected " + std::string(what) + ", a number, but found " + name(token));
  return value;
}

std::int64_t ProblemText::integer(const ProblemToken& token, std::string_view what, std::int64_t least,
                                  std::int64_t greatest) const {
  const std::string_view digits = without_plus(token.text);
  std::int64_t value = 0;
  const auto [rest, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (token.end || error != std::errc() || rest != digits.data() + digits.size())
    fail(token, "expected " + std::string(what) + ", a whole number, but found " + name(token));
  if (value < least || value > greatest)
    fail(token, std::string(what) + " cannot be " + std::string(token.text) + ": it must be from " +
                    std::to_string(least) + " to " + std::to_string(greatest));
  return value;
}

void ProblemText::fail(const ProblemToken& at, const std::string& message) const {
  throw UsageError(*file_ + ":" + std::to_string(at.line) + ":" + std::to_string(at.column) + ": " + message);
}

std::string ProblemText::name(const ProblemToken& token) {
  if (token.end) return "the end of the file";
  constexpr std::size_t longest = 40;
  return "'" + std::string(token.text.substr(0, longest)) + (token.text.size() > longest ? "...'" : "'");
}

std::string read_problem_text(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::exists(path, error)) throw UsageError(path.string() + ": no such file");
  return read_text_file(path, "problem file");
}

}  // namespace toposcope
