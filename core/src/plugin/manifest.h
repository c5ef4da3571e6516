// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "toposcope/options.h"

namespace toposcope {

enum class PluginKind { worksets, shapes, relations, labelers, filters };
std::string_view to_string(PluginKind kind);
std::optional<PluginKind> plugin_kind(std::string_view name);

/// OptionSpec as read from a manifest.
struct OptionRow {
  std::string name;
  OptionType type = OptionType::real;
  std::string unit, default_value, minimum, maximum, meaning;
};

struct ProvidedRow {
  std::string name;  ///< '#' stands for 1, 2, 3, ...
  int dimension = 0;
  std::string meaning;
};

/// What `<id>.plugin.json` says of a plugin; written by the build from the compiled descriptor.
struct PluginManifest {
  PluginKind kind = PluginKind::shapes;
  std::string id, version, summary, citation, unit, fingerprint;
  std::uint32_t abi_major = 0, abi_minor = 0, min_arity = 0, max_arity = 0;
  std::vector<OptionRow> options, arguments;
  std::vector<ProvidedRow> provides;
  std::filesystem::path file;     ///< the manifest
  std::filesystem::path library;  ///< beside it

  /// The provided name that matches, '#' standing for a number: `length_3` matches `length_#`.
  const ProvidedRow* find_provided(std::string_view name) const;
};

}  // namespace toposcope
