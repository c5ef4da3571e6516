// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "io/soup_builder.h"

namespace toposcope {

/// Reads words and numbers off text. Lines end with LF, CR LF or CR; the locale plays no role.
class TextCursor {
 public:
  struct Syntax {
    bool comments = false;       ///< '#' at the begin of a word: the rest of the line is skipped
    bool continuations = false;  ///< '\' at the end of a line: the next line belongs to it
  };
  /// \param file  for messages; must outlive the cursor
  TextCursor(const std::string& file, std::string_view text, Syntax syntax, std::size_t first_line = 1)
      : file_(&file), at_(text.data()), end_(text.data() + text.size()), syntax_(syntax), line_(first_line) {}

  std::size_t line() const { return line_; }
  MeshFilePlace place() const { return {line_, MeshFilePlace::Unit::line}; }
  std::size_t bytes_left() const { return static_cast<std::size_t>(end_ - at_); }

  /// The next word on this line, empty at its end.
  std::string_view word();
  /// Goes to the next line that holds a word; false at the end of the text. Stays where a word follows on this line.
  bool find_word();
  void skip_line();

  /// The next word, on this line or a later one. \throw MeshError at the end of the text, naming what was expected
  std::string_view need_word(std::string_view what);
  double need_number(std::string_view what);
  std::int64_t need_integer(std::string_view what);

  [[noreturn]] void fail(const std::string& message) const { fail_at(*file_, place(), message); }

  /// \throw MeshError  not a number, or beyond the range of a double
  double number(std::string_view word, std::string_view what) const;
  /// Whole numbers, also when written as 3.0 or 3e2. \throw MeshError
  std::int64_t integer(std::string_view word, std::string_view what) const;

 private:
  void skip_spaces();
  bool at_line_end() const { return at_ == end_ || *at_ == '\n' || *at_ == '\r'; }
  const char* after_line_end(const char* p) const { return p + (*p == '\r' && p + 1 != end_ && p[1] == '\n' ? 2 : 1); }

  const std::string* file_;
  const char* at_;
  const char* end_;
  Syntax syntax_;
  std::size_t line_;
};

}  // namespace toposcope
