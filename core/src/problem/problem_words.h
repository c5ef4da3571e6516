// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace toposcope {

/// Reads blank-separated words off a problem file.
class ProblemWords {
 public:
  ProblemWords(const std::string& where, std::string_view text) : where_(where), text_(text) {}

  /// The next word, empty at the end.
  std::string_view next();
  bool at_end();
  std::string_view need(const char* what);
  double number(const char* what);
  /// \throw UsageError  no whole number within the bounds
  std::int64_t integer(const char* what, std::int64_t least, std::int64_t most);
  /// \throw UsageError  with file and line
  [[noreturn]] void fail(const std::string& message) const;

 private:
  const std::string& where_;
  std::string_view text_;
  std::size_t at_ = 0, line_ = 1;
};

/// \return false: not a number as a whole
bool parse_number(std::string_view word, double& number);

}  // namespace toposcope
