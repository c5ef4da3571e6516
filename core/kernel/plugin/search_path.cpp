// SPDX-License-Identifier: BSD-3-Clause
#include <boost/dll/runtime_symbol_info.hpp>
#include <cstdlib>
#include <sstream>

#include "plugin/catalog.h"

namespace toposcope {
namespace fs = std::filesystem;
namespace {

/// "." and its like, by name: a relative folder that the user named is taken from where he stands, but not that itself.
bool is_working_directory(const fs::path& folder) {
  const fs::path normal = (folder / "").lexically_normal();
  return normal == "." || normal == "./" || normal.empty();
}

}  // namespace

std::vector<PluginFolder> plugin_search_path(const std::vector<fs::path>& plugin_dirs) {
  const auto beside = fs::path(boost::dll::program_location().string()).parent_path();
  const auto prefix = beside.parent_path();
  std::vector<PluginFolder> folders = {{prefix / "plugins", false}, {prefix / "lib" / "toposcope" / "plugins", false}};
  if (const char* variable = std::getenv("TOPOSCOPE_PLUGIN_PATH")) {
    std::istringstream stream(variable);
    // An empty entry would mean the working directory to a shell; here it means nothing.
    for (std::string entry; std::getline(stream, entry, ':');)
      if (!entry.empty())
        folders.push_back({is_working_directory(entry) ? fs::path(entry) : fs::absolute(entry), true});
  }
  // The user typed these just now and means them from where he stands.
  for (const auto& folder : plugin_dirs) folders.push_back({fs::absolute(folder), true});
  return folders;
}

}  // namespace toposcope
