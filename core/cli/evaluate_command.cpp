// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include "base/text_file.h"
#include "commands.h"
#include "evaluation/evaluation.h"
#include "io/mesh_io.h"
#include "model/read_model.h"
#include "output_folder.h"
#include "resources.h"
#include "session.h"

namespace toposcope::cli {
namespace {

std::string title(const Evaluation& evaluation) {
  return evaluation.summary.empty() ? evaluation.dataset : evaluation.summary;
}

}  // namespace

int evaluate(const EvaluateOptions& options) {
  PipelineSession session(options);
  std::vector<Dataset> datasets;
  for (const fs::path& file : options.datasets) datasets.push_back(read_dataset(file));
  for (Dataset& dataset : datasets)
    if (!options.model.empty()) dataset.model = options.model;
  const std::string baseline =
      options.baseline.empty() ? "" : read_text_file(options.baseline, "--baseline: evaluation");
  if (!options.out.empty()) make_folder(options.out, "--out");

  std::vector<Evaluation> evaluations;
  std::string text, markdown;
  for (const Dataset& dataset : datasets) {
    for (const std::string& pattern : dataset.absent)
      fmt::print(stderr, "toposcope: warning: {}: no file matches {}; these meshes are left out\n", dataset.name,
                 pattern);
    session.status(dataset.name);
    const Model model = read_model(find_resource("models", dataset.model), &session.host().catalog());
    const Stations stations = session.stations(model);
    Evaluation evaluation = toposcope::evaluate(dataset, model, stations, session.host(), session.context());
    evaluation.pipeline = options.pipeline;
    session.status("");
    std::vector<Table> all = tables(evaluation);
    if (!baseline.empty())
      for (Table& table : changes(evaluation, baseline, options.baseline.string())) all.push_back(std::move(table));
    const std::string part = fmt::format("{}\n{}\n{}", title(evaluation), headline(evaluation), to_text(all));
    if (!options.json && !options.csv && !options.markdown) fmt::print("{}\n", part);
    text += part + "\n";
    markdown += fmt::format("## {}\n\n{}.\n{}\n", title(evaluation), headline(evaluation), to_markdown(all));
    evaluations.push_back(std::move(evaluation));
    std::fflush(stdout);
  }
  if (options.json) fmt::print("{}", to_json(evaluations));
  if (options.csv) fmt::print("{}", to_csv(evaluations));
  if (options.markdown) fmt::print("{}", markdown);
  if (!options.out.empty()) {
    write_file(options.out / "evaluation.txt", text);
    write_file(options.out / "evaluation.md", markdown);
    write_file(options.out / "evaluation.json", to_json(evaluations));
    write_file(options.out / "evaluation.csv", to_csv(evaluations));
  }
  return 0;
}

}  // namespace toposcope::cli
