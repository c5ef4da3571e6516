// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <cctype>
#include <optional>

#include "base/text_file.h"
#include "commands.h"
#include "evaluation/evaluation.h"
#include "index/index_document.h"
#include "io/mesh_io.h"
#include "model/read_model.h"
#include "output_folder.h"
#include "picture/stages.h"
#include "report_files.h"
#include "resources.h"
#include "session.h"

namespace toposcope::cli {
namespace {

std::string title(const Evaluation& evaluation) {
  return evaluation.summary.empty() ? evaluation.dataset : evaluation.summary;
}

/// A folder's name from a mesh's, and part of an address.
std::string folder_name(const std::string& name) {
  std::string folder = name;
  for (char& c : folder)
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '.' && c != '-') c = '_';
  return folder;
}

/// Pictures and reports of the meshes of one data set.
class Gallery {
 public:
  /// \param page  null: no reports
  Gallery(const Dataset& dataset, const Model& model, const fs::path& out, const Page* page)
      : dataset_(dataset), model_(model), out_(out), page_(page), cards_(dataset.meshes.size()) {}

  void add(const MeshAtHand& at) {
    MeshCard& card = cards_[at.number];
    const Truth* truth = at.known.truth.features.empty() ? nullptr : &at.known.truth;
    card.thumbnail = thumbnail_of(make_scene(at.analysis, model_, at.result, truth, found_alone), at.context);
    if (!page_) return;
    const fs::path folder = fs::path(folder_name(dataset_.name)) / folder_name(dataset_.meshes[at.number].name);
    make_folder(out_ / folder, "--out");
    const std::string document = to_json(make_scene(at.analysis, model_, at.result, truth), program_name());
    write_file(out_ / folder / "result.json", to_json(at.result));
    write_file(out_ / folder / "scene.json", document);
    page_->write(out_ / folder / "report.html", document);
    if (page_->there()) card.report = (folder / "report.html").string();
  }
  std::vector<MeshCard> take() { return std::move(cards_); }

 private:
  const Dataset& dataset_;
  const Model& model_;
  const fs::path& out_;
  const Page* page_;
  std::vector<MeshCard> cards_;
};

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

  std::optional<Page> page;
  if (options.reports) page.emplace("report.html", "", session.context());

  std::vector<Evaluation> evaluations;
  std::vector<std::vector<MeshCard>> cards;
  std::string text, markdown;
  for (const Dataset& dataset : datasets) {
    for (const std::string& pattern : dataset.absent)
      fmt::print(stderr, "toposcope: warning: {}: no file matches {}; these meshes are left out\n", dataset.name,
                 pattern);
    session.status(dataset.name);
    const Model model = read_model(find_resource("models", dataset.model), &session.host().catalog());
    const Stations stations = session.stations(model);
    Gallery gallery(dataset, model, options.out, page ? &*page : nullptr);
    MeshObserver observer;
    if (!options.out.empty()) observer = [&](const MeshAtHand& at) { gallery.add(at); };
    Evaluation evaluation = toposcope::evaluate(dataset, model, stations, session.host(), session.context(), observer);
    cards.push_back(gallery.take());
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
    write_index(options.out, evaluation_index(evaluations, cards, program_name()), session.context());
  }
  return 0;
}

}  // namespace toposcope::cli
