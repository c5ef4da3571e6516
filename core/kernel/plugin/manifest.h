// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "toposcope/options.h"

namespace toposcope {

struct PluginDescriptor;

enum class PluginKind { worksets, shapes, relations, labelers, filters };
inline constexpr std::array plugin_kinds = {PluginKind::worksets, PluginKind::shapes, PluginKind::relations,
                                            PluginKind::labelers, PluginKind::filters};
/// As in folders and manifests: "shapes".
std::string_view to_string(PluginKind kind);
/// In a sentence: "shape".
std::string_view singular(PluginKind kind);
std::optional<PluginKind> plugin_kind(std::string_view name);

/// OptionSpec as read from a manifest.
struct OptionRow {
  std::string name;
  OptionType type = OptionType::real;
  std::string unit, default_value, minimum, maximum, meaning;
  std::string choices = {};  ///< of a text, separated by '|'
  std::string not_above = {};
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
  bool ordered = false;  ///< relations: it matters which feature comes first
  int dimension = -1;    ///< shapes: 0 point, 1 line, 2 surface, 3 volume; else -1
  std::vector<OptionRow> options, arguments;
  std::vector<ProvidedRow> provides;
  std::vector<std::string> programs;  ///< that must be on the PATH for the plugin to run
  std::filesystem::path file;         ///< the manifest
  std::filesystem::path library;      ///< beside it

  /// The provided name that matches, '#' standing for a number: `length_3` matches `length_#`.
  const ProvidedRow* find_provided(std::string_view name) const;
};

/// The manifest of a compiled descriptor whose ABI has been checked; `file` and `library` are left empty.
/// \throw PluginError  the descriptor is incomplete or contradicts itself
PluginManifest manifest_from_descriptor(const PluginDescriptor& descriptor);

/// Checks what types cannot say: form of id and version, known names, sound option tables.
/// \throw UsageError  names the field
void check_manifest(const PluginManifest& manifest);

/// Fields in which the two differ, each as "version: '1.0.0' in the manifest, '1.1.0' in the library"; `file` and
/// `library` are not compared.
std::vector<std::string> differences(const PluginManifest& manifest, const PluginManifest& library);

/// JSON text (schemas/plugin.schema.json) with a newline at its end.
std::string manifest_to_json(const PluginManifest& manifest);

/// Reads `<id>.plugin.json`; the library is the file `<id>.so` beside it (it need not exist).
/// \throw UsageError  names file and field
PluginManifest read_manifest(const std::filesystem::path& file);

/// "needs the program 'toulbar2' (apt-get install toulbar2)"; empty where all that it needs are on the PATH.
std::string missing_programs(const PluginManifest& manifest);

inline constexpr std::string_view manifest_suffix = ".plugin.json";

}  // namespace toposcope
