// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>

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

/// Models that one pipeline serves: a mesh is filtered and classified once for all of them.
struct ModelsOfPipeline {
  struct Member {
    const Model* model;
    std::size_t place;  ///< among all models
    Stations stations;
  };
  const PipelineManifest* pipeline;
  std::vector<std::string> types;  ///< of working sets that some model asks for
  std::vector<Member> members;
};

std::vector<ModelsOfPipeline> by_pipeline(const std::vector<Model>& models, PipelineSession& session) {
  std::vector<ModelsOfPipeline> all;
  for (std::size_t m = 0; m < models.size(); ++m) {
    const PipelineManifest* pipeline = &session.pipeline(models[m]);
    auto of = std::find_if(all.begin(), all.end(), [&](const auto& each) { return each.pipeline == pipeline; });
    if (of == all.end()) of = all.insert(all.end(), {pipeline, {}, {}});
    add_asked_types(models[m], of->types);
    of->members.push_back({&models[m], m, session.stations(models[m])});
  }
  return all;
}

/// \param results  of all models; those of the pipeline are filled in
void explain_by(const ModelsOfPipeline& of, const Mesh& mesh, const fs::path& path, Context& context,
                std::vector<Result>& results) {
  ClassifiedMesh classified = toposcope::classify(mesh, of.members.front().stations, of.types, context);
  context.log(LogLevel::debug, fmt::format("{}: pipeline '{}': {} working sets for {} models", path.string(),
                                           of.pipeline->name, classified.sets.size(), of.members.size()));
  for (const ModelsOfPipeline::Member& member : of.members) {
    const Timings timings = classified.timings;
    Analysis analysis = analyze(std::move(classified), *member.model, member.stations, {}, context);
    results[member.place] = explain(analysis, *member.model, path.string(), member.stations, context);
    classified = {std::move(analysis.mesh), std::move(analysis.sets), timings};
  }
}

int classify(const ClassifyOptions& options) {
  PipelineSession session(options);
  std::vector<Model> models;
  std::error_code ignored;
  for (const fs::path& file : find_models(options.models)) {
    models.push_back(read_model(file, &session.host().catalog()));
    if (models.back().features.empty() && fs::is_directory(options.models, ignored)) {  // of a list it is an error
      session.context().log(LogLevel::warning, file.string() + ": has no features to look for; it is left out");
      models.pop_back();
      continue;
    }
    for (std::size_t m = 0; m + 1 < models.size(); ++m)
      if (models[m].name == models.back().name)
        throw UsageError(models[m].file + " and " + models.back().file + " are both named '" + models.back().name +
                         "': their classes could not be told apart; name one of them");
  }
  const std::vector<ModelsOfPipeline> pipelines = by_pipeline(models, session);
  return for_each_mesh(options.meshes, session, [&](const fs::path& path) {
    const Mesh mesh = session.read(path).mesh;
    std::vector<Result> results(models.size());
    for (const ModelsOfPipeline& pipeline : pipelines) explain_by(pipeline, mesh, path, session.context(), results);
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
