// SPDX-License-Identifier: BSD-3-Clause
#include "fuzz_mesh.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return toposcope::fuzz::read_as("no-such-folder/mesh.gltf", data, size);
}
