// SPDX-License-Identifier: BSD-3-Clause
// Numbers of instances, and what cannot be asked of features that have several.

#include <charconv>

#include "model/model_reading.h"

namespace toposcope {
namespace {

constexpr Index most_instances = 1000;

/// A number from 0 to `most_instances`.
std::optional<Index> instances_in(std::string_view text) {
  Index number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (text.empty() || error != std::errc() || end != text.data() + text.size() || number > most_instances)
    return std::nullopt;
  return number;
}

/// What is wrong with it, and the remedy; empty: nothing.
std::string parse_count(const std::string& text, InstanceCount& count) {
  const std::size_t dots = text.find("..");
  const auto least = instances_in(std::string_view(text).substr(0, dots));
  const bool open = dots != std::string::npos && dots + 2 == text.size();
  const auto most = dots == std::string::npos ? least : instances_in(std::string_view(text).substr(dots + 2));
  if (!least || !(most || open))
    return "is neither a number nor a range of numbers up to " + std::to_string(most_instances) +
           "; write 4, 3..8, or 0.. for any number";
  if (most && *most < *least)
    return "is empty, " + std::to_string(*least) + " is more than " + std::to_string(*most) + "; write " +
           std::to_string(*most) + ".." + std::to_string(*least);
  if (most == Index{0}) return "allows no instance; remove the feature, or write 0.. for any number";
  count.least = *least;
  count.most = open ? std::nullopt : most;
  return {};
}

/// Checks one relationship.
class FamilyCheck {
 public:
  FamilyCheck(const Model& model, const Relationship& relationship, const YAML::Node& node, const ModelReading& reading)
      : model_(model), relationship_(relationship), node_(node["features"]), reading_(reading) {}

  void run() const {
    std::optional<std::size_t> family;  // place in the scope
    std::size_t times = 0;
    for (std::size_t i = 0; i < relationship_.features.size(); ++i) {
      if (!feature(i).count.family()) continue;
      if (!family) family = i;
      if (relationship_.features[i] != relationship_.features[*family])
        return add(i, "names two families, " + quoted(*family) + " and " + quoted(i) +
                          "; name one, and single features beside it");
      if (++times > 2)
        return add(
            i, "names family " + quoted(i) + " more than twice; once stands for each instance, twice for each pair");
    }
    if (times < 2 || !reading_.catalog) return;
    const PluginManifest* relation = reading_.catalog->find(PluginKind::relations, relationship_.plugin);
    if (relation && relation->ordered)
      add(*family, "asks relation '" + relationship_.plugin + "' of each pair of " + quoted(*family) +
                       ", which has an order, and instances have none; take a relation that is the same both ways");
  }

 private:
  const ModelFeature& feature(std::size_t i) const { return model_.features[relationship_.features[i]]; }
  std::string quoted(std::size_t i) const { return "'" + feature(i).name + "'"; }
  void add(std::size_t i, const std::string& message) const {
    reading_.add(node_[i], "relationship '" + relationship_.name + "' " + message);
  }

  const Model& model_;
  const Relationship& relationship_;
  const YAML::Node node_;
  const ModelReading& reading_;
};

void check_classes(const YAML::Node& root, const Model& model, const ModelReading& reading) {
  for (const ClassRule& rule : model.classes)
    for (const Index r : rule.relationships)
      for (const Index f : model.relationships[r].features) {
        if (!model.features[f].count.family()) continue;
        reading.add(root["classes"][rule.name],
                    "class '" + rule.name + "' asks for relationship '" + model.relationships[r].name +
                        "' of family '" + model.features[f].name +
                        "'; a class is told by features of which there is one each, give each instance a name");
        return;
      }
}

}  // namespace

void read_count(const YAML::Node& feature_node, const ModelReading& reading, ModelFeature& feature) {
  const YAML::Node count = feature_node["count"], required = feature_node["required"];
  const std::string owner = "feature '" + feature.name + "': ";
  if (count && required)
    reading.add(required, owner + "'required' and 'count' say the same thing; write 'count: 1..' for at least one");
  if (required && required.as<bool>()) feature.count = {1, 1};
  if (count)
    if (const std::string wrong = parse_count(count.Scalar(), feature.count); !wrong.empty()) {
      reading.add(count, owner + "count '" + count.Scalar() + "' " + wrong);
      feature.count.most.reset();  // whatever was meant, it was not one
    }
  if (feature.count.family() && !feature.second_look.empty())
    reading.add(feature_node["second_look"],
                owner + "a second look is for one feature that the first did not find; remove it, or the count");
}

void check_families(const YAML::Node& root, const Model& model, const ModelReading& reading) {
  if (!reading.errors.empty()) return;  // what was not read has no index
  for (const Relationship& relationship : model.relationships)
    FamilyCheck(model, relationship, root["relationships"][relationship.name], reading).run();
  check_classes(root, model, reading);
  for (const ModelMeasure& measure : model.measures)
    for (const Index f : measure.expression.features())
      if (model.features[f].count.family())
        reading.add(root["measures"][measure.name],
                    "measure '" + measure.name + "' names family '" + model.features[f].name +
                        "', of which there may be several; 'run --features FILE' writes the measures of each instance");
}

}  // namespace toposcope
