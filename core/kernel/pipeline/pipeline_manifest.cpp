// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/pipeline_manifest.h"

#include <algorithm>

#include "base/assignment.h"
#include "base/nearest_name.h"
#include "base/schemas.h"
#include "base/text_file.h"
#include "model/yaml_schema.h"
#include "pipeline/resolution.h"
#include "plugin/option_check.h"
#include "probability/probability_options.h"

namespace toposcope {
namespace {

/// "shape 'circle'"
std::string owner_name(PluginKind kind, const std::string& id) {
  return std::string(singular(kind)) + " '" + id + "'";
}

/// Reads the stations of a document that has passed the schema.
class Reader {
 public:
  Reader(const std::string& file, const PluginCatalog& catalog, ErrorList& errors)
      : file_(file), catalog_(catalog), errors_(errors) {}

  /// {plugin: id, option: value, ...}
  StationPlugin station(const YAML::Node& node, PluginKind kind) {
    StationPlugin station;
    station.plugin = node["plugin"].Scalar();
    if (const PluginManifest* plugin = require(kind, station.plugin, node["plugin"]))
      station.options = options(node, plugin->options, owner_name(kind, station.plugin), "plugin");
    return station;
  }

  /// A station, or a list of them.
  std::vector<StationPlugin> one_or_more(const YAML::Node& node, PluginKind kind) {
    if (!node.IsSequence()) return {station(node, kind)};
    std::vector<StationPlugin> all;
    for (const YAML::Node& each : node) all.push_back(station(each, kind));
    return all;
  }

  /// {id: {option: value, ...}, ...}
  std::map<std::string, std::vector<OptionValue>> stations(const YAML::Node& node, PluginKind kind) {
    std::map<std::string, std::vector<OptionValue>> all;
    if (!node) return all;
    for (const auto& entry : node) {
      const std::string& id = entry.first.Scalar();
      if (const PluginManifest* plugin = require(kind, id, entry.first))
        all[id] = options(entry.second, plugin->options, owner_name(kind, id));
    }
    return all;
  }

  /// Each option is checked by itself, so that each error names its own place; then all together.
  std::vector<OptionValue> options(const YAML::Node& node, std::span<const OptionRow> table, const std::string& owner,
                                   std::string_view other_key = "") {
    std::vector<GivenOption> given;
    bool sound = true;
    if (node.IsDefined()) {
      for (const auto& entry : node) {
        const GivenOption option(entry.first.Scalar(), entry.second.Scalar());
        if (option.first == other_key) continue;
        sound &= attempt(entry.first, [&](const std::string& where) {
          check_option(table, option.first, option.second, where + ": " + owner);
        });
        given.push_back(option);
      }
    }
    std::vector<OptionValue> checked;
    if (sound)
      attempt(node, [&](const std::string& where) { checked = check_options(table, given, where + ": " + owner); });
    return checked;
  }

 private:
  const PluginManifest* require(PluginKind kind, const std::string& id, const YAML::Node& node) {
    const PluginManifest* plugin = nullptr;
    attempt(node, [&](const std::string& where) { plugin = &catalog_.require(kind, id, where); });
    return plugin;
  }

  template <class Check>
  bool attempt(const YAML::Node& node, const Check& check) {
    const SourceLocation where = node.IsDefined() ? location_of(node, file_) : SourceLocation{file_, 1, 1};
    try {
      check(where.str());
      return true;
    } catch (const UsageError& error) {
      errors_.add_located(where, error.what());
      return false;
    }
  }

