// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace toposcope {

/// A square matrix of bits, one row of whole words per row.
struct BitMatrix {
  BitMatrix() = default;
  explicit BitMatrix(std::size_t size) : rows(size), words((size + 63) / 64), bits(size * words) {}
  bool get(std::size_t i, std::size_t j) const { return (bits[i * words + j / 64] >> (j % 64)) & 1U; }
  void set(std::size_t i, std::size_t j) { bits[i * words + j / 64] |= std::uint64_t{1} << (j % 64); }
  void clear(std::size_t i, std::size_t j) { bits[i * words + j / 64] &= ~(std::uint64_t{1} << (j % 64)); }

  std::size_t rows = 0, words = 0;
  std::vector<std::uint64_t> bits;
};

}  // namespace toposcope
