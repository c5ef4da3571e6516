// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <set>

#include "base/assignment.h"
#include "base/errors.h"
#include "commands.h"
#include "compare/comparison.h"
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

struct CompareOptions : CommonOptions {
  std::vector<fs::path> meshes;
  std::string model;
  std::string labelers = "all";
  double time_limit_s = 10;
  fs::path out;  ///< empty: nothing is written
  bool csv = false, markdown = false;
};

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::size_t begin = 0;
  for (std::size_t end = text.find(separator); end != text.npos; end = text.find(separator, begin)) {
    parts.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  parts.push_back(text.substr(begin));
  return parts;
}

/// `id` or `id:option=value:option=value`.
Contender contender_of(const std::string& text, PluginHost& host) {
  const std::vector<std::string> parts = split(text, ':');
  const PluginManifest& plugin = host.catalog().require(PluginKind::labelers, parts[0], "--labelers");
  std::vector<GivenOption> given;
  for (std::size_t i = 1; i < parts.size(); ++i) {
    const auto option = split_assignment(parts[i]);
    if (!option) throw UsageError("--labelers: '" + text + "': expected id or id:option=value:option=value");
    given.push_back(*option);
  }
  return {text, plugin.id,
          host.labeler(plugin.id, check_options(plugin.options, given, "--labelers: labeler '" + plugin.id + "'"))};
}

/// In the order given. `all` is every labeler that can run here, by id.
std::vector<Contender> contenders_of(const std::string& list, Session& session) {
  std::vector<Contender> contenders;
  for (const std::string& text : split(list, ',')) {
    if (text != "all") {
      contenders.push_back(contender_of(text, session.host()));
      continue;
    }
    for (const PluginManifest* plugin : session.host().catalog().all(PluginKind::labelers))
      if (const std::string missing = missing_programs(*plugin); missing.empty())
        contenders.push_back(contender_of(plugin->id, session.host()));
      else
        session.context().log(LogLevel::warning, "labeler '" + plugin->id + "' is left out: " + missing);
  }
  for (std::size_t i = 0; i < contenders.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (contenders[i].name == contenders[j].name)
        throw UsageError("--labelers: '" + contenders[i].name + "' is given twice");
  return contenders;
}

/// What the index shows of meshes and labelers.
class Gallery {
 public:
  void add(const Comparison& comparison, std::vector<LabelerView> views, Context& context) {
    if (views.empty()) return cards_.push_back({});  // no labeler gave anything to show
    cards_.push_back({thumbnail_of(views.front().scene, context), ""});
    // Of one mesh, that on which labelers differ most: side by side on others they would look the same.
    std::set<std::vector<std::pair<std::string, Index>>> labelings;
    for (const Entry& entry : comparison.entries) labelings.insert(entry.labeling);
    if (labelings.size() <= most_labelings_) return;
    most_labelings_ = labelings.size();
    views_ = std::move(views);
  }
  std::string index(const std::vector<Comparison>& comparisons) const {
    return comparison_index(comparisons, cards_, views_, program_name());
  }

 private:
  std::vector<MeshCard> cards_;
  std::vector<LabelerView> views_;
  std::size_t most_labelings_ = 0;
};

int compare(const CompareOptions& options) {
  PipelineSession session(options);
  const Model model = read_model(find_resource("models", options.model), &session.host().catalog());
  const Stations stations = session.stations(model);
  const std::vector<Contender> contenders = contenders_of(options.labelers, session);
  LabelingRequest request;
  request.time_limit_s = options.time_limit_s;
  if (!options.out.empty()) make_folder(options.out, "--out");
  std::vector<Comparison> comparisons;
  Gallery gallery;
  const bool text = !options.json && !options.csv && !options.markdown;
  const int code = for_each_mesh(options.meshes, session, [&](const fs::path& path) {
    const RepairedMesh input = session.read(path);
    const fs::path truth_file = truth_beside(path);
    std::optional<Truth> truth;
    if (!truth_file.empty()) truth = read_truth(truth_file);
    Analysis analysis = construct(input.mesh, model, stations, session.context());
    std::vector<LabelerView> views;
    const auto look = [&](const Contender& contender, const Analysis& labelled, Result result) {
      result.repair = input.repair;
      views.push_back({contender.name, make_scene(labelled, model, result, truth ? &*truth : nullptr, found_alone)});
    };
    comparisons.push_back(toposcope::compare(analysis, model, stations, path.string(), contenders, request,
                                             truth ? &*truth : nullptr, session.context(),
                                             options.out.empty() ? LabelerObserver() : look));
    stop_if_cancelled(session.context(), path.string() + " was not compared by all labelers");
    if (!options.out.empty()) gallery.add(comparisons.back(), std::move(views), session.context());
    session.status("");
    if (text) say("{}", to_text(comparisons.back()));
    flush_output();
    std::vector<std::string> failed;
    for (const Entry& entry : comparisons.back().entries)
      if (!entry.error.empty()) failed.push_back(entry.labeler + " (" + entry.error + ")");
    if (!failed.empty())
      throw Error(path.string() + ": " + not_done(contenders.size(), "labelers", failed),
                  PluginError("", "").exit_code);
  });
  if (!options.out.empty()) {
    write_file(options.out / "comparison.json", to_json(comparisons));
    write_file(options.out / "comparison.csv", to_csv(comparisons));
    write_index(options.out, gallery.index(comparisons), session.context());
  }
  if (options.json)
    say("{}", to_json(comparisons));
  else if (options.csv)
    say("{}", to_csv(comparisons));
  else if (options.markdown)
    say("{}", to_markdown(totals(comparisons)));
  else if (comparisons.size() > 1)
    say("{}", to_text(totals(comparisons)));
  return code;
}

}  // namespace

void add_compare(CLI::App& app, int& code) {
  CLI::App& command = *app.add_subcommand("compare", "the same labelling problem under several labelers, as a table");
  const auto options = std::make_shared<CompareOptions>();
  add_meshes(command, options->meshes, "; <mesh>.truth.json beside one tells what is right")->required();
  add_model(command, options->model)->required();
  command
      .add_option("--labelers", options->labelers,
                  "separated by commas, each with its own options: annealing:sweeps=50,least-error; all: every one")
      ->type_name("A,B")
      ->capture_default_str();
  command.add_option("--time-limit", options->time_limit_s, "seconds for each labeler and problem")
      ->type_name("S")
      ->check(number_from_zero())
      ->capture_default_str();
  command.add_option("--out", options->out, "write index.html, comparison.json and .csv to DIR")->type_name("DIR");
  add_table_formats(command, options->json, options->csv, options->markdown, "mesh and labeler");
  add_pipeline(command, *options);
  add_seed(command, options->seed);
  add_session(command, *options);
  command.callback([options, &code] { code = compare(*options); });
}

}  // namespace toposcope::cli
