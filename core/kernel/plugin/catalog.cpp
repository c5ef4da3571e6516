// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/catalog.h"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>

#include "base/errors.h"
#include "base/nearest_name.h"
#include "plugin/library.h"

namespace toposcope {
namespace fs = std::filesystem;

PluginCatalog::PluginCatalog(const std::vector<PluginFolder>& folders) {
  for (const auto& [path, required] : folders) {
    std::error_code ignored;
    if (!path.is_absolute()) {
      problems_.push_back(
          {path,
           fmt::format("plugin folder '{}' is relative, and plugins are never searched from the working "
                       "directory; give an absolute folder",
                       path.string()),
           ""});
    } else if (fs::is_directory(path, ignored)) {
      for (const fs::path& top : {path, path / "plugins"}) {
        scan(top);
        for (const PluginKind kind : plugin_kinds) scan(top / to_string(kind));
      }
    } else if (required) {
      problems_.push_back(
          {path, fmt::format("plugin folder '{}' does not exist; correct it or leave it out", path.string()), ""});
    }
  }
  refuse_duplicates();
  std::sort(problems_.begin(), problems_.end(), [](const auto& a, const auto& b) { return a.file < b.file; });
}

void PluginCatalog::scan(const fs::path& folder) {
  std::error_code error;
  if (!fs::is_directory(folder, error)) return;
  // A folder reached on two ways (a link, a folder and its parent) holds no duplicates.
  const fs::path real = fs::canonical(folder, error);
  if (error || std::find(scanned_.begin(), scanned_.end(), real) != scanned_.end()) return;
  scanned_.push_back(real);
  std::vector<fs::path> manifests;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error))
    if (entry->path().filename().string().ends_with(manifest_suffix)) manifests.push_back(entry->path());
  if (error)
    problems_.push_back(
        {folder, fmt::format("plugin folder '{}' cannot be read: {}", folder.string(), error.message()), ""});
  std::sort(manifests.begin(), manifests.end());
  for (const fs::path& manifest : manifests) read(manifest);
}

void PluginCatalog::read(const fs::path& manifest) {
  const std::string name = manifest.filename().string();
  const std::string id = name.substr(0, name.size() - manifest_suffix.size());
  try {
    PluginManifest plugin = read_manifest(manifest);
    std::error_code ignored;
    if (fs::is_regular_file(plugin.library, ignored)) {
      plugins_.push_back(std::move(plugin));
      return;
    }
    problems_.push_back(
        {manifest,
         fmt::format("{}: its library '{}' is not beside it; build the plugin again or remove the manifest",
                     manifest.string(), plugin.library.filename().string()),
         id});
  } catch (const std::exception& error) {
    problems_.push_back({manifest, error.what(), id});
  }
}

void PluginCatalog::refuse_duplicates() {
  std::stable_sort(plugins_.begin(), plugins_.end(), [](const auto& a, const auto& b) { return a.id < b.id; });
  std::vector<PluginManifest> unique;
  for (auto first = plugins_.begin(); first != plugins_.end();) {
    const auto last = std::find_if(first, plugins_.end(), [&](const auto& plugin) { return plugin.id != first->id; });
    if (last - first == 1) unique.push_back(std::move(*first));
    for (auto duplicate = first; last - first > 1 && duplicate != last; ++duplicate) {
      const auto& other = duplicate == first ? *std::next(first) : *first;
      problems_.push_back({duplicate->file,
                           fmt::format("{}: the id '{}' is also that of '{}'; neither is used until one of them is "
                                       "renamed or removed",
                                       duplicate->file.string(), duplicate->id, other.file.string()),
                           duplicate->id});
    }
    first = last;
  }
  plugins_ = std::move(unique);
}

const PluginManifest* PluginCatalog::find(PluginKind kind, std::string_view id) const {
  const auto plugin =
      std::lower_bound(plugins_.begin(), plugins_.end(), id, [](const auto& p, auto wanted) { return p.id < wanted; });
  return plugin != plugins_.end() && plugin->id == id && plugin->kind == kind ? &*plugin : nullptr;
}

std::vector<const PluginManifest*> PluginCatalog::all(PluginKind kind) const {
  std::vector<const PluginManifest*> found;
  for (const PluginManifest& plugin : plugins_)
    if (plugin.kind == kind) found.push_back(&plugin);
  return found;
}

const PluginManifest& PluginCatalog::require(PluginKind kind, std::string_view id, const std::string& where) const {
  if (const PluginManifest* plugin = find(kind, id)) return *plugin;
  for (const PluginProblem& problem : problems_)
    if (!id.empty() && problem.id == id) throw PluginError(problem.id, problem.message);
  const std::string what = fmt::format("{}{}there is no {} '{}'", where, where.empty() ? "" : ": ", singular(kind), id);
  for (const PluginManifest& plugin : plugins_)
    if (plugin.id == id) throw UsageError(fmt::format("{}; '{}' is a {}", what, id, singular(plugin.kind)));
  std::vector<std::string> names, folders;
  for (const PluginManifest* plugin : all(kind)) names.push_back(plugin->id);
  for (const fs::path& folder : scanned_) folders.push_back(folder.string());
  const std::string searched =
      fmt::format(" in the plugin folders ({}); name yours with --plugin-dir or TOPOSCOPE_PLUGIN_PATH",
                  folders.empty() ? "none exists" : fmt::format("{}", fmt::join(folders, ", ")));
  throw UsageError(fmt::format("{}; {}{}", what, name_remedy(id, names), names.empty() ? searched : ""));
}

}  // namespace toposcope
