// SPDX-License-Identifier: BSD-3-Clause
#include "fuzz_catalog.h"
#include "fuzz_document.h"
#include "model/read_model.h"
#include "model/show_model.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace toposcope;
  return fuzz::read_document(data, size, [](const std::string& text) {
    const Model model = read_model(fuzz::file_of("model.yaml", text), &fuzz::catalog());
    model_as_text(model);
    model_as_dot(model);
  });
}
