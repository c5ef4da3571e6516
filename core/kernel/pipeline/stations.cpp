// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/stations.h"

#include <algorithm>
#include <map>

#include "base/errors.h"
#include "base/nearest_name.h"
#include "pipeline/pipeline_manifest.h"
#include "plugin/plugin_host.h"
#include "probability/probability_options.h"

namespace toposcope {
namespace {

/// Defaults of the arguments that have one; the model gives the others.
std::vector<OptionValue> argument_defaults(const PluginManifest& manifest, const std::string& owner) {
  std::vector<OptionValue> values;
  for (const OptionRow& row : manifest.arguments)
    if (!row.default_value.empty())
      values.push_back(check_option(manifest.arguments, row.name, row.default_value, owner));
  return values;
}

/// Makes one object per plugin id, and enters it among the uses when it is first asked for.
class SharedPlugins {
 public:
  SharedPlugins(PluginHost& host, const PipelineManifest& pipeline, std::vector<PluginUse>& uses)
      : host_(host), pipeline_(pipeline), uses_(uses) {}

  std::shared_ptr<const ShapeFitter> shape(const PluginManifest& manifest) {
    return once(fitters_, manifest, [&](const auto& options) { return host_.shape(manifest.id, options); });
  }
  std::shared_ptr<const RelationTester> relation(const PluginManifest& manifest) {
    return once(testers_, manifest, [&](const auto& options) { return host_.relation(manifest.id, options); });
  }

 private:
  template <class Plugin, class Make>
  std::shared_ptr<const Plugin> once(std::map<std::string, std::shared_ptr<const Plugin>>& made,
                                     const PluginManifest& manifest, const Make& make) {
    std::shared_ptr<const Plugin>& plugin = made[manifest.id];
    if (!plugin) {
      const auto options = plugin_options(pipeline_, host_.catalog(), manifest.kind, manifest.id);
      plugin = make(options);
      uses_.push_back(use_of(manifest, options));
    }
    return plugin;
  }

  PluginHost& host_;
  const PipelineManifest& pipeline_;
  std::vector<PluginUse>& uses_;
  std::map<std::string, std::shared_ptr<const ShapeFitter>> fitters_;
  std::map<std::string, std::shared_ptr<const RelationTester>> testers_;
};

}  // namespace

PluginUse use_of(const PluginManifest& manifest, const std::vector<OptionValue>& options) {
  PluginUse use{std::string(to_string(manifest.kind)), manifest.id, manifest.version, {}};
  for (std::size_t i = 0; i < options.size(); ++i)
    use.options.emplace_back(options[i].name, to_string(manifest.options[i], options[i]));
  return use;
}

void check_types(const Model& model, const PipelineManifest& pipeline, const PluginCatalog& catalog) {
  std::vector<std::string> provided;
  std::string classifiers;
  for (const StationPlugin& station : pipeline.worksets) {
    const PluginManifest& plugin = catalog.require(PluginKind::worksets, station.plugin);
    for (const ProvidedRow& type : plugin.provides) provided.push_back(type.name);
    classifiers += (classifiers.empty() ? "'" : ", '") + plugin.id + "'";
  }
  for (const ModelFeature& feature : model.features)
    for (const std::vector<std::string>* types : {&feature.worksets, &feature.second_look})
      for (const std::string& type : *types)
        if (std::find(provided.begin(), provided.end(), type) == provided.end())
          throw UsageError(feature.where.str() + ": feature '" + feature.name + "' asks for working sets of type '" +
                           type + "', which pipeline '" + pipeline.name + "' (" + classifiers +
                           ") does not provide; name another type or pipeline, or add a classifier that makes it: " +
                           name_remedy(type, provided));
}

FilterStation make_filter(PluginHost& host, std::string_view id, std::span<const GivenOption> given,
                          const std::string& owner) {
  const PluginManifest& manifest = host.catalog().require(PluginKind::filters, id, owner);
  return make_filter(host, id, check_options(manifest.options, given, owner + ": filter '" + manifest.id + "'"));
}

FilterStation make_filter(PluginHost& host, std::string_view id, const std::vector<OptionValue>& options) {
  const PluginManifest& manifest = host.catalog().require(PluginKind::filters, id);
  return {manifest.id, host.filter(id, options), use_of(manifest, options)};
}

Stations make_stations(PluginHost& host, const PipelineManifest& pipeline, const Model& model) {
  const PluginCatalog& catalog = host.catalog();
  Stations stations;
  stations.resolution = resolution_of(Options(pipeline.resolution));
  for (const StationPlugin& filter : pipeline.filters) {
    stations.filters.push_back(make_filter(host, filter.plugin, filter.options));
    stations.uses.push_back(stations.filters.back().use);
  }

  check_types(model, pipeline, catalog);
  for (const StationPlugin& chosen : pipeline.worksets) {
    const PluginManifest& plugin = catalog.require(PluginKind::worksets, chosen.plugin);
    WorkingSetStation& station =
        stations.working_sets.emplace_back(WorkingSetStation{plugin.id, {}, host.worksets(plugin.id, chosen.options)});
    for (const ProvidedRow& type : plugin.provides) station.types.push_back(type.name);
    stations.uses.push_back(use_of(plugin, chosen.options));
  }

  SharedPlugins plugins(host, pipeline, stations.uses);
  for (const ModelFeature& feature : model.features) {
    const auto shape_station = [&](const ShapeSpec& spec) {
      const std::string where = spec.where.str();
      const PluginManifest& shape = catalog.require(PluginKind::shapes, spec.plugin, where);
      return ShapeStation{plugins.shape(shape),
                          check_options(shape.arguments, spec.arguments, where + ": shape '" + shape.id + "'"),
                          shape.id, shape.dimension};
    };
    FeatureStation& station = stations.features.emplace_back(FeatureStation{shape_station(feature.shape), {}});
    for (const ShapeSpec& other : feature.other_shapes) station.others.push_back(shape_station(other));
  }
  for (const Relationship& relationship : model.relationships) {
    const std::string where = relationship.where.str();
    const PluginManifest& relation = catalog.require(PluginKind::relations, relationship.plugin, where);
    RelationshipStation& station = stations.relationships.emplace_back();
    station.unit = relation.unit;
    station.ordered = relation.ordered;
    station.arguments = relation.arguments;
    station.defaults = argument_defaults(relation, where + ": relation '" + relation.id + "'");
    station.tester = plugins.relation(relation);
  }

  const auto labeler = [&](const StationPlugin& chosen) {
    const PluginManifest& manifest = catalog.require(PluginKind::labelers, chosen.plugin);
    LabelerStation station{manifest.id, host.labeler(manifest.id, chosen.options)};
    stations.uses.push_back(use_of(manifest, chosen.options));
    return station;
  };
  stations.labeler = labeler(pipeline.labeler);
  if (pipeline.marginals) stations.marginals = labeler(*pipeline.marginals);
  stations.probability = probability_model(Options(pipeline.probability));
  return stations;
}

}  // namespace toposcope
