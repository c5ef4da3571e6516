// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include "base/errors.h"
#include "commands.h"
#include "compare/comparison.h"
#include "model/read_model.h"
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

}  // namespace

int compare(const CompareOptions& options) {
  PipelineSession session(options);
  const Model model = read_model(find_resource("models", options.model), &session.host().catalog());
  const Stations stations = session.stations(model);
  const std::vector<Contender> contenders = contenders_of(options.labelers, session);
  LabelingRequest request;
  request.time_limit_s = options.time_limit_s;
  std::vector<Comparison> comparisons;
  const bool text = !options.json && !options.csv && !options.markdown;
  const int code = for_each_mesh(options.meshes, session, [&](const fs::path& path) {
    const Mesh mesh = session.read(path).mesh;
    const fs::path truth_file = truth_beside(path);
    std::optional<Truth> truth;
    if (!truth_file.empty()) truth = read_truth(truth_file);
    Analysis analysis = construct(mesh, model, stations, session.context());
    comparisons.push_back(toposcope::compare(analysis, model, stations, path.string(), contenders, request,
                                             truth ? &*truth : nullptr, session.context()));
    session.status("");
    if (text) fmt::print("{}", to_text(comparisons.back()));
    std::fflush(stdout);
  });
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
