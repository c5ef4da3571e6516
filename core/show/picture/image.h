// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace toposcope {

struct Image {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgba;  ///< row by row from the top; alpha is not multiplied in
};

/// As a PNG file; without alpha where all of it is opaque.
std::string to_png(const Image& image);

}  // namespace toposcope
