// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <functional>
#include <string>
#include <vector>

#include "reading/problem_text.h"

namespace toposcope {

/// The parameters of a function in intension as .cfn tags them, put into the order and form of .wcsp.
class CfnParameters {
 public:
  /// \param index_of  index of the variable that a word names
  CfnParameters(ProblemText& text, bool tagged, std::function<std::string(const ProblemToken&)> index_of)
      : text_(text), tagged_(tagged), index_of_(std::move(index_of)) {}

  /// From after the opening to after the closing bracket.
  void read(const ProblemToken& keyword);

  /// The next parameter, in the order of .wcsp. \throw UsageError  there are no more
  ProblemToken next(std::string_view what);
  bool at_end() const { return at_ == words_.size(); }
  /// Of the word to come.
  const ProblemToken& place() const { return at_end() ? end_ : words_[at_]; }

 private:
  void tag(std::string_view name);
  void list(bool variables, bool counted);
  void tuples(bool variables);
  void lists();
  std::size_t rules(bool terminals, std::vector<ProblemToken>& made);
  ProblemToken variable(const ProblemToken& word);
  ProblemToken made_word(const ProblemToken& at, std::string word);

  ProblemText& text_;
  bool tagged_;
  std::function<std::string(const ProblemToken&)> index_of_;
  std::vector<ProblemToken> words_;
  std::deque<std::string> made_;  ///< texts of words that do not stand in the file
  ProblemToken end_;
  std::size_t at_ = 0;
};

bool opens(const ProblemToken& token);
bool closes(const ProblemToken& token);
/// \throw UsageError
void need_open(ProblemText& text, std::string_view what);
void need_close(ProblemText& text, std::string_view what);

}  // namespace toposcope
