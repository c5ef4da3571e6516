// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/errors.h"
#include "base/nearest_name.h"
#include "base/text_file.h"
#include "commands.h"
#include "io/mesh_io.h"
#include "options.h"
#include "output.h"
#include "plugin/option_check.h"
#include "plugin/plugin_page.h"
#include "session.h"

namespace toposcope::cli {
namespace {

struct PluginsOptions {
  std::vector<fs::path> plugin_dirs;
  std::string id;
  fs::path page;  ///< the documentation page whose tables to renew
  bool json = false;
};

constexpr PluginKind kinds[] = {PluginKind::filters, PluginKind::worksets, PluginKind::shapes, PluginKind::relations,
                                PluginKind::labelers};

constexpr const char* dimensions[] = {"points", "lines", "surfaces", "volumes"};

void print_table(const char* title, const std::vector<OptionRow>& rows) {
  if (rows.empty()) return;
  say("\n{}:\n", title);
  for (const OptionRow& row : rows) {
    say("  {}  ({}", row.name, describe_constraint(row));
    say("{})\n      {}\n", row.default_value.empty() ? "; must be given" : "; default " + row.default_value,
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

int plugins_list(const PluginsOptions& options) {
  const PluginCatalog catalog = open_catalog(options.plugin_dirs, false);
  if (options.json) {
    nlohmann::ordered_json root = {
        {"schema", "toposcope.plugins/1"}, {"plugins", nlohmann::json::array()}, {"problems", nlohmann::json::array()}};
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
    say("{}\n", root.dump(1));
    return 0;
  }
  for (PluginKind kind : kinds) {
    say("{}\n", to_string(kind));
    for (const PluginManifest* plugin : catalog.all(kind))
      say("  {:<22}{:<8} {}{}\n", plugin->id, plugin->version, plugin->summary, availability(*plugin));
  }
  if (!catalog.problems().empty()) say("cannot be used\n");
  for (const PluginProblem& problem : catalog.problems()) say("  {}\n", problem.message);
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
    say("{}", manifest_to_json(plugin));
    return 0;
  }
  say("{} {} ({})\n{}\n", plugin.id, plugin.version, to_string(plugin.kind), plugin.summary);
  if (!plugin.citation.empty()) say("source: {}\n", plugin.citation);
  if (!plugin.unit.empty()) say("residual in: {}\n", plugin.unit);
  if (plugin.dimension >= 0) say("fits: {}\n", dimensions[static_cast<std::size_t>(plugin.dimension)]);
  if (!plugin.programs.empty()) say("runs: {}{}\n", fmt::join(plugin.programs, ", "), availability(plugin));
  if (!plugin.provides.empty()) say("\nprovides:\n");
  for (const ProvidedRow& row : plugin.provides) say("  {:<14}{}\n", row.name, row.meaning);
  print_table("options, set in the pipeline or by --set", plugin.options);
  print_table("arguments, given in the model", plugin.arguments);
  return 0;
}

}  // namespace

void add_plugins(CLI::App& app, int& code) {
  CLI::App& command = *app.add_subcommand("plugins", "list, describe, check or begin plugins");
  command.require_subcommand(1);
  CLI::App& list = *command.add_subcommand("list", "all plugins that can be found");
  CLI::App& describe = *command.add_subcommand("describe", "a plugin's options and what it provides");
  const auto options = std::make_shared<PluginsOptions>();
  describe.add_option("id", options->id, "the plugin's id")->required();
  describe.add_option("--page", options->page, "renew the tables of its documentation page")->type_name("FILE.md");
  for (CLI::App* each : {&list, &describe}) {
    each->add_flag("--json", options->json, "print JSON");
    add_plugin_dirs(*each, options->plugin_dirs);
  }
  list.callback([options, &code] { code = plugins_list(*options); });
  describe.callback([options, &code] { code = plugins_describe(*options); });
  add_plugins_check(command, code);
  add_plugins_new(command, code);
}

}  // namespace toposcope::cli
