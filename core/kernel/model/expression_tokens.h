// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "model/source_location.h"

namespace toposcope {

struct ExpressionToken {
  enum class Kind { number, name, symbol, end };
  Kind kind = Kind::end;
  std::string_view text;   ///< of the expression that was cut
  std::size_t offset = 0;  ///< of the first character
  double value = 0;        ///< of a number

  bool is(std::string_view symbol) const { return kind == Kind::symbol && text == symbol; }
  bool is_comparison() const { return is("<") || is("<=") || is(">") || is(">="); }
};

/// The place of the character at `offset` of a text on one line that begins at `where`.
SourceLocation place_in(const SourceLocation& where, std::size_t offset);

/// Cuts an expression into tokens, the last of kind `end`. Numbers are read the same in every locale.
/// \throw UsageError  a character or a number that the language does not have
std::vector<ExpressionToken> cut_expression(std::string_view text, const SourceLocation& where);

}  // namespace toposcope
