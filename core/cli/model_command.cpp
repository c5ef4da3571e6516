// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include "commands.h"
#include "model/read_model.h"
#include "model/show_model.h"
#include "resources.h"
#include "session.h"

namespace toposcope::cli {

int model_check(const ModelOptions& options) {
  const PluginCatalog catalog = open_catalog(options.plugin_dirs);
  const fs::path file = find_resource("models", options.model);
  const Model model = read_model(file, &catalog);
  fmt::print("{}: model '{}' is sound: {} abstract objects, {} features, {} relationships, {} classes\n", file.string(),
             model.name, model.abstract.objects.size(), model.features.size(), model.relationships.size(),
             model.classes.size());
  return 0;
}

int model_show(const ModelOptions& options) {
  const PluginCatalog catalog = open_catalog(options.plugin_dirs);
  const Model model = read_model(find_resource("models", options.model), &catalog);
  fmt::print("{}", options.format == "dot" ? model_as_dot(model) : model_as_text(model));
  return 0;
}

}  // namespace toposcope::cli
