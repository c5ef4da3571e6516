// SPDX-License-Identifier: BSD-3-Clause
#include <regex>

#include "base/errors.h"
#include "base/text_file.h"
#include "commands.h"
#include "io/mesh_io.h"
#include "model/read_model.h"
#include "options.h"
#include "output.h"
#include "resources.h"
#include "session.h"

namespace toposcope::cli {
namespace {

struct NewModelOptions {
  std::vector<fs::path> plugin_dirs;
  std::string name;
  std::string from = "bowl";
  fs::path out;  ///< empty: NAME.yaml
};

/// A template, or any shipped model or file.
fs::path template_file(const std::string& name) {
  const fs::path folder = find_resource_folder("models", "templates");
  std::error_code error;
  if (const fs::path file = folder / (name + ".yaml"); !folder.empty() && fs::is_regular_file(file, error)) return file;
  return find_resource("models", name);
}

/// The text with another name.
std::string renamed(const std::string& text, const std::string& name) {
  return std::regex_replace(text, std::regex("(^|\\n)name: *[^\\n]*"), "$1name: " + name,
                            std::regex_constants::format_first_only);
}

int model_new(const NewModelOptions& options) {
  const fs::path source = template_file(options.from);
  const fs::path file = options.out.empty() ? fs::path(options.name + ".yaml") : options.out;
  std::error_code error;
  if (fs::exists(file, error))
    throw UsageError(file.string() + ": is there already; remove it, or give another name or -o");
  const std::string text = renamed(read_text_file(source, "model"), options.name);
  const PluginCatalog catalog = open_catalog(options.plugin_dirs);
  model_from_text(text, file.string(), &catalog);  // the name too is checked
  write_file(file, text);
  say("{}: model '{}', begun from {}\n", file.string(), options.name, options.from);
  return 0;
}

}  // namespace

void add_model_new(CLI::App& model, int& code) {
  CLI::App& command = *model.add_subcommand("new", "begin a model from one that runs");
  const auto options = std::make_shared<NewModelOptions>();
  command.add_option("name", options->name, "of the model")->required();
  command.add_option("--from", options->from, "bowl (the smallest), cup, plate, ... or a file")->capture_default_str();
  command.add_option("-o,--out", options->out, "file to write; NAME.yaml when left out")->type_name("FILE");
  add_plugin_dirs(command, options->plugin_dirs);
  command.callback([options, &code] { code = model_new(*options); });
}

}  // namespace toposcope::cli
