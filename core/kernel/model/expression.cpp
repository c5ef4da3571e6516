// SPDX-License-Identifier: BSD-3-Clause
#include "model/expression.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <limits>

#include "base/errors.h"
#include "model/expression_program.h"

namespace toposcope {
namespace {

/// Thickness of a box, as part of its length, below which it has none.
constexpr double flat_box = 1e-12;

/// Whether an expression would have a value on a box of the same length that is as wide and thick as long.
bool holds_with_thickness(const Expression& expression, ExpressionBoxes boxes) {
  for (Box* box : {&boxes.object, &boxes.worksets}) box->sides.fill(box->a());
  const double value = expression.evaluate(boxes);
  return value > 0 && std::isfinite(value);
}

}  // namespace

double Expression::evaluate(const ExpressionBoxes& boxes) const {
  return run<double>(program_->code, [&](const Instruction& step) {
    if (step.operation == Operation::object_side) return boxes.object.sides[step.index];
    if (step.operation == Operation::workset_side) return boxes.worksets.sides[step.index];
    return step.value;
  });
}

int Expression::dimension() const {
  return program_->dimension;
}

bool Expression::fits(int dimension) const {
  return program_->literal_zero || program_->dimension == dimension;
}

bool Expression::uses_object() const {
  return program_->names(Operation::object_side);
}

bool Expression::uses_worksets() const {
  return program_->names(Operation::workset_side);
}

const std::string& Expression::text() const {
  return text_;
}

double apply(Operation operation, double left, double right) {
  switch (operation) {
    case Operation::add:
      return left + right;
    case Operation::subtract:
      return left - right;
    case Operation::multiply:
      return left * right;
    case Operation::divide:
      return left / right;
    case Operation::minimum:
      return std::min(left, right);
    case Operation::maximum:
      return std::max(left, right);
    default:
      assert(false && "not a binary operation");
      return std::numeric_limits<double>::quiet_NaN();
  }
}

std::string dimension_in_words(int dimension) {
  switch (dimension) {
    case 0:
      return "a number";
    case 1:
      return "a length";
    case 2:
      return "an area";
    case 3:
      return "a volume";
    default:
      return "a length to the power " + std::to_string(dimension);
  }
}

std::string quantity_in_words(int dimension, int angle) {
  if (angle == 0) return dimension_in_words(dimension);
  const std::string power = angle == 1 ? "an angle" : "an angle to the power " + std::to_string(angle);
  return dimension == 0 ? power : dimension_in_words(dimension) + " times " + power;
}

double positive_on_mesh(const Expression& expression, const ExpressionBoxes& boxes, const SourceLocation& where,
                        const std::string& what) {
  const double value = expression.evaluate(boxes);
  if (value > 0 && std::isfinite(value)) return value;
  refuse_on_mesh(expression, boxes, where, what, "must be positive");
}

void refuse_on_mesh(const Expression& expression, const ExpressionBoxes& boxes, const SourceLocation& where,
                    const std::string& what, const std::string& needed) {
  const std::string is = fmt::format("{} '{}' is {:.4g}", what, expression.text(), expression.evaluate(boxes));
  // A model may ask for thickness: then it is the mesh that is wrong.
  if (const Box& box = boxes.object; !(box.c() > flat_box * box.a()) && holds_with_thickness(expression, boxes))
    throw MeshError(
        fmt::format("the mesh is flat: its box is {:.4g} x {:.4g} x {:.4g}, and the model asks for more: "
                    "{}: {}; give a mesh of the whole object, or a model of flat ones",
                    box.a(), box.b(), box.c(), where.str(), is));
  throw UsageError(fmt::format("{}: {} on this mesh; it {}", where.str(), is, needed));
}

}  // namespace toposcope
