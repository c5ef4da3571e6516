// SPDX-License-Identifier: BSD-3-Clause
#include "model/error_list.h"

#include <algorithm>
#include <tuple>

namespace toposcope {

void ErrorList::throw_if_any() const {
  if (errors_.empty()) return;
  std::vector<Entry> sorted = errors_;
  std::stable_sort(sorted.begin(), sorted.end(), [](const Entry& a, const Entry& b) {
    return std::tie(a.where.line, a.where.column) < std::tie(b.where.line, b.where.column);
  });
  std::string all;
  for (const Entry& entry : sorted) all += (all.empty() ? "" : "\n") + entry.message;
  throw UsageError(all);
}

}  // namespace toposcope
