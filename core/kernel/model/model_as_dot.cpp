// SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <initializer_list>
#include <string_view>
#include <utility>

#include "model/model_words.h"
#include "model/show_model.h"

namespace toposcope {
namespace {

/// A DOT string: quoted; what DOT takes for an escape or the end of the string is escaped, a new line is written \n.
std::string dot_string(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    if (c == '\n')
      out += "\\n";
    else
      out += c;
  }
  return out + "\"";
}

using Attributes = std::initializer_list<std::pair<const char*, std::string>>;

std::string listed(const Attributes& attributes) {
  std::string out = " [";
  for (const auto& [name, value] : attributes) out += (out.size() > 2 ? ", " : "") + (name + ("=" + dot_string(value)));
  return out + "];\n";
}

std::string node_name(const std::string& cluster, Index number) {
  return cluster + "_" + std::to_string(number);
}

class DotWriter {
 public:
  explicit DotWriter(const Model& model) : model_(model), drawn_in_(model.abstract.objects.size()) {}

  std::string write() {
    out_ = "digraph " + dot_string(model_.name) + " {\n";
    std::string title = model_.name;
    if (!model_.summary.empty()) title += ": " + model_.summary;
    if (!model_.citation.empty()) title += "\n" + model_.citation;
    out_ += "  graph" + listed({{"label", title},
                                {"labelloc", "t"},
                                {"fontname", "Helvetica"},
                                {"fontsize", "16"},
                                {"rankdir", "TB"},
                                {"nodesep", "0.3"},
                                {"ranksep", "0.5"}});
    out_ += "  node" + listed({{"fontname", "Helvetica"}, {"fontsize", "11"}, {"style", "filled"}});
    out_ += "  edge" + listed({{"fontname", "Helvetica"}, {"fontsize", "9"}, {"color", "#666666"}});
    if (!model_.abstract.objects.empty()) {
      // Topology comes first: it is where a feature meets its object, if it can.
      write_network("topology", "Topology: bounded-by", model_.abstract.topology);
      write_network("parts", "Part-whole: has-part", model_.abstract.parts);
      write_network("associations", "Spatial associations", model_.abstract.associations);
    }
    if (!model_.features.empty()) write_working_model();
    write_realisations();
    return out_ + "}\n";
  }

 private:
  void begin_cluster(const std::string& name, const std::string& label, const std::string& color) {
    out_ += "  subgraph " + dot_string("cluster_" + name) + " {\n";
    out_ += "    graph" + listed({{"label", label},
                                  {"style", "rounded,filled"},
                                  {"color", "#bbbbbb"},
                                  {"fillcolor", color},
                                  {"fontsize", "13"}});
  }

  void write_network(const std::string& cluster, const std::string& label, const std::vector<Link>& links) {
    std::vector<bool> occurs(drawn_in_.size(), false);
    for (const Link& link : links) occurs[link.from] = occurs[link.to] = true;
    // The root of a model without links would stand nowhere.
    if (cluster == "parts") occurs[model_.abstract.root] = true;
    if (links.empty() && cluster != "parts") return;
    begin_cluster(cluster, label, "#fafafa");
    for (Index object = 0; object < occurs.size(); ++object) {
      if (!occurs[object]) continue;
      write_object(cluster, object);
      if (drawn_in_[object].empty()) drawn_in_[object] = cluster;
    }
    for (const Link& link : links) {
      const bool mutual = link.kind == "adjacent-to";
      out_ += "    " + node_name(cluster, link.from) + " -> " + node_name(cluster, link.to);
      if (cluster != "associations")
        out_ += ";\n";
      else
        out_ += listed({{"label", "  " + link.kind + (mutual ? "  " : " of  ")}, {"dir", mutual ? "none" : "forward"}});
    }
    out_ += "  }\n";
  }

  void write_object(const std::string& cluster, Index object) {
    static constexpr std::array<const char*, 4> shapes = {"octagon", "ellipse", "box", "box3d"};
    static constexpr std::array<const char*, 4> colors = {"#ffffff", "#fde7c4", "#d9ecd3", "#cfe0f3"};
    const SpatialObject& spatial = model_.abstract.objects[object];
    const auto dimension = static_cast<std::size_t>(spatial.dimension);
    out_ += "    " + node_name(cluster, object) +
            listed({{"label", spatial.name},
                    {"shape", shapes[dimension]},
                    {"fillcolor", colors[dimension]},
                    {"tooltip", object_kind(spatial.dimension)}});
  }

  void write_working_model() {
    begin_cluster("working", "Working model: features and relationships", "#f4f1fa");
    for (Index f = 0; f < model_.features.size(); ++f) {
      const ModelFeature& feature = model_.features[f];
      std::string label = feature.name + "\n" + shapes_in_words(feature) + " on " + worksets_in_words(feature);
      for (const Range& range : feature.ranges) label += "\n" + range_in_words(range);
      if (feature.max_fit_error) label += "\nfit error < " + feature.max_fit_error->text();
      label += "\ndetectability " + number_in_words(feature.detectability);
      out_ += "    " + node_name("feature", f) +
              listed({{"label", label}, {"shape", "box"}, {"style", "rounded,filled"}, {"fillcolor", "#e2d8f3"}});
    }
    for (Index r = 0; r < model_.relationships.size(); ++r) {
      const Relationship& relationship = model_.relationships[r];
      std::string label = relationship.name + ": " + relationship.plugin;
      if (const std::string arguments = arguments_in_words(relationship); !arguments.empty()) label += "\n" + arguments;
      const bool follows = !relationship.because.empty();
      if (follows) label += "\n" + relationship.because;
      out_ += "    " + node_name("relationship", r) +
              listed({{"label", label},
                      {"shape", "box"},
                      {"style", follows ? "dashed,filled" : "filled"},
                      {"fillcolor", "#ffffff"},
                      {"fontsize", "10"}});
      for (const Index feature : relationship.features)
        out_ +=
            "    " + node_name("feature", feature) + " -> " + node_name("relationship", r) + listed({{"dir", "none"}});
    }
    if (!model_.classes.empty()) write_classes();
    out_ += "  }\n";
  }

  /// One box under the relationships, a line for each class.
  void write_classes() {
    std::string label = "classes";
    for (const ClassRule& rule : model_.classes) {
      label += "\n" + rule.name + ":";
      for (const Index relationship : rule.relationships) label += " " + model_.relationships[relationship].name;
    }
    out_ += "    classes" + listed({{"label", label}, {"shape", "note"}, {"fillcolor", "#ffffff"}});
    for (Index r = 0; r < model_.relationships.size(); ++r)
      out_ += "    " + node_name("relationship", r) + " -> classes" + listed({{"style", "invis"}});
  }

  void write_realisations() {
    for (Index f = 0; f < model_.features.size(); ++f)
      for (Index object = 0; object < drawn_in_.size(); ++object)
        if (model_.abstract.objects[object].name == model_.features[f].realises)
          out_ += "  " + node_name(drawn_in_[object], object) + " -> " + node_name("feature", f) +
                  listed({{"label", "realised by"}, {"style", "dashed"}, {"color", "#6a4fb0"}, {"arrowhead", "empty"}});
  }

  const Model& model_;
  std::vector<std::string> drawn_in_;  ///< for each object, the first cluster that shows it
  std::string out_;
};

}  // namespace

std::string model_as_dot(const Model& model) {
  return DotWriter(model).write();
}

}  // namespace toposcope
