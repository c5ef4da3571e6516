// SPDX-License-Identifier: BSD-3-Clause
#include "fuzz_catalog.h"
#include "fuzz_document.h"
#include "pipeline/pipeline_manifest.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace toposcope;
  return fuzz::read_document(data, size, [](const std::string& text) {
    read_pipeline(fuzz::file_of("pipeline.yaml", text), fuzz::catalog());
  });
}
