// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The steps of read_model, for documents that have passed the schema.

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "model/error_list.h"
#include "model/model.h"
#include "model/yaml_schema.h"
#include "plugin/catalog.h"

namespace toposcope {

struct ModelReading {
  const std::string& file;
  const PluginCatalog* catalog;  ///< may be null
  ErrorList& errors;

  SourceLocation at(const YAML::Node& node) const { return location_of(node, file); }

  void add(const YAML::Node& node, const std::string& message) const { errors.add(at(node), message); }

  /// Runs `read`; the UsageError that it throws names its place itself.
  template <class Read>
  bool attempt(const YAML::Node& node, const Read& read) const {
    try {
      read();
      return true;
    } catch (const UsageError& error) {
      errors.add_located(at(node), error.what());
      return false;
    }
  }
};

template <class Named>
std::vector<std::string> names_of(const std::vector<Named>& items) {
  std::vector<std::string> names;
  for (const Named& item : items) names.push_back(item.name);
  return names;
}

template <class Named>
std::optional<Index> index_of(const std::vector<Named>& items, const std::string& name) {
  const auto item = std::find_if(items.begin(), items.end(), [&](const Named& i) { return i.name == name; });
  if (item == items.end()) return std::nullopt;
  return static_cast<Index>(item - items.begin());
}

AbstractModel read_abstract_model(const YAML::Node& root, const ModelReading& reading);
/// \param abstract  has no objects when the model has no abstract part
std::vector<ModelFeature> read_features(const YAML::Node& root, const AbstractModel& abstract,
                                        const ModelReading& reading);
std::vector<Relationship> read_relationships(const YAML::Node& root, const std::vector<ModelFeature>& features,
                                             const ModelReading& reading);
std::vector<ClassRule> read_classes(const YAML::Node& root, const std::vector<Relationship>& relationships,
                                    const ModelReading& reading);
std::vector<ModelMeasure> read_measures(const YAML::Node& root, const std::vector<ModelFeature>& features,
                                        const ModelReading& reading);
std::vector<AxisFeatures> read_axes(const YAML::Node& root, const std::vector<ModelFeature>& features,
                                    const ModelReading& reading);

/// Relationships that put features in an order along a direction of the object (`above`, `between`), against the
/// directions of the abstract part.
void refuse_contrary_orders(const Model& model, const ModelReading& reading);

/// Adds the relationships that follow from the abstract part, and to each class those over its features. What a
/// written relationship of places says of the same features it overrules; `implied:` says which links imply any.
void add_implied(const YAML::Node& root, const ModelReading& reading, Model& model);

/// `count: 4 | 3..8 | 0..` and `required: true`, which is `count: 1`.
void read_count(const YAML::Node& feature_node, const ModelReading& reading, ModelFeature& feature);

/// What relationships, classes and measures cannot ask of families.
void check_families(const YAML::Node& root, const Model& model, const ModelReading& reading);

/// "takes 1", "takes 2 or more", "takes 1 to 3"; \param max  0: no upper bound
std::string arity_in_words(std::uint32_t min, std::uint32_t max);
bool arity_allows(std::uint32_t min, std::uint32_t max, std::size_t count);

}  // namespace toposcope
