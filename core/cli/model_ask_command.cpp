// SPDX-License-Identifier: BSD-3-Clause
#include "commands.h"
#include "model/ask.h"
#include "model/read_model.h"
#include "options.h"
#include "output.h"
#include "resources.h"
#include "session.h"

namespace toposcope::cli {
namespace {

struct AskOptions {
  std::vector<fs::path> plugin_dirs;
  std::string model, question;
  bool json = false;
};

int model_ask(const AskOptions& options) {
  const PluginCatalog catalog = open_catalog(options.plugin_dirs);
  const Model model = read_model(find_resource("models", options.model), &catalog);
  const AbstractAnswer answered = answer(read_query(options.question, model), model);
  say("{}", options.json ? to_json(answered, model) : to_text(answered, model));
  return 0;
}

}  // namespace

void add_model_ask(CLI::App& model, int& code) {
  CLI::App& command = *model.add_subcommand("ask", "what follows from a model's abstract part");
  const auto options = std::make_shared<AskOptions>();
  command.add_option("model", options->model, "name or file")->required();
  command.add_option("question", options->question, "such as \"what bounds the upper lobe?\"")->required();
  command.add_flag("--json", options->json, "print a JSON object");
  add_plugin_dirs(command, options->plugin_dirs);
  command.callback([options, &code] { code = model_ask(*options); });
}

}  // namespace toposcope::cli
