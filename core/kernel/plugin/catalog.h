// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "plugin/manifest.h"

namespace toposcope {

/// To scan for manifests: itself, its subfolder `plugins` (of a build folder), and worksets, shapes ... under both.
struct PluginFolder {
  std::filesystem::path path;
  bool required = false;  ///< the user named it: it is a problem when it is absent
};

/// The search path: beside the executable (<folder>/../plugins), the install prefix
/// (<folder>/../lib/toposcope/plugins), the folders in TOPOSCOPE_PLUGIN_PATH (separated by ':'), then those of
/// --plugin-dir. Never the working directory, unless --plugin-dir names it.
std::vector<PluginFolder> plugin_search_path(const std::vector<std::filesystem::path>& plugin_dirs = {});

/// Why a plugin is not in the catalog.
struct PluginProblem {
  std::filesystem::path file;
  std::string message;
  std::string id;  ///< as far as the file's name tells; may be empty
};

/// The plugins that can be found, by manifest alone: nothing is loaded. A bad manifest, a manifest without library or
/// an id that occurs twice becomes a problem and never takes others with it.
class PluginCatalog {
 public:
  explicit PluginCatalog(const std::vector<PluginFolder>& folders);

  /// Null when there is none. \see require
  const PluginManifest* find(PluginKind kind, std::string_view id) const;
  /// By id.
  std::vector<const PluginManifest*> all(PluginKind kind) const;
  /// By file.
  const std::vector<PluginProblem>& problems() const { return problems_; }

  /// \param where  for messages: "file:line:column", or empty
  /// \throw UsageError  unknown, with the nearest name; PluginError  found, but it has a problem
  const PluginManifest& require(PluginKind kind, std::string_view id, const std::string& where = "") const;

 private:
  void scan(const std::filesystem::path& folder);
  void read(const std::filesystem::path& manifest);
  void refuse_duplicates();

  std::vector<PluginManifest> plugins_;  ///< by id
  std::vector<PluginProblem> problems_;
  std::vector<std::filesystem::path> scanned_;
};

}  // namespace toposcope
