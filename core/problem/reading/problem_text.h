// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace toposcope {

/// A word of a problem file and where it stands.
struct ProblemToken {
  std::string_view text;  ///< empty at the end of the file (and for "")
  std::size_t line = 0, column = 0;
  bool end = false;
  bool quoted = false;

  bool is(std::string_view word) const { return !end && text == word; }
};

/// Cuts the text of a problem file into words, and makes the errors that name a place in it.
class ProblemText {
 public:
  struct Syntax {
    std::string_view separators;  ///< beside white space
    std::string_view single;      ///< characters that are words by themselves
    bool comments = false;        ///< '#' at the begin of a line, '//' anywhere, to the line's end
    bool quotes = false;          ///< a word may stand between double quotes
  };
  /// \param file, text  must outlive the object
  ProblemText(const std::string& file, std::string_view text, const Syntax& syntax)
      : file_(&file), text_(text), syntax_(syntax) {}

  ProblemToken next();
  ProblemToken peek();

  /// The next word. \throw UsageError  the file ends
  ProblemToken need(std::string_view what);
  /// A finite number, '.' the decimal point whatever the locale. \throw UsageError
  double need_number(std::string_view what) { return number(need(what), what); }
  /// \throw UsageError  no whole number, or out of its range
  std::int64_t need_integer(std::string_view what, std::int64_t least, std::int64_t greatest) {
    return integer(need(what), what, least, greatest);
  }

  double number(const ProblemToken& token, std::string_view what) const;
  std::int64_t integer(const ProblemToken& token, std::string_view what, std::int64_t least,
                       std::int64_t greatest) const;

  /// \throw UsageError  "file:line:column: message"
  [[noreturn]] void fail(const ProblemToken& at, const std::string& message) const;
  /// "'word'", or "the end of the file".
  static std::string name(const ProblemToken& token);
  const std::string& file() const { return *file_; }

 private:
  bool separates(char c) const { return syntax_.separators.find(c) != std::string_view::npos; }
  void skip();
  void advance();

  const std::string* file_;
  std::string_view text_;
  Syntax syntax_;
  std::size_t at_ = 0, line_ = 1, line_begin_ = 0;
};

/// Reads a file whole. \throw UsageError
std::string read_problem_text(const std::filesystem::path& path);

}  // namespace toposcope
