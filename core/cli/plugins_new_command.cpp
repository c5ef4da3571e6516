// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>

#include "base/errors.h"
#include "base/nearest_name.h"
#include "base/text_file.h"
#include "commands.h"
#include "io/mesh_io.h"
#include "options.h"
#include "output.h"
#include "plugin/catalog.h"
#include "plugin/plugin_id.h"
#include "resources.h"
#include "session.h"

namespace toposcope::cli {
namespace {

struct NewOptions {
  std::vector<fs::path> plugin_dirs;
  std::string kind, id;
};

/// A kind as its folder is called, or one of it: "shapes", "shape".
PluginKind kind_of(const std::string& name) {
  std::vector<std::string> names;
  for (const PluginKind kind : plugin_kinds) {
    const std::string many(to_string(kind)), one = many.substr(0, many.size() - 1);
    if (name == many || name == one) return kind;
    names.push_back(one);
  }
  throw UsageError("there is no kind of plugin '" + name + "'; " + name_remedy(name, names));
}

void refuse_id(const std::string& id, const PluginCatalog& catalog) {
  if (!is_plugin_id(id))
    throw UsageError("'" + id + "' cannot name a plugin: a name is lower-case words of letters and digits joined by " +
                     "'-', such as my-ellipse");
  for (const PluginKind kind : plugin_kinds)
    if (const PluginManifest* taken = catalog.find(kind, id))
      throw UsageError("the name '" + id + "' is taken by " + taken->library.string() +
                       ", and of two plugins of one name neither is used; choose another");
}

std::string replaced(std::string text, const std::string& mark, const std::string& by) {
  for (std::size_t at = text.find(mark); at != text.npos; at = text.find(mark, at + by.size()))
    text.replace(at, mark.size(), by);
  return text;
}

int plugins_new(const NewOptions& options) {
  const PluginKind kind = kind_of(options.kind);
  const std::string& id = options.id;
  refuse_id(id, open_catalog(options.plugin_dirs, false));
  const fs::path folder = id;
  if (fs::exists(fs::symlink_status(folder)))
    throw UsageError("'" + id + "' exists already in this folder; choose another name or remove it");
  const fs::path templates = find_resource_folder("templates", to_string(kind));
  if (templates.empty())
    throw UsageError("the templates of plugins are not installed; install the package libtoposcope-dev");

  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(templates)) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  if (std::error_code error; !fs::create_directory(folder, error))
    throw UsageError("the folder '" + id + "' cannot be made (" + error.message() + ")");
  for (const fs::path& file : files) {
    const std::string name = replaced(file.filename().string(), "template", id);
    const std::string text = read_text_file(file, "template");
    write_file(folder / name, replaced(replaced(text, "@ID@", id), "@VERSION@", TOPOSCOPE_VERSION));
    say("  {}/{}\n", id, name);
  }
  say("\n  cd {0}\n  cmake -B build && cmake --build build     build it\n"
      "  ctest --test-dir build                    its test, and the conformance check\n"
      "  toposcope plugins check build             the check alone, line by line\n"
      "  TOPOSCOPE_PLUGIN_PATH=$PWD/build toposcope plugins describe {0}\n",
      id);
  return 0;
}

}  // namespace

void add_plugins_new(CLI::App& plugins, int& code) {
  CLI::App& command = *plugins.add_subcommand("new", "write a plugin that works, to be changed into yours");
  const auto options = std::make_shared<NewOptions>();
  command.add_option("kind", options->kind, "workset, shape, relation, labeler or filter")->required();
  command.add_option("name", options->id, "the plugin's id and folder: lower-case words joined by '-'")->required();
  add_plugin_dirs(command, options->plugin_dirs);
  command.callback([options, &code] { code = plugins_new(*options); });
}

}  // namespace toposcope::cli
