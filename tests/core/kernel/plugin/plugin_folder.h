// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <fstream>
#include <string>

#include "plugin/library.h"
#include "plugin/manifest.h"

namespace toposcope::test {

/// A folder of its own for one test, removed at its end.
class PluginFolderFixture {
 public:
  PluginFolderFixture() {
    std::string name = (std::filesystem::temp_directory_path() / "toposcope-test-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder: " + name);
    path = name;
  }
  PluginFolderFixture(const PluginFolderFixture&) = delete;
  PluginFolderFixture& operator=(const PluginFolderFixture&) = delete;
  ~PluginFolderFixture() { std::filesystem::remove_all(path); }

  /// Where the build leaves the test plugin of that name.
  static std::filesystem::path built(const std::string& name) {
    return std::filesystem::path(TOPOSCOPE_BUILD_DIR) / "bad_plugins" / name / (name + library_suffix());
  }
  /// The good plugin's manifest under another id.
  static PluginManifest manifest(const std::string& id) {
    PluginManifest manifest = manifest_from_descriptor(load_plugin_library(built("good"), "good"));
    manifest.id = id;
    return manifest;
  }

  void write(const std::string& name, const std::string& text) const {
    std::filesystem::create_directories((path / name).parent_path());
    std::ofstream(path / name, std::ios::binary) << text;
  }
  void write_manifest(const std::string& id) const { write(id + ".plugin.json", manifest_to_json(manifest(id))); }
  /// A test plugin with a manifest that claims it is sound.
  void add(const std::string& name) const {
    std::filesystem::copy_file(built(name), path / (name + library_suffix()));
    write_manifest(name);
  }

  std::filesystem::path path;
};

}  // namespace toposcope::test
