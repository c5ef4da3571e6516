// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>

#include "base/errors.h"

namespace toposcope::test {

/// What is said of a file that is refused; empty: it is read.
inline std::string refusal(const std::function<void()>& read) {
  try {
    read();
  } catch (const UsageError& error) {
    return error.what();
  }
  return "";
}

}  // namespace toposcope::test
