// SPDX-License-Identifier: BSD-3-Clause
#include <charconv>

#include "base/nearest_name.h"
#include "model/model_reading.h"
#include "plugin/option_check.h"

namespace toposcope {
namespace {

/// What the table asks of an argument's value: its dimension and, where no box decides, its bounds.
void check_argument(const OptionRow& row, const Expression& value, const YAML::Node& node, const std::string& owner,
                    const ModelReading& reading) {
  const int dimension = row.unit == "length" ? 1 : 0;
  if (value.uses_worksets())
    return reading.add(
        node, owner + ": '" + value.text() + "' names bb(w), but a relationship spans several features; use bb(O)");
  if (!value.fits(dimension))
    return reading.add(node, owner + ": '" + row.name + "' is " + dimension_in_words(dimension) + ", but '" +
                                 value.text() + "' is " + dimension_in_words(value.dimension()));
  if (value.uses_object()) return;
  const double number = value.evaluate({});
  reading.attempt(node, [&] {
    // The shortest text that reads back as the same number.
    char buffer[32];
    const auto end = std::to_chars(buffer, buffer + sizeof buffer, number).ptr;
    check_option({&row, 1}, row.name, {buffer, end}, reading.at(node).str() + ": " + owner);
  });
}

void read_argument(const YAML::Node& name, const YAML::Node& node, const PluginManifest* relation,
                   const std::string& owner, const ModelReading& reading, Relationship& relationship) {
  const OptionRow* row = nullptr;
  if (relation) {
    for (const OptionRow& candidate : relation->arguments)
      if (candidate.name == name.Scalar()) row = &candidate;
    std::vector<std::string> known = names_of(relation->arguments);
    known.push_back("tolerance");  // which every relationship takes
    if (!row)
      return reading.add(name,
                         owner + " has no argument '" + name.Scalar() + "'; " + name_remedy(name.Scalar(), known));
  }
  std::string text = node.Scalar();
  if (row && row->type == OptionType::text) {
    reading.attempt(node, [&] {
      check_option({row, 1}, row->name, text, reading.at(node).str() + ": " + owner);
      relationship.words.emplace_back(row->name, text);
    });
    return;
  }
  const bool is_boolean = text == "true" || text == "false";
  if (row && row->type == OptionType::boolean && !is_boolean)
    return reading.add(node, owner + ": '" + row->name + "' is '" + text + "'; write true or false");
  if (is_boolean) text = text == "true" ? "1" : "0";
  std::optional<Expression> value;
  reading.attempt(node, [&] { value = Expression::parse(text, reading.at(node)); });
  if (!value) return;
  if (row && row->type != OptionType::boolean) check_argument(*row, *value, node, owner, reading);
  relationship.arguments.emplace_back(name.Scalar(), *value);
}

/// `tolerance`, which every relationship may set.
void read_tolerance(const YAML::Node& node, const PluginManifest* relation, const std::string& owner,
                    const ModelReading& reading, Relationship& relationship) {
  reading.attempt(node, [&] { relationship.tolerance = Expression::parse(node.Scalar(), reading.at(node)); });
  if (!relationship.tolerance) return;
  const std::string minimum = "0.000001";  // of either unit: a tolerance of 0 is never met
  const std::string unit = relation ? relation->unit : relationship.tolerance->dimension() == 1 ? "length" : "deg";
  const OptionRow row{"tolerance",
                      OptionType::real,
                      unit,
                      "",
                      relationship.tolerance->uses_object() ? "" : minimum,
                      "",
                      "largest residual at which the relationship counts as satisfied"};
  check_argument(row, *relationship.tolerance, node, owner, reading);
}

void read_scope(const YAML::Node& node, const std::vector<ModelFeature>& features, const ModelReading& reading,
                Relationship& relationship) {
  for (const YAML::Node& name : node) {
    const auto feature = index_of(features, name.Scalar());
    if (!feature) {
      reading.add(name, "relationship '" + relationship.name + "' names the unknown feature '" + name.Scalar() + "'; " +
                            name_remedy(name.Scalar(), names_of(features)));
    } else if (!features[*feature].count.family() &&
               std::find(relationship.features.begin(), relationship.features.end(), *feature) !=
                   relationship.features.end()) {
      reading.add(name, "relationship '" + relationship.name + "' names feature '" + name.Scalar() +
                            "' twice, of which there is at most one; a relationship holds between different features");
    } else {
      relationship.features.push_back(*feature);
    }
  }
}

Relationship read_relationship(const YAML::Node& name, const YAML::Node& node,
                               const std::vector<ModelFeature>& features, const ModelReading& reading) {
  Relationship relationship;
  relationship.name = name.Scalar();
  relationship.where = reading.at(name);
  relationship.plugin = node["type"].Scalar();
  read_scope(node["features"], features, reading, relationship);

  const PluginManifest* relation = nullptr;
  if (reading.catalog)
    reading.attempt(node["type"], [&] {
      relation = &reading.catalog->require(PluginKind::relations, relationship.plugin, reading.at(node["type"]).str());
    });
  const std::string owner = "relation '" + relationship.plugin + "'";
  if (relation && !arity_allows(relation->min_arity, relation->max_arity, node["features"].size()))
    reading.add(node["features"], "relationship '" + relationship.name + "' gives " + owner + " " +
                                      std::to_string(node["features"].size()) + " features; it " +
                                      arity_in_words(relation->min_arity, relation->max_arity));
  for (const auto& argument : node) {
    const std::string& key = argument.first.Scalar();
    if (key == "features" || key == "type") continue;
    if (key == "tolerance") {
      read_tolerance(argument.second, relation, owner, reading, relationship);
      continue;
    }
    read_argument(argument.first, argument.second, relation, owner, reading, relationship);
  }
  if (relation)
    for (const OptionRow& row : relation->arguments)
      if (row.default_value.empty() && !node[row.name])
        reading.add(name, "relationship '" + relationship.name + "' lacks '" + row.name + "', which " + owner +
                              " needs; add it: " + row.meaning);
  return relationship;
}

}  // namespace

std::vector<Relationship> read_relationships(const YAML::Node& root, const std::vector<ModelFeature>& features,
                                             const ModelReading& reading) {
  std::vector<Relationship> relationships;
  if (root["relationships"])
    for (const auto& entry : root["relationships"])
      relationships.push_back(read_relationship(entry.first, entry.second, features, reading));
  return relationships;
}

std::vector<ClassRule> read_classes(const YAML::Node& root, const std::vector<Relationship>& relationships,
                                    const ModelReading& reading) {
  std::vector<ClassRule> classes;
  if (!root["classes"]) return classes;
  for (const auto& entry : root["classes"]) {
    ClassRule rule{entry.first.Scalar(), {}, reading.at(entry.first)};
    for (const YAML::Node& name : entry.second) {
      const auto relationship = index_of(relationships, name.Scalar());
      if (!relationship)
        reading.add(name, "class '" + rule.name + "' names the unknown relationship '" + name.Scalar() + "'; " +
                              name_remedy(name.Scalar(), names_of(relationships)));
      else if (std::find(rule.relationships.begin(), rule.relationships.end(), *relationship) !=
               rule.relationships.end())
        reading.add(name, "class '" + rule.name + "' names relationship '" + name.Scalar() + "' twice; remove one");
      else
        rule.relationships.push_back(*relationship);
    }
    std::sort(rule.relationships.begin(), rule.relationships.end());
    for (const ClassRule& other : classes)
      if (other.relationships == rule.relationships && reading.errors.empty())
        reading.add(entry.first, "class '" + rule.name + "' asks for the same relationships as class '" + other.name +
                                     "'; no mesh could tell them apart, change one");
    classes.push_back(rule);
  }
  return classes;
}

}  // namespace toposcope
