// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "model/expression.h"

namespace toposcope {

enum class Operation : std::uint8_t {
  constant,
  object_side,
  workset_side,
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
  double value = 0;       ///< of a constant
  std::uint8_t side = 0;  ///< 0 a, 1 b, 2 c
};

/// Postfix code: evaluation walks one contiguous array and allocates nothing.
struct Expression::Program {
  static constexpr std::size_t max_stack = 32;

  std::vector<Instruction> code;
  int dimension = 0;
  bool literal_zero = false;

  bool names(Operation operation) const {
    return std::any_of(code.begin(), code.end(), [&](const Instruction& i) { return i.operation == operation; });
  }
};

}  // namespace toposcope
