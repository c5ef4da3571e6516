// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "model/source_location.h"
#include "toposcope/types.h"

namespace toposcope {

/// The boxes that an expression may name: `bb(O)` the object's, `bb(w)` the working sets' at hand.
struct ExpressionBoxes {
  Box object;
  Box worksets;
};

/// A checked arithmetic expression over box sides: numbers, + - * / ( ), min, max, bb(O).a|b|c, bb(w).a|b|c, pi.
class Expression {
 public:
  /// \param where  of the first character of `text`, so that errors name file:line:column
  /// \throw UsageError  syntax; a sum or comparison of unlike dimensions
  static Expression parse(std::string_view text, const SourceLocation& where);

  double evaluate(const ExpressionBoxes& boxes) const;
  int dimension() const;            ///< power of length: bb(O).a has 1, a number 0
  bool fits(int dimension) const;   ///< has that dimension; the literal 0 fits every dimension
  bool uses_object() const;         ///< names bb(O)
  bool uses_worksets() const;       ///< names bb(w)
  const std::string& text() const;  ///< as written

 private:
  struct Program;
  std::shared_ptr<const Program> program_;
  std::string text_;
  friend struct ExpressionParser;
};

/// An expression whose value cannot be used on a mesh. \throw MeshError  the mesh is flat; UsageError  else
[[noreturn]] void refuse_on_mesh(const Expression& expression, const ExpressionBoxes& boxes,
                                 const SourceLocation& where, const std::string& what, const std::string& needed);

/// The value of an expression that must be positive, such as a tolerance. \throw UsageError, MeshError  it is not, on
/// this mesh
double positive_on_mesh(const Expression& expression, const ExpressionBoxes& boxes, const SourceLocation& where,
                        const std::string& what);

/// `low < r < high` with one free name, which stands for the measure; either bound may be absent (`r < high`,
/// `low < r`); > is accepted. `<=` equals `<`: the bounds are floating-point.
struct ParsedRange {
  std::string variable;
  std::optional<Expression> low, high;
};

/// For `parse_range` where nobody knows the measure's dimension: its bounds must still agree with each other.
inline constexpr int any_dimension = -1000;

/// The kind of quantity in words: "a number", "a length", "an area".
std::string dimension_in_words(int dimension);
/// The same where angles occur: "an angle". \param angle  power of degrees
std::string quantity_in_words(int dimension, int angle);

/// \param where      of the first character of `text`
/// \param dimension  of the measure: bounds of another dimension are an error
/// \throw UsageError  syntax, no or several free names, unlike dimensions, a range between constants that holds nothing
ParsedRange parse_range(std::string_view text, const SourceLocation& where, int dimension);

}  // namespace toposcope
