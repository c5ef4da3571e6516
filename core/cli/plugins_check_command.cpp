// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/errors.h"
#include "check_process.h"
#include "commands.h"
#include "interruption.h"
#include "options.h"
#include "output.h"
#include "plugin/catalog.h"
#include "plugin/library.h"

namespace toposcope::cli {
namespace {

struct CheckOptions {
  std::vector<fs::path> plugin_dirs;
  std::vector<fs::path> paths;
  bool json = false;
  bool valgrind = false;           ///< for errors of memory too
  std::vector<fs::path> children;  ///< libraries to examine in this process; for the program itself
  bool brief = false;
};

/// A plugin that was asked for, as far as its files tell.
struct Checked {
  std::string id, version, kind;
  fs::path library;
  std::vector<CheckVerdict> verdicts;

  bool passes() const {
    return std::none_of(verdicts.begin(), verdicts.end(),
                        [](const CheckVerdict& v) { return v.outcome == Outcome::failed; });
  }
};

Checked of_library(const fs::path& library) {
  Checked checked{library.stem().string(), "", "", library, {}};
  try {
    const PluginManifest manifest = read_manifest(fs::path(library).replace_extension() += manifest_suffix);
    checked.version = manifest.version;
    checked.kind = to_string(manifest.kind);
  } catch (const Error&) {
    // The kit says what is wrong with it.
  }
  return checked;
}

/// Everything that the paths name: a library, or a folder with manifests.
/// \param absent  receives what is not there
std::vector<Checked> collect(const CheckOptions& options, std::vector<std::string>& absent) {
  std::vector<Checked> all;
  std::vector<PluginFolder> folders;
  for (const fs::path& path : options.paths) {
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    if (!fs::exists(status))
      absent.push_back(path.string() + ": no such file or folder (" + error.message() + ")");
    else if (fs::is_directory(status))
      folders.push_back({fs::absolute(path), true});
    else
      all.push_back(of_library(path));
  }
  if (options.paths.empty()) folders = plugin_search_path(options.plugin_dirs);
  const PluginCatalog catalog(folders);
  for (const PluginProblem& problem : catalog.problems())
    all.push_back({problem.id.empty() ? problem.file.string() : problem.id,
                   "",
                   "",
                   problem.file,
                   {{"manifest", Outcome::failed, problem.message}}});
  for (const PluginKind kind : plugin_kinds)
    for (const PluginManifest* plugin : catalog.all(kind))
      all.push_back({plugin->id, plugin->version, std::string(to_string(kind)), plugin->library, {}});
  if (all.empty() && absent.empty())
    throw UsageError("no plugin found; give libraries, or folders that hold libraries and <id>.plugin.json files");
  return all;
}

const char* word(Outcome outcome) {
  return outcome == Outcome::passed ? "ok" : outcome == Outcome::failed ? "FAIL" : "skip";
}

void show(const Checked& plugin) {
  say("{}{}{}{}\n", plugin.id, plugin.version.empty() ? "" : " " + plugin.version,
      plugin.kind.empty() ? "" : " (" + plugin.kind + ")", ": " + plugin.library.string());
  for (const CheckVerdict& verdict : plugin.verdicts)
    say("  {:<5} {:<17} {}\n", word(verdict.outcome), verdict.check, verdict.detail);
  flush_output();
}

nlohmann::ordered_json report_of(const Checked& plugin) {
  nlohmann::ordered_json checks = nlohmann::json::array();
  for (const CheckVerdict& verdict : plugin.verdicts)
    checks.push_back({{"check", verdict.check}, {"outcome", word(verdict.outcome)}, {"detail", verdict.detail}});
  return {{"id", plugin.id},           {"version", plugin.version},
          {"kind", plugin.kind},       {"library", plugin.library.string()},
          {"passes", plugin.passes()}, {"checks", checks}};
}

/// Of the plugins that passed so far and ran.
void check_memory(std::vector<Checked>& plugins, const Context& context) {
  std::vector<Checked*> sound;
  std::vector<fs::path> libraries;
  for (Checked& plugin : plugins) {
    const bool ran = std::none_of(plugin.verdicts.begin(), plugin.verdicts.end(),
                                  [](const CheckVerdict& v) { return v.check == "run"; });  // it lacks a program
    if (!ran || !plugin.passes()) continue;
    sound.push_back(&plugin);
    libraries.push_back(fs::absolute(plugin.library));
  }
  const std::vector<CheckVerdict> verdicts = examine_memory(libraries, context);
  for (std::size_t i = 0; i < sound.size(); ++i) sound[i]->verdicts.push_back(verdicts[i]);
}

int plugins_check(const CheckOptions& options) {
  if (!options.children.empty()) return examine_here(options.children, options.brief);
  std::vector<std::string> absent;
  std::vector<Checked> plugins = collect(options, absent);
  RunContext context({.threads = 1});  // what a signal cancels
  const Interruption interruption(context);
  for (Checked& plugin : plugins) {
    if (plugin.verdicts.empty()) plugin.verdicts = examine_in_process(fs::absolute(plugin.library), context);
    if (!options.json && !options.valgrind) show(plugin);
  }
  if (options.valgrind) check_memory(plugins, context);
  const auto good = static_cast<std::size_t>(
      std::count_if(plugins.begin(), plugins.end(), [](const Checked& p) { return p.passes(); }));
  if (options.json) {
    nlohmann::ordered_json root = {{"schema", "toposcope.check/1"}, {"plugins", nlohmann::json::array()}};
    for (const Checked& plugin : plugins) root["plugins"].push_back(report_of(plugin));
    say("{}\n", root.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
  } else {
    for (std::size_t i = 0; options.valgrind && i < plugins.size(); ++i) show(plugins[i]);
    say("{} pass, {} fail\n", good, plugins.size() - good);
  }
  for (const std::string& each : absent) complain(each);
  return good < plugins.size() ? PluginError("", "").exit_code : absent.empty() ? 0 : UsageError("").exit_code;
}

}  // namespace

void add_plugins_check(CLI::App& plugins, int& code) {
  CLI::App& command = *plugins.add_subcommand("check", "hold plugins against what every plugin of its kind owes");
  const auto options = std::make_shared<CheckOptions>();
  command.add_option("path", options->paths, "libraries, folders of them or build folders; none: all that are found");
  command.add_flag("--valgrind", options->valgrind, "also under valgrind: leaks and accesses out of bounds");
  command.add_option("--child", options->children)->group("");
  command.add_flag("--brief", options->brief)->group("");
  command.add_flag("--json", options->json, "print JSON");
  add_plugin_dirs(command, options->plugin_dirs);
  command.callback([options, &code] { code = plugins_check(*options); });
}

}  // namespace toposcope::cli
