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

/// From now on the program says so and ends with exit code 1 where memory is at an end in what may not throw, as in the
/// JSON library's destructors. Anything else that cannot go on still aborts.
void end_in_words_without_memory();

}  // namespace toposcope::cli
