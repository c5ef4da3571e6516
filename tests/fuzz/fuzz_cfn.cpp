// SPDX-License-Identifier: BSD-3-Clause
#include "fuzz_problem.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return toposcope::fuzz::read_problem_as(toposcope::read_cfn, "problem.cfn", data, size);
}
