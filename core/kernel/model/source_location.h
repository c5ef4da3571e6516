// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace toposcope {

/// A place in a text file; line and column from 1.
struct SourceLocation {
  std::string file;
  int line = 0, column = 0;
  std::string str() const { return file + ":" + std::to_string(line) + ":" + std::to_string(column); }
};

}  // namespace toposcope
