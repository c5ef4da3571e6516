// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/stations.h"

#include "pipeline/pipeline_manifest.h"
#include "plugin/option_check.h"
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

}  // namespace

PluginUse use_of(const PluginManifest& manifest, const std::vector<OptionValue>& options) {
  PluginUse use{std::string(to_string(manifest.kind)), manifest.id, manifest.version, {}};
  for (std::size_t i = 0; i < options.size(); ++i)
    use.options.emplace_back(options[i].name, to_string(manifest.options[i], options[i]));
  return use;
}

Stations make_stations(PluginHost& host, const PipelineManifest& pipeline, const Model& model) {
  const PluginCatalog& catalog = host.catalog();
  Stations stations;
  for (const StationPlugin& filter : pipeline.filters) {
    stations.filters.push_back({filter.plugin, host.filter(filter.plugin, filter.options)});
    stations.uses.push_back(use_of(catalog.require(PluginKind::filters, filter.plugin), filter.options));
  }

  const PluginManifest& worksets = catalog.require(PluginKind::worksets, pipeline.worksets.plugin);
  stations.worksets_id = worksets.id;
  stations.worksets = host.worksets(worksets.id, pipeline.worksets.options);
  for (const ProvidedRow& type : worksets.provides) stations.workset_types.push_back(type.name);
  stations.uses.push_back(use_of(worksets, pipeline.worksets.options));

  for (const ModelFeature& feature : model.features) {
    for (const std::vector<std::string>* types : {&feature.worksets, &feature.second_look})
      for (const std::string& type : *types)
        if (!worksets.find_provided(type))
          throw UsageError(feature.where.str() + ": feature '" + feature.name + "' asks for working sets of type '" +
                           type + "', which '" + worksets.id + "' of pipeline '" + pipeline.name +
                           "' does not provide");
    const PluginManifest& shape = catalog.require(PluginKind::shapes, feature.shape.plugin, feature.shape.where.str());
    stations.shape_arguments.push_back(check_options(shape.arguments, feature.shape.arguments,
                                                     feature.shape.where.str() + ": shape '" + shape.id + "'"));
    if (stations.shapes.contains(shape.id)) continue;
    const auto options = plugin_options(pipeline, catalog, PluginKind::shapes, shape.id);
    stations.shapes[shape.id] = host.shape(shape.id, options);
    stations.uses.push_back(use_of(shape, options));
  }
  for (const Relationship& relationship : model.relationships) {
    const PluginManifest& relation =
        catalog.require(PluginKind::relations, relationship.plugin, relationship.where.str());
    stations.relation_units.push_back(relation.unit);
    stations.relation_ordered.push_back(relation.ordered);
    stations.relation_defaults.push_back(
        argument_defaults(relation, relationship.where.str() + ": relation '" + relation.id + "'"));
    if (stations.relations.contains(relation.id)) continue;
    const auto options = plugin_options(pipeline, catalog, PluginKind::relations, relation.id);
    stations.relations[relation.id] = host.relation(relation.id, options);
    stations.uses.push_back(use_of(relation, options));
  }

  const PluginManifest& labeler = catalog.require(PluginKind::labelers, pipeline.labeler.plugin);
  stations.labeler_id = labeler.id;
  stations.labeler = host.labeler(labeler.id, pipeline.labeler.options);
  stations.uses.push_back(use_of(labeler, pipeline.labeler.options));
  if (pipeline.marginals) {
    const PluginManifest& marginals = catalog.require(PluginKind::labelers, pipeline.marginals->plugin);
    stations.marginals_id = marginals.id;
    stations.marginals = host.labeler(marginals.id, pipeline.marginals->options);
    stations.uses.push_back(use_of(marginals, pipeline.marginals->options));
  }
  stations.probability = probability_model(Options(pipeline.probability));
  return stations;
}

}  // namespace toposcope
