// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/dataset.h"
#include "fuzz_document.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace toposcope;
  return fuzz::read_document(data, size,
                             [](const std::string& text) { read_dataset(fuzz::file_of("dataset.yaml", text)); });
}
