// SPDX-License-Identifier: BSD-3-Clause
#include <charconv>

#include "base/nearest_name.h"
#include "model/model_reading.h"
#include "model/model_words.h"
#include "plugin/option_check.h"

namespace toposcope {
namespace {

/// The number of segments in the dissertation's short form `lgrp3`.
std::string segments_of_short_form(const std::string& shape) {
  const bool is_short = shape.size() > 4 && shape.compare(0, 4, "lgrp") == 0 &&
                        shape.find_first_not_of("0123456789", 4) == std::string::npos;
  return is_short ? shape.substr(4) : "";
}

class FeatureReader {
 public:
  FeatureReader(const AbstractModel& abstract, const ModelReading& reading) : abstract_(abstract), reading_(reading) {}

  ModelFeature read(const YAML::Node& name, const YAML::Node& node) {
    ModelFeature feature;
    feature.name = name.Scalar();
    feature.where = reading_.at(name);
    read_object(node["realises"], feature);
    read_worksets(node["worksets"], feature.worksets);
    if (node["second_look"]) read_worksets(node["second_look"], feature.second_look);
    const std::vector<const PluginManifest*> shapes = read_shapes(node["shape"], feature);
    for (const PluginManifest* shape : shapes)
      if (shape) check_dimension(node["realises"], *shape, feature);
    if (node["ranges"])
      for (const auto& range : node["ranges"]) read_range(range.first, range.second, shapes, feature);
    if (const YAML::Node error = node["max_fit_error"]) read_max_fit_error(error, feature);
    if (const YAML::Node detectability = node["detectability"]) {
      const std::string& text = detectability.Scalar();  // the schema has seen a number
      std::from_chars(text.data(), text.data() + text.size(), feature.detectability);
    }
    read_count(node, reading_, feature);
    return feature;
  }

 private:
  void read_object(const YAML::Node& node, ModelFeature& feature) {
    if (!node) {
      if (!abstract_.objects.empty())
        reading_.errors.add(feature.where, "feature '" + feature.name +
                                               "' lacks 'realises'; name the abstract object that it realises");
      return;
    }
    feature.realises = node.Scalar();
    if (abstract_.objects.empty())
      reading_.add(node, "feature '" + feature.name + "' realises '" + feature.realises +
                             "', but the model has no objects; add them or remove 'realises'");
    else if (!index_of(abstract_.objects, feature.realises))
      reading_.add(node, "feature '" + feature.name + "' realises the unknown object '" + feature.realises + "'; " +
                             name_remedy(feature.realises, names_of(abstract_.objects)));
  }

  void read_worksets(const YAML::Node& node, std::vector<std::string>& types) {
    std::vector<std::string> known;
    if (reading_.catalog)
      for (const PluginManifest* plugin : reading_.catalog->all(PluginKind::worksets))
        for (const ProvidedRow& type : plugin->provides)
          if (std::find(known.begin(), known.end(), type.name) == known.end()) known.push_back(type.name);
    for (const YAML::Node& type : node) {
      types.push_back(type.Scalar());
      if (reading_.catalog && std::find(known.begin(), known.end(), type.Scalar()) == known.end())
        reading_.add(type, "no working-set plugin provides the type '" + type.Scalar() + "'; " +
                               name_remedy(type.Scalar(), known));
    }
  }

  /// One shape, or a list of alternatives. \return manifests; null of one that is unknown
  std::vector<const PluginManifest*> read_shapes(const YAML::Node& node, ModelFeature& feature) {
    if (!node.IsSequence()) return {read_shape(node, feature, feature.shape)};
    std::vector<const PluginManifest*> shapes;
    for (std::size_t k = 0; k < node.size(); ++k)
      shapes.push_back(read_shape(node[k], feature, k == 0 ? feature.shape : feature.other_shapes.emplace_back()));
    for (std::size_t k = 0; k < shapes.size(); ++k)
      for (std::size_t other = 0; other < k; ++other)
        if (shapes[k] && shapes[k] == shapes[other])
          reading_.add(node[k], "feature '" + feature.name + "' names shape '" + shapes[k]->id +
                                    "' twice; alternatives are different shapes, remove one");
    return shapes;
  }

