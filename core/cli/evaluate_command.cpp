// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <optional>
#include <set>

#include "base/errors.h"
#include "base/file_name.h"
#include "base/text_file.h"
#include "commands.h"
#include "evaluation/evaluation.h"
#include "index/index_document.h"
#include "io/mesh_io.h"
#include "model/read_model.h"
#include "options.h"
#include "output.h"
#include "output_folder.h"
#include "picture/stages.h"
#include "report_files.h"
#include "resources.h"
#include "session.h"

namespace toposcope::cli {
namespace {

struct EvaluateOptions : CommonOptions {
  std::vector<fs::path> datasets;
  std::string model;  ///< empty: the data set's
  fs::path out, baseline;
  bool reports = false;  ///< one for each mesh
  bool csv = false, markdown = false;
};

std::string title(const Evaluation& evaluation) {
  return evaluation.summary.empty() ? evaluation.dataset : evaluation.summary;
}

/// A folder for each mesh, also where several have one name.
std::vector<fs::path> folders_of(const Dataset& dataset) {
  std::vector<fs::path> folders;
  std::set<std::string> taken;
  for (const DatasetMesh& mesh : dataset.meshes) {
    const std::string name = file_name(mesh.name);
    std::string own = name;
    for (int number = 2; !taken.insert(own).second; ++number) own = name + "-" + std::to_string(number);
    folders.push_back(fs::path(file_name(dataset.name)) / own);
  }
  return folders;
}

/// What was not evaluated, with the reason; empty: nothing.
std::string not_evaluated(const Evaluation& evaluation) {
  std::vector<std::string> names;
  for (const MeshEvaluation& mesh : evaluation.meshes)
    if (!mesh.error.empty()) names.push_back(mesh.name + " (" + mesh.error + ")");
  if (names.empty()) return "";
  return evaluation.dataset + ": " + not_done(evaluation.meshes.size(), "meshes", names) +
         "; their features count as missed";
}

/// Pictures and reports of the meshes of one data set.
class Gallery {
 public:
  /// \param page  null: no reports
  Gallery(const Dataset& dataset, const Model& model, const fs::path& out, const Page* page)
      : model_(model), out_(out), page_(page), folders_(folders_of(dataset)), cards_(dataset.meshes.size()) {}

  void add(const MeshAtHand& at) {
    MeshCard& card = cards_[at.number];
    const Truth* truth = at.known.truth.features.empty() ? nullptr : &at.known.truth;
    card.thumbnail = thumbnail_of(make_scene(at.analysis, model_, at.result, truth, found_alone), at.context);
    if (!page_) return;
    const fs::path& folder = folders_[at.number];
    make_folder(out_ / folder, "--out");
    const std::string document = to_json(make_scene(at.analysis, model_, at.result, truth), program_name());
    write_file(out_ / folder / "result.json", to_json(at.result));
    write_file(out_ / folder / "scene.json", document);
    page_->write(out_ / folder / "report.html", document);
    if (page_->there()) card.report = (folder / "report.html").string();
  }
  std::vector<MeshCard> take() { return std::move(cards_); }

 private:
  const Model& model_;
  const fs::path& out_;
  const Page* page_;
  std::vector<fs::path> folders_;
  std::vector<MeshCard> cards_;
};

int evaluate(const EvaluateOptions& options) {
  PipelineSession session(options);
  std::vector<Dataset> datasets;
  for (const fs::path& file : options.datasets) datasets.push_back(read_dataset(file));
  for (Dataset& dataset : datasets)
    if (!options.model.empty()) dataset.model = options.model;
  const std::string baseline =
      options.baseline.empty() ? "" : read_text_file(options.baseline, "--baseline: evaluation");
  if (!options.out.empty()) make_folder(options.out, "--out");

  std::optional<Page> page;
  if (options.reports) page.emplace("report.html", "", session.context());

  int code = 0;
  std::vector<Evaluation> evaluations;
  std::vector<std::vector<MeshCard>> cards;
  std::string text, markdown;
  for (const Dataset& dataset : datasets) {
    for (const std::string& pattern : dataset.absent)
      complain("warning: " + dataset.name + ": no file matches " + pattern + "; these meshes are left out");
    session.status(dataset.name);
    const Model model = read_model(find_resource("models", dataset.model), &session.host().catalog());
    const Stations stations = session.stations(model);
    Gallery gallery(dataset, model, options.out, page ? &*page : nullptr);
    MeshObserver observer;
    if (!options.out.empty()) observer = [&](const MeshAtHand& at) { gallery.add(at); };
    Evaluation evaluation = toposcope::evaluate(dataset, model, stations, session.host(), session.context(), observer);
    cards.push_back(gallery.take());
    evaluation.pipeline = !options.pipeline.empty() ? options.pipeline : session.pipeline(model).name;
    session.status("");
    std::vector<Table> all = tables(evaluation);
    if (!options.baseline.empty())
      for (Table& table : changes(evaluation, baseline, options.baseline.string())) all.push_back(std::move(table));
    const std::string part = fmt::format("{}\n{}\n{}", title(evaluation), headline(evaluation), to_text(all));
    if (!options.json && !options.csv && !options.markdown) say("{}\n", part);
    text += part + "\n";
    markdown += fmt::format("## {}\n\n{}.\n{}\n", title(evaluation), headline(evaluation), to_markdown(all));
    if (const std::string undone = not_evaluated(evaluation); !undone.empty()) {
      complain(undone);
      code = MeshError("").exit_code;
    }
    evaluations.push_back(std::move(evaluation));
    flush_output();
  }
  if (options.json) say("{}", to_json(evaluations));
  if (options.csv) say("{}", to_csv(evaluations));
  if (options.markdown) say("{}", markdown);
  if (!options.out.empty()) {
    write_file(options.out / "evaluation.txt", text);
    write_file(options.out / "evaluation.md", markdown);
    write_file(options.out / "evaluation.json", to_json(evaluations));
    write_file(options.out / "evaluation.csv", to_csv(evaluations));
    write_index(options.out, evaluation_index(evaluations, cards, program_name()), session.context());
  }
  return code;
}

}  // namespace

void add_evaluate(CLI::App& app, int& code) {
  CLI::App& command = *app.add_subcommand("evaluate", "label meshes whose truth is known, and say how good it is");
  const auto options = std::make_shared<EvaluateOptions>();
  command.add_option("dataset", options->datasets, "data sets: which meshes, which model")
      ->required()
      ->type_name("DATASET.yaml...");
  add_model(command, options->model, " to use instead of the data set's");
  CLI::Option* out =
      command.add_option("--out", options->out, "write index.html, evaluation.txt, .md, .json and .csv to DIR")
          ->type_name("DIR");
  command.add_flag("--reports", options->reports, "write a report for each mesh too, to DIR/<data set>/<mesh>/")
      ->needs(out);
  command.add_option("--baseline", options->baseline, "an earlier evaluation.json: show what changed")
      ->type_name("FILE");
  add_table_formats(command, options->json, options->csv, options->markdown, "mesh and feature");
  add_common(command, *options);
  command.callback([options, &code] { code = evaluate(*options); });
}

}  // namespace toposcope::cli
