// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "plugin/catalog.h"
#include "toposcope/options.h"

namespace toposcope {

/// A plugin and the checked values of all its options.
struct StationPlugin {
  std::string plugin;
  std::vector<OptionValue> options;
};

/// Which plugin serves each station, with options (schemas/pipeline.schema.json).
struct PipelineManifest {
  std::string name, summary;
  std::string file;
  std::vector<OptionValue> resolution;                        ///< the kernel's own: resolution_option_table()
  std::vector<StationPlugin> filters;                         ///< in order
  std::vector<StationPlugin> worksets;                        ///< at least one; what they give is pooled
  std::map<std::string, std::vector<OptionValue>> shapes;     ///< by plugin id; those not named take their defaults
  std::map<std::string, std::vector<OptionValue>> relations;  ///< likewise
  StationPlugin labeler;
  std::optional<StationPlugin> marginals;  ///< the labeler whose probabilities are reported; absent: `labeler`
  std::vector<OptionValue> probability;    ///< the kernel's own: probability_option_table()
};

/// Reads a pipeline and checks all of it against the plugins' manifests: nothing is loaded.
/// \throw UsageError  all errors of the file, each as file:line:column; PluginError  a plugin that it names has a
/// problem
PipelineManifest read_pipeline(const std::filesystem::path& path, const PluginCatalog& catalog);

/// The options of a shape or relation under this pipeline: those it sets, or the plugin's defaults.
/// \throw UsageError  unknown plugin, option without default
std::vector<OptionValue> plugin_options(const PipelineManifest& pipeline, const PluginCatalog& catalog, PluginKind kind,
                                        std::string_view id);

/// Command line `--set`: "station.option=value", where station is filters.<id> or worksets.<id> (every one of that
/// id; of a single classifier also worksets), shapes.<id>, relations.<id>, labeler, marginals, resolution or
/// probability. \throw UsageError
void apply_override(PipelineManifest& pipeline, std::string_view setting, const PluginCatalog& catalog);

/// Command line `--labeler`: another labeler, with its defaults; the pipeline's own keeps its options.
/// \throw UsageError, PluginError
void set_labeler(PipelineManifest& pipeline, std::string_view id, const PluginCatalog& catalog);

}  // namespace toposcope
