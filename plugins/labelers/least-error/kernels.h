// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The inner loops over rows of cost tables. Integers: the same result on every processor.

#include <algorithm>
#include <cstdint>

namespace toposcope::least_error {

using Cost = std::int32_t;
/// Forbidden. Sums of two stay in range; whatever reaches half of it is forbidden too.
inline constexpr Cost infinite = Cost{1} << 29;
inline constexpr bool is_forbidden(Cost cost) {
  return cost >= infinite / 2;
}

inline constexpr Cost saturated(Cost a, Cost b) {
  return is_forbidden(a) || is_forbidden(b) ? infinite : std::min(infinite, a + b);
}

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)
#define TOPOSCOPE_WIDE __attribute__((target_clones("avx2", "default")))
#else
#define TOPOSCOPE_WIDE
#endif

/// min over b of row[b] + weight[b].
Cost least_sum(const Cost* row, const Cost* weight, int size);

/// need[b] = max(need[b], level - row[b]).
void raise(Cost* need, const Cost* row, Cost level, int size);

}  // namespace toposcope::least_error
