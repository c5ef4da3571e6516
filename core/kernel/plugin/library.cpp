// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/library.h"

#include <dlfcn.h>

#include <boost/dll/library_info.hpp>  // of Boost 1.74: needs <vector>, which library.h brings, and does not include it
#include <boost/dll/shared_library.hpp>
#include <sstream>
#include <vector>

#include "base/errors.h"

namespace toposcope {
namespace {

namespace dll = boost::dll;

/// A truncated library kills the process with SIGBUS inside dlopen: the section headers stand at the end of the file,
/// so reading them first tells.
void check_file(const std::filesystem::path& library, const std::string& id) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(library, ignored))
    throw PluginError(
        id, "its library '" + library.string() + "' does not exist; build the plugin again or remove its manifest");
  try {
    dll::library_info(library).symbols();
  } catch (const std::exception& error) {
    throw PluginError(id, "its library '" + library.string() + "' is truncated or not a library of this system (" +
                              error.what() + "); build or install the plugin again");
  }
}

dll::shared_library open(const std::filesystem::path& library, const std::string& id) {
  // rtld_now: an undefined symbol is found here and not in the middle of a run. Nodelete: never unloaded.
  const auto mode = dll::load_mode::rtld_now | static_cast<dll::load_mode::type>(RTLD_NODELETE);
  try {
    return dll::shared_library(library, mode);
  } catch (const std::exception& error) {
    throw PluginError(id, "its library cannot be loaded: " + std::string(error.what()) +
                              "; link the plugin with every library that it uses (-Wl,--no-undefined finds them)");
  }
}

std::vector<std::string> fingerprint_parts(const std::string& fingerprint) {
  std::vector<std::string> parts;
  std::istringstream stream(fingerprint);
  for (std::string part; std::getline(stream, part, ';');) parts.push_back(part);
  return parts;
}

/// Only the parts in which two fingerprints differ: "build=debug against build=release".
std::string fingerprint_difference(const std::string& plugin, const std::string& program) {
  const auto theirs = fingerprint_parts(plugin), ours = fingerprint_parts(program);
  if (theirs.size() != ours.size()) return "'" + plugin + "' against '" + program + "'";
  std::string difference;
  for (std::size_t i = 0; i < ours.size(); ++i)
    if (theirs[i] != ours[i]) difference += (difference.empty() ? "" : ", ") + theirs[i] + " against " + ours[i];
  return difference;
}

/// In the order in which fields may be trusted: each check makes the next one safe.
void check_abi(const PluginDescriptor& descriptor, const std::string& id) {
  const std::string rebuild = "; build the plugin again with the headers of this version";
  if (descriptor.major != abi_major)
    throw PluginError(id, "it was built for plugin ABI " + std::to_string(descriptor.major) + "." +
                              std::to_string(descriptor.minor) + ", this program has ABI " + std::to_string(abi_major) +
                              "." + std::to_string(abi_minor) + rebuild);
  if (descriptor.minor > abi_minor)
    throw PluginError(id, "it was built for the newer plugin ABI " + std::to_string(descriptor.major) + "." +
                              std::to_string(descriptor.minor) + ", this program has ABI " + std::to_string(abi_major) +
                              "." + std::to_string(abi_minor) + "; use a newer program" + rebuild);
  if (descriptor.struct_size < sizeof(PluginDescriptor))
    throw PluginError(id, "its descriptor has " + std::to_string(descriptor.struct_size) + " bytes, ABI " +
                              std::to_string(abi_major) + "." + std::to_string(abi_minor) + " needs " +
                              std::to_string(sizeof(PluginDescriptor)) + rebuild);
  if (descriptor.fingerprint == nullptr)
    throw PluginError(id, "its descriptor has no ABI fingerprint; make it with TOPOSCOPE_PLUGIN");
  if (std::string(abi_fingerprint) != descriptor.fingerprint)
    throw PluginError(id, "it was compiled differently from this program (" +
                              fingerprint_difference(descriptor.fingerprint, abi_fingerprint) +
                              "); build the plugin again with the compiler and build type of this program");
}

}  // namespace

std::string library_suffix() {
  return dll::shared_library::suffix().string();
}

const PluginDescriptor& load_plugin_library(const std::filesystem::path& library, const std::string& id) {
  check_file(library, id);
  const dll::shared_library loaded = open(std::filesystem::absolute(library), id);
  if (!loaded.has(TOPOSCOPE_PLUGIN_SYMBOL))
    throw PluginError(id, "its library '" + library.string() +
                              "' does not export the symbol '" TOPOSCOPE_PLUGIN_SYMBOL
                              "'; end the plugin's source with TOPOSCOPE_PLUGIN(...)");
  const PluginDescriptor* descriptor = loaded.get<const PluginDescriptor*()>(TOPOSCOPE_PLUGIN_SYMBOL)();
  if (descriptor == nullptr)
    throw PluginError(id, "'" TOPOSCOPE_PLUGIN_SYMBOL "' returned no descriptor; make it with TOPOSCOPE_PLUGIN");
  check_abi(*descriptor, id);
  return *descriptor;
}

void check_agreement(const PluginManifest& manifest, const PluginDescriptor& descriptor) {
  const auto fields = differences(manifest, manifest_from_descriptor(descriptor));
  if (fields.empty()) return;
  std::string message = "manifest '" + manifest.file.string() + "' and library do not agree";
  for (const std::string& field : fields) message += "; " + field;
  throw PluginError(manifest.id, message + ". Build the plugin again: the build writes the manifest from the library");
}

}  // namespace toposcope
