// SPDX-License-Identifier: BSD-3-Clause
#include <boost/dll/runtime_symbol_info.hpp>
#include <cstdlib>
#include <sstream>

#include "plugin/catalog.h"

namespace toposcope {

std::vector<PluginFolder> plugin_search_path(const std::vector<std::filesystem::path>& plugin_dirs) {
  const auto beside = std::filesystem::path(boost::dll::program_location().string()).parent_path();
  const auto prefix = beside.parent_path();
  std::vector<PluginFolder> folders = {{prefix / "plugins", false}, {prefix / "lib" / "toposcope" / "plugins", false}};
  if (const char* variable = std::getenv("TOPOSCOPE_PLUGIN_PATH")) {
    std::istringstream stream(variable);
    // An empty entry would mean the working directory to a shell; here it means nothing.
    for (std::string entry; std::getline(stream, entry, ':');)
      if (!entry.empty()) folders.push_back({entry, true});
  }
  // The user typed these just now and means them from where he stands.
  for (const auto& folder : plugin_dirs) folders.push_back({std::filesystem::absolute(folder), true});
  return folders;
}

}  // namespace toposcope
