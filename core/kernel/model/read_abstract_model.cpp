// SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <string_view>
#include <utility>

#include "base/nearest_name.h"
#include "model/model_reading.h"
#include "model/networks.h"

namespace toposcope {
namespace {

constexpr std::array<std::string_view, 4> dimension_words = {"point", "line", "surface", "volume"};

std::string described(const SpatialObject& object) {
  return "'" + object.name + "' (" + std::string(dimension_words[static_cast<std::size_t>(object.dimension)]) + ")";
}

class AbstractReader {
 public:
  AbstractReader(const YAML::Node& root, const ModelReading& reading) : root_(root), reading_(reading) {}

  AbstractModel read() {
    read_objects();
    read_network("topology", "bounded-by", model_.topology);
    read_network("parts", "has-part", model_.parts);
    read_associations();
    refuse_cycle(model_.parts, "has-part", "nothing is part of itself");
    for (const std::string_view direction : {"up", "front", "right"}) refuse_direction_cycle(direction);
    // Links that were refused would leave objects hanging that the author has linked.
    if (reading_.errors.empty()) find_root();
    return std::move(model_);
  }

 private:
  void read_objects() {
    if (!root_["objects"]) return;
    for (const auto& entry : root_["objects"]) {
      const auto word = std::find(dimension_words.begin(), dimension_words.end(), entry.second.Scalar());
      model_.objects.push_back(
          {entry.first.Scalar(), static_cast<int>(word - dimension_words.begin()), reading_.at(entry.first)});
    }
  }

  std::optional<Index> object(const YAML::Node& node) {
    const std::optional<Index> index = index_of(model_.objects, node.Scalar());
    if (!index)
      reading_.add(node, "there is no object '" + node.Scalar() + "' under objects; " +
                             name_remedy(node.Scalar(), names_of(model_.objects)));
    return index;
  }

  void read_network(const char* key, const char* kind, std::vector<Link>& network) {
    if (!root_[key]) return;
    for (const auto& entry : root_[key]) {
      const auto from = object(entry.first);
      for (const YAML::Node& target : entry.second) {
        const auto to = object(target);
        if (from && to) add_link(network, {*from, *to, kind, reading_.at(target)});
      }
    }
  }

  void read_associations() {
    if (!root_["associations"]) return;
    for (const YAML::Node& entry : root_["associations"]) {
      const auto from = object(entry["from"]);
      for (const auto& link : entry) {
        if (link.first.Scalar() == "from") continue;
        const auto to = object(link.second);
        if (from && to) add_link(model_.associations, {*from, *to, link.first.Scalar(), reading_.at(link.second)});
      }
    }
  }

  void add_link(std::vector<Link>& network, const Link& link) {
    const SpatialObject &from = model_.objects[link.from], &to = model_.objects[link.to];
    const auto refuse = [&](const std::string& why) { reading_.errors.add(link.where, why); };
    if (link.kind == "bounded-by" && to.dimension != from.dimension - 1) {
      if (from.dimension == 0) return refuse(described(from) + " has no boundary: it is a point; remove the link");
      return refuse(described(from) + " cannot be bounded by " + described(to) + "; a " +
                    std::string(dimension_words[static_cast<std::size_t>(from.dimension)]) + " is bounded by a " +
                    std::string(dimension_words[static_cast<std::size_t>(from.dimension - 1)]));
    }
    if (link.kind == "has-part" && to.dimension != from.dimension)
      return refuse(described(from) + " cannot have " + described(to) +
                    " as its part; whole and part have the same dimension");
    if (link.from == link.to && link.kind != "has-part")
      return refuse("'" + from.name + "' cannot be " + link.kind + " of itself; name another object");
    for (const Link& other : network) {
      const bool same = other.from == link.from && other.to == link.to && other.kind == link.kind;
      const bool inverse = other.from == link.to && other.to == link.from && other.kind == inverse_of(link.kind);
      if (same || inverse)
        return refuse("'" + from.name + "' " + link.kind + " '" + to.name + "' follows from line " +
                      std::to_string(other.where.line) + " already; remove one of them");
    }
    network.push_back(link);
  }

  void refuse_cycle(const std::vector<Link>& links, const std::string& kind, const std::string& why) {
    const std::vector<Index> cycle = find_cycle(static_cast<Index>(model_.objects.size()), links);
    if (cycle.empty()) return;
    std::string shown;
    for (const Index index : cycle) shown += "'" + model_.objects[index].name + "' " + kind + " ";
    shown += "'" + model_.objects[cycle[0]].name + "'";
    const Index closing = cycle.back();
    for (const Link& link : links)
      if (link.from == closing && link.to == cycle[0])
        return reading_.errors.add(link.where, "cycle: " + shown + "; " + why + ", remove one of these links");
  }

  /// Up along the links written so and those written the other way round as down.
  void refuse_direction_cycle(std::string_view direction) {
    std::vector<Link> links;
    for (Link link : model_.associations) {
      if (link.kind == inverse_of(direction))
        std::swap(link.from, link.to);
      else if (link.kind != direction)
        continue;
      links.push_back(link);
    }
    refuse_cycle(links, std::string(direction), "nothing lies " + std::string(direction) + " of itself");
  }

  void find_root() {
    std::vector<bool> is_below(model_.objects.size(), false);
    for (const auto* network : {&model_.topology, &model_.parts})
      for (const Link& link : *network) is_below[link.to] = true;
    std::vector<Index> roots;
    for (Index i = 0; i < model_.objects.size(); ++i)
      if (!is_below[i]) roots.push_back(i);
    if (roots.empty()) return;
    model_.root = roots[0];
    for (std::size_t i = 1; i < roots.size(); ++i)
      reading_.errors.add(model_.objects[roots[i]].where,
                          "a second root, '" + model_.objects[roots[i]].name + "' beside '" +
                              model_.objects[roots[0]].name +
                              "', which is part of nothing and bounds nothing either; link it under parts or topology");
  }

  const YAML::Node& root_;
  const ModelReading& reading_;
  AbstractModel model_;
};

}  // namespace

AbstractModel read_abstract_model(const YAML::Node& root, const ModelReading& reading) {
  return AbstractReader(root, reading).read();
}

}  // namespace toposcope
