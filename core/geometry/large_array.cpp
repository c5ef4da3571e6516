// SPDX-License-Identifier: BSD-3-Clause
#include "toposcope/geometry/large_array.h"

#include <cstdint>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace toposcope {

void advise_huge_pages([[maybe_unused]] void* begin, [[maybe_unused]] std::size_t bytes) {
#if defined(__linux__)
  constexpr std::uintptr_t page = 4096, huge = 2 << 20;
  if (bytes < 2 * huge) return;
  // Whole pages of our own only; a refusal changes nothing but the speed.
  const auto first = (reinterpret_cast<std::uintptr_t>(begin) + page - 1) / page * page;
  const auto last = (reinterpret_cast<std::uintptr_t>(begin) + bytes) / page * page;
  // NOLINTNEXTLINE(performance-no-int-to-ptr): a page within the array
  madvise(reinterpret_cast<void*>(first), last - first, MADV_HUGEPAGE);
#endif
}

}  // namespace toposcope
