// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/errors.h"
#include "base/nearest_name.h"
#include "base/text_file.h"
#include "commands.h"
#include "io/mesh_io.h"
#include "plugin/option_check.h"
#include "plugin/plugin_page.h"
#include "session.h"

namespace toposcope::cli {
namespace {

constexpr PluginKind kinds[] = {PluginKind::filters, PluginKind::worksets, PluginKind::shapes, PluginKind::relations,
                                PluginKind::labelers};

constexpr const char* dimensions[] = {"points", "lines", "surfaces", "volumes"};

void print_table(const char* title, const std::vector<OptionRow>& rows) {
  if (rows.empty()) return;
  fmt::print("\n{}:\n", title);
  for (const OptionRow& row : rows) {
    fmt::print("  {}  ({}", row.name, describe_constraint(row));
    fmt::print("{})\n      {}\n", row.default_value.empty() ? "; must be given" : "; default " + row.default_value,
               row.meaning);
  }
}

/// "; not available: needs the program ..."; empty where nothing is missing.
std::string availability(const PluginManifest& plugin) {
  const std::string missing = missing_programs(plugin);
  return missing.empty() ? "" : "; not available: " + missing;
}

const PluginManifest& find(const PluginCatalog& catalog, const std::string& id) {
  std::vector<std::string> known;
  for (PluginKind kind : kinds) {
    if (const PluginManifest* manifest = catalog.find(kind, id)) return *manifest;
    for (const PluginManifest* manifest : catalog.all(kind)) known.push_back(manifest->id);
  }
  for (const PluginProblem& problem : catalog.problems())
    if (problem.id == id) throw PluginError(id, problem.message);
  const std::string near = nearest_name(id, known);
  throw UsageError("no plugin '" + id + "'" + (near.empty() ? "" : "; did you mean '" + near + "'?") +
                   "; toposcope plugins list shows all");
}

}  // namespace

int plugins_list(const PluginsOptions& options) {
  const PluginCatalog catalog = open_catalog(options.plugin_dirs, false);
  if (options.json) {
    nlohmann::ordered_json root = {{"plugins", nlohmann::json::array()}, {"problems", nlohmann::json::array()}};
    for (PluginKind kind : kinds)
      for (const PluginManifest* plugin : catalog.all(kind))
        root["plugins"].push_back({{"kind", to_string(kind)},
                                   {"id", plugin->id},
                                   {"version", plugin->version},
                                   {"summary", plugin->summary},
                                   {"library", plugin->library.string()},
                                   {"not_available", missing_programs(*plugin)}});
    for (const PluginProblem& problem : catalog.problems())
      root["problems"].push_back({{"file", problem.file.string()}, {"message", problem.message}});
    fmt::print("{}\n", root.dump(1));
    return 0;
  }
  for (PluginKind kind : kinds) {
    fmt::print("{}\n", to_string(kind));
    for (const PluginManifest* plugin : catalog.all(kind))
      fmt::print("  {:<22}{:<8} {}{}\n", plugin->id, plugin->version, plugin->summary, availability(*plugin));
  }
  if (!catalog.problems().empty()) fmt::print("cannot be used\n");
  for (const PluginProblem& problem : catalog.problems()) fmt::print("  {}\n", problem.message);
  return 0;
}

int plugins_describe(const PluginsOptions& options) {
  const PluginCatalog catalog = open_catalog(options.plugin_dirs, false);
  const PluginManifest& plugin = find(catalog, options.id);
  if (!options.page.empty()) {
    const std::string page = read_text_file(options.page, "page");
    try {
      if (const std::string renewed = with_tables(page, plugin); renewed != page) write_file(options.page, renewed);
    } catch (const UsageError& error) {
      throw UsageError(options.page.string() + ": " + error.what());
    }
    return 0;
  }
  if (options.json) {
    fmt::print("{}", manifest_to_json(plugin));
    return 0;
  }
  fmt::print("{} {} ({})\n{}\n", plugin.id, plugin.version, to_string(plugin.kind), plugin.summary);
  if (!plugin.citation.empty()) fmt::print("source: {}\n", plugin.citation);
  if (!plugin.unit.empty()) fmt::print("residual in: {}\n", plugin.unit);
  if (plugin.dimension >= 0) fmt::print("fits: {}\n", dimensions[static_cast<std::size_t>(plugin.dimension)]);
  if (!plugin.programs.empty()) fmt::print("runs: {}{}\n", fmt::join(plugin.programs, ", "), availability(plugin));
  if (!plugin.provides.empty()) fmt::print("\nprovides:\n");
  for (const ProvidedRow& row : plugin.provides) fmt::print("  {:<14}{}\n", row.name, row.meaning);
  print_table("options, set in the pipeline or by --set", plugin.options);
  print_table("arguments, given in the model", plugin.arguments);
  return 0;
}

}  // namespace toposcope::cli
