// SPDX-License-Identifier: BSD-3-Clause
// Build tool: toposcope_write_manifest KIND ID LIBRARY writes <ID>.plugin.json beside LIBRARY from its descriptor.

#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <string>

#include "base/errors.h"
#include "plugin/library.h"
#include "plugin/manifest.h"

namespace {

namespace fs = std::filesystem;

void check_equal(const std::string& id, const char* what, const std::string& compiled, const std::string& declared) {
  if (compiled != declared)
    throw toposcope::PluginError(id, std::string(what) + " is '" + compiled +
                                         "' in the source's TOPOSCOPE_PLUGIN and '" + declared +
                                         "' in toposcope_add_plugin; make them the same");
}

void write(const fs::path& file, const std::string& text) {
  const fs::path part = file.string() + ".part";
  std::ofstream stream(part, std::ios::binary);
  stream << text;
  stream.close();
  if (!stream) throw toposcope::UsageError("'" + part.string() + "' cannot be written; check space and permissions");
  fs::rename(part, file);
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc != 4) throw toposcope::UsageError("usage: toposcope_write_manifest KIND ID LIBRARY");
  const std::string kind = argv[1], id = argv[2];
  const fs::path library = argv[3];
  const auto manifest = toposcope::manifest_from_descriptor(toposcope::load_plugin_library(library, id));
  check_equal(id, "the kind", std::string(toposcope::to_string(manifest.kind)), kind);
  check_equal(id, "the id", manifest.id, id);
  if (library.filename() != id + toposcope::library_suffix())
    throw toposcope::PluginError(id, "its library is named '" + library.filename().string() + "'; it must be '" + id +
                                         toposcope::library_suffix() + "'");
  write(library.parent_path() / (id + std::string(toposcope::manifest_suffix)), toposcope::manifest_to_json(manifest));
  return 0;
} catch (const toposcope::Error& error) {
  std::fprintf(stderr, "toposcope_write_manifest: %s\n", error.what());
  return error.exit_code;
} catch (const std::exception& error) {
  std::fprintf(stderr, "toposcope_write_manifest: %s\n", error.what());
  return 1;
}
