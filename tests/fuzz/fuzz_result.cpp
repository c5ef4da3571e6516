// SPDX-License-Identifier: BSD-3-Clause
// A result is read with its mesh, and what it says is drawn: where its hash is that of the mesh, as in the seeds.
#include "fuzz_document.h"
#include "scene/stored_result.h"
#include "small_mesh.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace toposcope;
  static const std::filesystem::path mesh = fuzz::file_of("mesh.off", fuzz::small_mesh);
  return fuzz::read_document(data, size, [](const std::string& text) {
    to_json(scene_of(read_labelled_mesh(fuzz::file_of("result.json", text), mesh), nullptr), "fuzz");
  });
}
