// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "model/expression.h"

namespace toposcope {

enum class Operation : std::uint8_t {
  constant,
  object_side,
  workset_side,
  quantity,
  negate,
  add,
  subtract,
  multiply,
  divide,
  minimum,
  maximum
};

/// The value of a binary operation.
double apply(Operation operation, double left, double right);

struct Instruction {
  Operation operation = Operation::constant;
  double value = 0;         ///< of a constant
  std::uint32_t index = 0;  ///< of a side: 0 a, 1 b, 2 c; of a quantity: its place among the measure's
};

inline constexpr std::size_t max_stack = 32;  ///< values that an evaluation holds at a time

/// Runs postfix code over any arithmetic that has `apply` and a minus.
/// \param leaf  gives the value of an instruction that takes none
template <class Value, class Leaf>
Value run(const std::vector<Instruction>& code, const Leaf& leaf) {
  std::array<Value, max_stack> stack;
  std::size_t top = 0;
  for (const Instruction& step : code) {
    if (step.operation < Operation::negate) {
      stack[top++] = leaf(step);
    } else if (step.operation == Operation::negate) {
      stack[top - 1] = -stack[top - 1];
    } else {
      --top;
      stack[top - 1] = apply(step.operation, stack[top - 1], stack[top]);
    }
  }
  return stack[0];
}

/// Postfix code: evaluation walks one contiguous array and allocates nothing.
struct Expression::Program {
  std::vector<Instruction> code;
  int dimension = 0;
  bool literal_zero = false;

  bool names(Operation operation) const {
    return std::any_of(code.begin(), code.end(), [&](const Instruction& i) { return i.operation == operation; });
  }
};

}  // namespace toposcope
