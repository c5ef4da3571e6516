// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include "base/errors.h"
#include "commands.h"
#include "model/read_model.h"
#include "options.h"
#include "output.h"
#include "resources.h"
#include "result/classification.h"
#include "session.h"

namespace toposcope::cli {
namespace {

struct ClassifyOptions : CommonOptions {
  std::vector<fs::path> meshes;
  std::string models;
};

int classify(const ClassifyOptions& options) {
  PipelineSession session(options);
  std::vector<Model> models;
  std::vector<Stations> stations;
  for (const fs::path& file : find_models(options.models)) {
    models.push_back(read_model(file, &session.host().catalog()));
    for (std::size_t m = 0; m + 1 < models.size(); ++m)
      if (models[m].name == models.back().name)
        throw UsageError(models[m].file + " and " + models.back().file + " are both named '" + models.back().name +
                         "': their classes could not be told apart; name one of them");
    stations.push_back(session.stations(models.back()));
  }
  return for_each_mesh(options.meshes, session, [&](const fs::path& path) {
    const Mesh mesh = session.read(path).mesh;
    std::vector<Result> results;
    for (std::size_t m = 0; m < models.size(); ++m) {
      const Analysis analysis = analyze(mesh, models[m], stations[m], {}, session.context());
      results.push_back(explain(analysis, models[m], path.string(), stations[m], session.context()));
    }
    const Classification classification = toposcope::classify(results);
    session.status("");
    say("{}", options.json ? to_json_line(classification) : to_text(classification));
    flush_output();
  });
}

}  // namespace

void add_classify(CLI::App& app, int& code) {
  CLI::App& command = *app.add_subcommand("classify", "which class of objects explains a mesh best");
  const auto options = std::make_shared<ClassifyOptions>();
  add_meshes(command, options->meshes)->required();
  command.add_option("--models", options->models, "a folder of models, or names separated by commas")
      ->required()
      ->type_name("DIR|LIST");
  command.add_flag("--json", options->json, "print a JSON object per mesh");
  add_common(command, *options);
  command.callback([options, &code] { code = classify(*options); });
}

}  // namespace toposcope::cli