  /// The shape's manifest; null when unknown.
  const PluginManifest* read_shape(const YAML::Node& node, const ModelFeature& feature, ShapeSpec& spec) {
    const YAML::Node id = node.IsMap() ? node["plugin"] : node;
    spec.plugin = id.Scalar();
    spec.where = reading_.at(id);
    if (const std::string segments = segments_of_short_form(spec.plugin); !segments.empty()) {
      spec.plugin = "line-group";
      spec.arguments.emplace_back("segments", segments);
    }
    const PluginManifest* shape = nullptr;
    if (reading_.catalog)
      reading_.attempt(
          id, [&] { shape = &reading_.catalog->require(PluginKind::shapes, spec.plugin, reading_.at(id).str()); });
    bool sound = shape != nullptr;
    const std::string owner = "shape '" + spec.plugin + "'";
    if (node.IsMap())
      for (const auto& argument : node) {
        const std::string& name = argument.first.Scalar();
        if (name == "plugin") continue;
        spec.arguments.emplace_back(name, argument.second.Scalar());
        // One by one, so that each error names its own place.
        if (shape)
          sound &= reading_.attempt(argument.second, [&] {
            check_option(shape->arguments, name, argument.second.Scalar(),
                         reading_.at(argument.second).str() + ": " + owner);
          });
      }
    if (sound)
      reading_.attempt(id, [&] { check_options(shape->arguments, spec.arguments, spec.where.str() + ": " + owner); });
    for (const std::vector<std::string>* types : {&feature.worksets, &feature.second_look})
      if (shape && !types->empty() && !arity_allows(shape->min_arity, shape->max_arity, types->size()))
        reading_.add(id, "feature '" + feature.name + "' gives " + owner + " " + std::to_string(types->size()) +
                             " working sets; it " + arity_in_words(shape->min_arity, shape->max_arity));
    return shape;
  }

  /// A surface does not realise a line.
  void check_dimension(const YAML::Node& node, const PluginManifest& shape, const ModelFeature& feature) {
    const auto object = index_of(abstract_.objects, feature.realises);
    if (!object || abstract_.objects[*object].dimension == shape.dimension) return;
    reading_.add(node, "feature '" + feature.name + "' realises '" + feature.realises + "', which is a " +
                           object_kind(abstract_.objects[*object].dimension) + ", by shape '" + shape.id +
                           "', which is a " + object_kind(shape.dimension) +
                           "; name an object of that dimension, or another shape");
  }

  /// \param shapes  of which one must have the measure
  void read_range(const YAML::Node& name, const YAML::Node& node, const std::vector<const PluginManifest*>& shapes,
                  ModelFeature& feature) {
    Range range;
    range.measure = name.Scalar();
    range.where = reading_.at(node);
    int dimension = any_dimension;
    std::vector<std::string> known, ids;
    bool all_known = true;
    for (const PluginManifest* shape : shapes) {
      all_known = all_known && shape;
      if (!shape) continue;
      ids.push_back(shape->id);
      for (const ProvidedRow& each : shape->provides) known.push_back(each.name);
      if (const ProvidedRow* measure = shape->find_provided(range.measure)) dimension = measure->dimension;
    }
    if (all_known && dimension == any_dimension)
      reading_.add(name, "shape '" + ids.front() + "' has no measure '" + range.measure + "'; " +
                             name_remedy(range.measure, known));
    const bool read = reading_.attempt(node, [&] {
      const ParsedRange parsed = parse_range(node.Scalar(), range.where, dimension);
      range.low = parsed.low;
      range.high = parsed.high;
    });
    if (read) feature.ranges.push_back(range);
  }

  void read_max_fit_error(const YAML::Node& node, ModelFeature& feature) {
    reading_.attempt(node, [&] { feature.max_fit_error = Expression::parse(node.Scalar(), reading_.at(node)); });
    if (feature.max_fit_error && feature.max_fit_error->dimension() != 1)
      reading_.add(node, "max_fit_error '" + feature.max_fit_error->text() + "' is " +
                             dimension_in_words(feature.max_fit_error->dimension()) +
                             ", but must be a length, as in bb(O).a/20");
  }

  const AbstractModel& abstract_;
  const ModelReading& reading_;
};

}  // namespace

std::vector<ModelFeature> read_features(const YAML::Node& root, const AbstractModel& abstract,
                                        const ModelReading& reading) {
  FeatureReader reader(abstract, reading);
  std::vector<ModelFeature> features;
  if (!root["features"]) return features;
  for (const auto& entry : root["features"]) features.push_back(reader.read(entry.first, entry.second));
  return features;
}

bool arity_allows(std::uint32_t min, std::uint32_t max, std::size_t count) {
  return count >= min && (max == 0 || count <= max);
}

std::string arity_in_words(std::uint32_t min, std::uint32_t max) {
  const std::string low = std::to_string(min);
  if (max == 0) return "takes " + low + " or more";
  return "takes " + (min == max ? low : low + " to " + std::to_string(max));
}

}  // namespace toposcope