  const std::string& file_;
  const PluginCatalog& catalog_;
  ErrorList& errors_;
};

void replace(std::vector<OptionValue>& options, OptionValue value) {
  for (OptionValue& option : options)
    if (option.name == value.name) option = std::move(value);
}

/// "shapes.circle.method=powell" taken apart; `id` is empty for stations of one plugin.
struct Setting {
  std::string station, id, option, value;
};

Setting parse_setting(std::string_view text, const std::string& owner) {
  const std::string form =
      "; write station.option=value, such as relations.parallel.tolerance=5 or shapes.circle.method=powell";
  const auto assignment = split_assignment(text);
  if (!assignment) throw UsageError(owner + ": is no assignment" + form);
  const std::string_view path = assignment->first;
  const std::size_t first = path.find('.'), last = path.rfind('.');
  if (first == path.npos || first == 0 || last + 1 == path.size())
    throw UsageError(owner + ": '" + std::string(path) + "' does not name station and option" + form);
  Setting setting{.station = std::string(path.substr(0, first)),
                  .id = first == last ? "" : std::string(path.substr(first + 1, last - first - 1)),
                  .option = std::string(path.substr(last + 1)),
                  .value = assignment->second};
  const std::vector<std::string> stations = {"filters", "worksets",  "shapes",     "relations",
                                             "labeler", "marginals", "resolution", "probability"};
  if (std::find(stations.begin(), stations.end(), setting.station) == stations.end())
    throw UsageError(owner + ": there is no station '" + setting.station + "'; " +
                     name_remedy(setting.station, stations));
  const bool many = setting.station == "filters" || setting.station == "shapes" || setting.station == "relations";
  if (setting.station != "worksets" && many == setting.id.empty())  // of classifiers there may be one or several
    throw UsageError(owner + ": station '" + setting.station + "' " +
                     (many ? "has several plugins; name one: " + setting.station + ".<plugin>.<option>=<value>"
                           : "has one plugin; write " + setting.station + "." + setting.option + "=<value>"));
  return setting;
}

/// The stations of a pipeline that a setting means: every one of its id, or without an id the only one there is.
std::vector<StationPlugin*> meant(std::vector<StationPlugin>& stations, const Setting& setting,
                                  const std::string& owner, const std::string& pipeline) {
  const std::string one = setting.station == "filters" ? "filter" : "classifier";
  std::vector<std::string> ids;
  for (const StationPlugin& station : stations) ids.push_back(station.plugin);
  if (setting.id.empty() && stations.size() > 1)
    throw UsageError(owner + ": the pipeline '" + pipeline + "' has several " + one + "s; name one, as in " +
                     setting.station + "." + ids.front() + "." + setting.option + "; " + name_remedy("", ids));
  std::vector<StationPlugin*> found;
  for (StationPlugin& station : stations)
    if (setting.id.empty() || station.plugin == setting.id) found.push_back(&station);
  if (found.empty())
    throw UsageError(owner + ": the pipeline '" + pipeline + "' has no " + one + " '" + setting.id + "'; " +
                     name_remedy(setting.id, ids));
  return found;
}

}  // namespace

PipelineManifest read_pipeline(const std::filesystem::path& path, const PluginCatalog& catalog) {
  const std::string file = path.string();
  const YAML::Node root = parse_yaml(read_text_file(path, "pipeline"), file);
  ErrorList errors;
  check_schema(root, pipeline_schema(), file, errors);
  errors.throw_if_any();

  Reader reader(file, catalog, errors);
  PipelineManifest pipeline;
  pipeline.file = file;
  pipeline.name = root["name"].Scalar();
  if (root["summary"]) pipeline.summary = root["summary"].Scalar();
  pipeline.resolution = reader.options(root["resolution"], resolution_option_table(), "resolution");
  if (root["filters"])
    for (const YAML::Node& filter : root["filters"])
      pipeline.filters.push_back(reader.station(filter, PluginKind::filters));
  pipeline.worksets = reader.one_or_more(root["worksets"], PluginKind::worksets);
  pipeline.shapes = reader.stations(root["shapes"], PluginKind::shapes);
  pipeline.relations = reader.stations(root["relations"], PluginKind::relations);
  pipeline.labeler = reader.station(root["labeler"], PluginKind::labelers);
  if (root["marginals"]) pipeline.marginals = reader.station(root["marginals"], PluginKind::labelers);
  pipeline.probability = reader.options(root["probability"], probability_option_table(), "probability");
  errors.throw_if_any();
  return pipeline;
}

std::vector<OptionValue> plugin_options(const PipelineManifest& pipeline, const PluginCatalog& catalog, PluginKind kind,
                                        std::string_view id) {
  const auto& stations = kind == PluginKind::shapes ? pipeline.shapes : pipeline.relations;
  const std::string name(id);
  if (const auto found = stations.find(name); found != stations.end()) return found->second;
  return check_options(catalog.require(kind, id).options, {}, pipeline.file + ": " + owner_name(kind, name));
}

void apply_override(PipelineManifest& pipeline, std::string_view text, const PluginCatalog& catalog) {
  const std::string owner = "--set '" + std::string(text) + "'";
  const Setting setting = parse_setting(text, owner);
  const auto checked = [&](PluginKind kind, const std::string& id) {
    return check_option(catalog.require(kind, id, owner).options, setting.option, setting.value,
                        owner + ": " + owner_name(kind, id));
  };
  if (setting.station == "worksets" || setting.station == "filters") {
    const bool is_filter = setting.station == "filters";
    for (StationPlugin* station :
         meant(is_filter ? pipeline.filters : pipeline.worksets, setting, owner, pipeline.name))
      replace(station->options, checked(is_filter ? PluginKind::filters : PluginKind::worksets, station->plugin));
  } else if (setting.station == "labeler") {
    replace(pipeline.labeler.options, checked(PluginKind::labelers, pipeline.labeler.plugin));
  } else if (setting.station == "marginals") {
    if (!pipeline.marginals)
      throw UsageError(owner + ": the pipeline '" + pipeline.name +
                       "' has no station 'marginals'; add one, such as marginals: {plugin: posterior}");
    replace(pipeline.marginals->options, checked(PluginKind::labelers, pipeline.marginals->plugin));
  } else if (setting.station == "resolution") {
    replace(pipeline.resolution,
            check_option(resolution_option_table(), setting.option, setting.value, owner + ": resolution"));
  } else if (setting.station == "probability") {
    replace(pipeline.probability,
            check_option(probability_option_table(), setting.option, setting.value, owner + ": probability"));
  } else {
    const PluginKind kind = setting.station == "shapes" ? PluginKind::shapes : PluginKind::relations;
    OptionValue value = checked(kind, setting.id);
    auto options = plugin_options(pipeline, catalog, kind, setting.id);
    replace(options, std::move(value));
    (kind == PluginKind::shapes ? pipeline.shapes : pipeline.relations)[setting.id] = std::move(options);
  }
}

void set_labeler(PipelineManifest& pipeline, std::string_view id, const PluginCatalog& catalog) {
  if (id == pipeline.labeler.plugin) return;
  const PluginManifest& plugin = catalog.require(PluginKind::labelers, id, "--labeler");
  pipeline.labeler = {plugin.id, check_options(plugin.options, {}, "--labeler: " + owner_name(plugin.kind, plugin.id))};
}

}  // namespace toposcope
