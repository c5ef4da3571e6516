// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

#include "plugin/manifest.h"
#include "toposcope/plugin.h"

namespace toposcope {

/// Loads a plugin library for good (it is never unloaded: its code may still be referred to) and checks, before
/// anything else of it is called, that the file is whole, exports the plugin symbol, and was built for this ABI.
/// Loading the same file again is cheap.
/// \param id  for messages
/// \throw PluginError  names what is wrong, both values and the remedy
const PluginDescriptor& load_plugin_library(const std::filesystem::path& library, const std::string& id);

/// \throw PluginError  manifest and compiled descriptor differ; names every field that does
void check_agreement(const PluginManifest& manifest, const PluginDescriptor& descriptor);

/// Ending of plugin libraries on this system: ".so".
std::string library_suffix();

}  // namespace toposcope
