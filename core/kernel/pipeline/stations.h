// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "model/model.h"
#include "pipeline/resolution.h"
#include "plugin/manifest.h"
#include "plugin/option_check.h"
#include "probability/likelihood.h"
#include "toposcope/filters.h"
#include "toposcope/labeling.h"
#include "toposcope/options.h"
#include "toposcope/relations.h"
#include "toposcope/shapes.h"
#include "toposcope/worksets.h"

namespace toposcope {

class PluginHost;
struct PipelineManifest;

/// A plugin at work in a run, as result.json reports it.
struct PluginUse {
  std::string kind, id, version;
  std::vector<std::pair<std::string, std::string>> options;
};

/// \param options  checked
PluginUse use_of(const PluginManifest& manifest, const std::vector<OptionValue>& options);

struct FilterStation {
  std::string id;
  std::shared_ptr<const MeshFilter> plugin;
  PluginUse use = {};
};

struct WorkingSetStation {
  std::string id;
  std::vector<std::string> types;  ///< that the plugin provides
  std::shared_ptr<const WorkingSetClassifier> plugin;
};

/// What fits one shape of a model feature.
struct ShapeStation {
  std::shared_ptr<const ShapeFitter> fitter;
  std::vector<OptionValue> arguments;  ///< what the model says of the shape, checked
  std::string plugin;                  ///< id
  int dimension = -1;                  ///< of its shapes
};

/// What fits the shapes of one model feature: more than one where they are alternatives.
struct FeatureStation : ShapeStation {
  std::vector<ShapeStation> others;

  std::size_t shape_count() const { return 1 + others.size(); }
  const ShapeStation& shape(std::size_t k) const { return k == 0 ? *this : others[k - 1]; }
  /// The station that has made a shape.
  const ShapeStation& of_plugin(std::string_view id) const {
    for (const ShapeStation& other : others)
      if (other.plugin == id) return other;
    return *this;
  }
};

/// What tests one relationship of the model.
struct RelationshipStation {
  std::shared_ptr<const RelationTester> tester;
  std::vector<OptionValue> defaults;      ///< of the arguments that have one: the model's expressions await the mesh
  std::string unit;                       ///< of the residual: "deg" or "length"
  bool ordered = false;                   ///< it matters which feature comes first
  std::vector<OptionRow> arguments = {};  ///< as the plugin declares them
};

struct LabelerStation {
  std::string id;
  std::shared_ptr<const Labeler> plugin;
};

/// The plugins that serve a model's run, created with their options.
struct Stations {
  Resolution resolution{};
  std::vector<FilterStation> filters;
  std::vector<WorkingSetStation> working_sets;     ///< in the order of the pipeline
  std::vector<FeatureStation> features;            ///< one per model feature; the same shape is the same object
  std::vector<RelationshipStation> relationships;  ///< one per model relationship; likewise
  LabelerStation labeler;
  std::optional<LabelerStation> marginals;  ///< nothing: the labeler's own probabilities are reported
  ProbabilityModel probability{};
  std::vector<PluginUse> uses;  ///< each plugin once, in the order of the path
};

/// A filter of options as a user wrote them.
/// \param owner  for messages: who asks for it
/// \throw UsageError  unknown filter or option, value out of range; PluginError  it cannot be loaded or made
FilterStation make_filter(PluginHost& host, std::string_view id, std::span<const GivenOption> given,
                          const std::string& owner);
/// The same of options that are checked already.
FilterStation make_filter(PluginHost& host, std::string_view id, const std::vector<OptionValue>& options);

/// \throw UsageError  a feature of the model asks for working sets that no classifier of the pipeline makes
void check_types(const Model& model, const PipelineManifest& pipeline, const PluginCatalog& catalog);

/// Loads what pipeline and model need. \throw PluginError, UsageError
Stations make_stations(PluginHost& host, const PipelineManifest& pipeline, const Model& model);

}  // namespace toposcope
