// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include "commands.h"
#include "model/read_model.h"
#include "model/show_model.h"
#include "options.h"
#include "output.h"
#include "resources.h"
#include "session.h"

namespace toposcope::cli {
namespace {

struct ModelOptions {
  std::vector<fs::path> plugin_dirs;
  std::string model;
  std::string format = "text";  ///< show: text or dot
};

int model_check(const ModelOptions& options) {
  const PluginCatalog catalog = open_catalog(options.plugin_dirs);
  const fs::path file = find_resource("models", options.model);
  const Model model = read_model(file, &catalog);
  if (!model.pipeline.empty()) check_types(model, read_pipeline(pipeline_file(model), catalog), catalog);
  say("{}: model '{}' is sound: {} abstract objects, {} features, {} relationships, {} classes\n", file.string(),
      model.name, model.abstract.objects.size(), model.features.size(), model.relationships.size(),
      model.classes.size());
  return 0;
}

int model_show(const ModelOptions& options) {
  const PluginCatalog catalog = open_catalog(options.plugin_dirs);
  const Model model = read_model(find_resource("models", options.model), &catalog);
  say("{}", options.format == "dot" ? model_as_dot(model) : model_as_text(model));
  return 0;
}

}  // namespace

void add_model(CLI::App& app, int& code) {
  CLI::App& command = *app.add_subcommand("model", "begin, check, show, ask, probe or teach a model");
  command.require_subcommand(1);
  CLI::App& check = *command.add_subcommand("check", "report all errors of a model file");
  CLI::App& show = *command.add_subcommand("show", "print a model's networks, features and relationships");
  const auto options = std::make_shared<ModelOptions>();
  for (CLI::App* each : {&check, &show}) {
    each->add_option("model", options->model, "name or file")->required();
    add_plugin_dirs(*each, options->plugin_dirs);
  }
  show.add_option("--format", options->format, "text or dot (Graphviz)")
      ->check(CLI::IsMember({"text", "dot"}))
      ->capture_default_str();
  add_model_ask(command, code);
  add_model_new(command, code);
  add_model_learn(command, code);
  add_model_probe(command, code);
  check.callback([options, &code] { code = model_check(*options); });
  show.callback([options, &code] { code = model_show(*options); });
}

}  // namespace toposcope::cli
