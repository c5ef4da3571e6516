// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stdexcept>

#include "formats/problem_formats.h"
#include "fuzz_document.h"
#include "toposcope/labeling/problem_writer.h"
#include "toposcope/labeling/tools.h"

namespace toposcope::fuzz {

/// Reads a problem with one of the readers of problem_formats.h; what comes out is sound, and is written in every
/// format.
template <class Read>
int read_problem_as(const Read& read, const char* name, const std::uint8_t* data, std::size_t size) {
  return read_document(data, size, [&](const std::string& text) {
    constexpr std::uint64_t budget = 1 << 20;
    const ProblemFile file = read(name, text, budget);
    check(file.problem);
    problem_json(file);
    try {
      write_cfn(file.problem, file.top, file.maximize);
      write_wcsp(file.problem, file.top);
      write_uai(file.problem);
    } catch (const std::invalid_argument&) {  // costs that a format cannot hold
    }
  });
}

}  // namespace toposcope::fuzz
