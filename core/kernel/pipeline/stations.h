// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "model/model.h"
#include "probability/likelihood.h"
#include "toposcope/filters.h"
#include "toposcope/labeling.h"
#include "toposcope/relations.h"
#include "toposcope/shapes.h"
#include "toposcope/worksets.h"

namespace toposcope {

class PluginHost;
struct PipelineManifest;
struct PluginManifest;

/// A plugin at work in a run, as result.json reports it.
struct PluginUse {
  std::string kind, id, version;
  std::vector<std::pair<std::string, std::string>> options;
};

/// The plugins that serve a model's run, created with their options.
struct Stations {
  struct Filter {
    std::string id;
    std::shared_ptr<const MeshFilter> plugin;
  };
  std::vector<Filter> filters;
  std::string worksets_id;
  std::vector<std::string> workset_types;
  std::shared_ptr<const WorkingSetClassifier> worksets;
  std::map<std::string, std::shared_ptr<const ShapeFitter>> shapes;
  std::map<std::string, std::shared_ptr<const RelationTester>> relations;
  std::string labeler_id;
  std::shared_ptr<const Labeler> labeler;
  std::string marginals_id;                  ///< empty: the labeler's own probabilities are reported
  std::shared_ptr<const Labeler> marginals;  ///< null with it

  ProbabilityModel probability{};

  /// One entry per model feature / relationship: the checked values of its shape's arguments, and the manifest defaults
  /// of its relation's arguments (the model's expressions are evaluated per mesh).
  std::vector<std::vector<OptionValue>> shape_arguments;
  std::vector<std::vector<OptionValue>> relation_defaults;
  std::vector<std::string> relation_units;  ///< of the residual, per relationship
  std::vector<bool> relation_ordered;       ///< per relationship: it matters which feature comes first

  std::vector<PluginUse> uses;
};

/// \param options  checked
PluginUse use_of(const PluginManifest& manifest, const std::vector<OptionValue>& options);

/// Loads what pipeline and model need. \throw PluginError, UsageError
Stations make_stations(PluginHost& host, const PipelineManifest& pipeline, const Model& model);

}  // namespace toposcope
