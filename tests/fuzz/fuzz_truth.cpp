// SPDX-License-Identifier: BSD-3-Clause
#include "fuzz_document.h"
#include "truth/truth.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace toposcope;
  return fuzz::read_document(data, size, [](const std::string& text) {
    const Truth truth = read_truth(fuzz::file_of("mesh.truth.json", text));
    for (const TruthFeature& feature : truth.features) feature.band();
  });
}
