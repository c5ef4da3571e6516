// SPDX-License-Identifier: BSD-3-Clause
#include "kernels.h"

namespace toposcope::least_error {

__attribute__((noinline)) TOPOSCOPE_WIDE Cost least_sum(const Cost* row, const Cost* weight, int size) {
  Cost least = 2 * infinite - 1;
  for (int b = 0; b < size; ++b) {
    const Cost sum = row[b] + weight[b];
    least = sum < least ? sum : least;
  }
  return least;
}

__attribute__((noinline)) TOPOSCOPE_WIDE void raise(Cost* need, const Cost* row, Cost level, int size) {
  for (int b = 0; b < size; ++b) {
    const Cost lack = level - row[b];
    need[b] = lack > need[b] ? lack : need[b];
  }
}

}  // namespace toposcope::least_error
