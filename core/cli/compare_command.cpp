// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <set>

#include "base/errors.h"
#include "commands.h"
#include "compare/comparison.h"
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
    const std::size_t equals = parts[i].find('=');
    if (equals == parts[i].npos)
      throw UsageError("--labelers: '" + text + "': expected id or id:option=value:option=value");
    given.push_back({parts[i].substr(0, equals), parts[i].substr(equals + 1)});
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
    cards_.push_back({thumbnail_of(views.front().scene, context), ""});
    // Of one mesh, that on which labelers differ most: side by side on others they would look the same.
    std::set<std::vector<std::pair<std::string, Index>>> labellings;
    for (const Entry& entry : comparison.entries) labellings.insert(entry.labeling);
    if (labellings.size() <= most_labellings_) return;
    most_labellings_ = labellings.size();
    views_ = std::move(views);
  }
  std::string index(const std::vector<Comparison>& comparisons) const {
    return comparison_index(comparisons, cards_, views_, program_name());
  }

 private:
  std::vector<MeshCard> cards_;
  std::vector<LabelerView> views_;
  std::size_t most_labellings_ = 0;
};

}  // namespace

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
    if (!options.out.empty()) gallery.add(comparisons.back(), std::move(views), session.context());
    session.status("");
    if (text) fmt::print("{}", to_text(comparisons.back()));
    std::fflush(stdout);
  });
  if (!options.out.empty()) {
    write_file(options.out / "comparison.json", to_json(comparisons));
    write_file(options.out / "comparison.csv", to_csv(comparisons));
    write_index(options.out, gallery.index(comparisons), session.context());
  }
  if (options.json)
    fmt::print("{}", to_json(comparisons));
  else if (options.csv)
    fmt::print("{}", to_csv(comparisons));
  else if (options.markdown)
    fmt::print("{}", to_markdown(totals(comparisons)));
  else if (comparisons.size() > 1)
    fmt::print("{}", to_text(totals(comparisons)));
  return code;
}

}  // namespace toposcope::cli
