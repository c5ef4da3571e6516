// SPDX-License-Identifier: BSD-3-Clause
#include "problem/problem_words.h"

#include <charconv>
#include <cmath>

#include "base/errors.h"

namespace toposcope {

bool parse_number(std::string_view word, double& number) {
  if (!word.empty() && word.front() == '+') word.remove_prefix(1);
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  return error == std::errc{} && end == word.data() + word.size() && !std::isnan(number);
}

std::string_view ProblemWords::next() {
  const auto blank = [](char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; };
  for (; at_ < text_.size() && blank(text_[at_]); ++at_) line_ += text_[at_] == '\n';
  const std::size_t begin = at_;
  while (at_ < text_.size() && !blank(text_[at_])) ++at_;
  return text_.substr(begin, at_ - begin);
}

bool ProblemWords::at_end() {
  const std::size_t at = at_, line = line_;
  const bool end = next().empty();
  at_ = at;
  line_ = line;
  return end;
}

std::string_view ProblemWords::need(const char* what) {
  const std::string_view word = next();
  if (word.empty()) fail(std::string("the file ends where ") + what + " should stand; it is cut short");
  return word;
}

double ProblemWords::number(const char* what) {
  const std::string_view word = need(what);
  double number = 0;
  if (!parse_number(word, number))
    fail("'" + std::string(word) + "' stands where " + what + " should; it must be a number");
  return number;
}

std::int64_t ProblemWords::integer(const char* what, std::int64_t least, std::int64_t most) {
  const double value = number(what);
  if (!(value >= static_cast<double>(least) && value <= static_cast<double>(most)) || value != std::floor(value))
    fail(std::string(what) + " must be a whole number from " + std::to_string(least) + " to " + std::to_string(most));
  return static_cast<std::int64_t>(value);
}

void ProblemWords::fail(const std::string& message) const {
  throw UsageError(where_ + ":" + std::to_string(line_) + ": " + message);
}

}  // namespace toposcope
