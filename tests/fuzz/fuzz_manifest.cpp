// SPDX-License-Identifier: BSD-3-Clause
#include "fuzz_document.h"
#include "plugin/catalog.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace toposcope;
  return fuzz::read_document(data, size, [](const std::string& text) {
    const std::filesystem::path file = fuzz::file_of("circle.plugin.json", text);
    fuzz::file_of("circle.so", "");
    const PluginCatalog catalog({{file.parent_path(), true}});
    const PluginManifest manifest = read_manifest(file);
    manifest_to_json(manifest);
    missing_programs(manifest);
  });
}
