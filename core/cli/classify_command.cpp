// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include "base/errors.h"
#include "commands.h"
#include "model/read_model.h"
#include "resources.h"
#include "result/classification.h"
#include "session.h"

namespace toposcope::cli {

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
    fmt::print("{}", options.json ? to_json_line(classification) : to_text(classification));
    std::fflush(stdout);
  });
}

}  // namespace toposcope::cli
