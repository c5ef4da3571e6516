// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Arrays of many megabytes. The first touch of a page goes through the system, which can cost more than all that is
// done with the page afterwards; huge pages are touched five hundred times more rarely.

#include <cstddef>
#include <vector>

namespace toposcope {

/// Asks the system to back this memory with huge pages, where it is large enough to gain from them. Only advice.
void advise_huge_pages(void* begin, std::size_t bytes);

/// Like v.reserve(count).
template <class T>
void reserve_large(std::vector<T>& v, std::size_t count) {
  if (count <= v.capacity()) return;
  v.reserve(count);
  // What is not yet in use has not been touched.
  advise_huge_pages(v.data() + v.size(), (count - v.size()) * sizeof(T));
}

/// An array of `count` default (or equal) elements.
template <class T, class... Value>
std::vector<T> large_array(std::size_t count, const Value&... value) {
  std::vector<T> v;
  reserve_large(v, count);
  v.resize(count, value...);
  return v;
}

}  // namespace toposcope
