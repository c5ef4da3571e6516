// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace toposcope::cli {

struct Failure {
  std::string message;
  int exit_code = 1;
};

/// The exception that is being caught, in words and as an exit code.
Failure present_failure();

}  // namespace toposcope::cli
