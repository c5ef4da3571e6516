// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <set>
#include <string_view>
#include <utility>

#include "base/nearest_name.h"
#include "model/model_reading.h"
#include "model/networks.h"
#include "model/reasoning.h"

namespace toposcope {
namespace {

/// "bottom bounded-by edge, line 12"
std::string link_in_words(const AbstractModel& abstract, const Link& link) {
  return abstract.objects[link.from].name + " " + link.kind + " " + abstract.objects[link.to].name + ", line " +
         std::to_string(link.where.line);
}

/// Features by the object that they realise.
std::vector<std::vector<Index>> realisers_of(const Model& model) {
  std::vector<std::vector<Index>> realisers(model.abstract.objects.size());
  for (Index f = 0; f < model.features.size(); ++f)
    if (const auto object = index_of(model.abstract.objects, model.features[f].realises))
      realisers[*object].push_back(f);
  return realisers;
}

class Implier {
 public:
  Implier(const YAML::Node& root, const ModelReading& reading, Model& model)
      : reading_(reading), model_(model), realisers_(realisers_of(model)), written_(model.relationships.size()) {
    const YAML::Node node = root["implied"];
    all_ = !node || (node.IsScalar() && node.Scalar() == "true");
    if (node && node.IsSequence())
      for (const YAML::Node& kind : node) kinds_.insert(kind.Scalar());
  }

  void imply() {
    const AbstractModel& abstract = model_.abstract;
    if (asked("bounded-by"))
      for (const Link& link : abstract.topology)
        for_pairs(link, [&](Index whole, Index line) { add("adjacent", {line, whole}, words(link)); });
    if (asked("has-part")) {
      for (const Link& link : abstract.parts)
        for_pairs(link, [&](Index whole, Index part) { add("inside", {part, whole}, words(link)); });
      imply_two_parts();
    }
    if (asked("adjacent-to"))
      for (const Link& link : abstract.associations)
        if (link.kind == "adjacent-to")
          for_pairs(link, [&](Index a, Index b) { add("adjacent", {a, b}, words(link)); });
    for (const char* direction : {"up", "front", "right"})
      if (asked(direction)) imply_order(direction);
    for (ClassRule& rule : model_.classes) extend(rule);
  }

 private:
  bool asked(const std::string& kind) const { return all_ || kinds_.contains(kind); }
  std::string words(const Link& link) const { return link_in_words(model_.abstract, link); }

  template <class Body>
  void for_pairs(const Link& link, const Body& body) const {
    for (const Index a : realisers_[link.from])
      for (const Index b : realisers_[link.to])
        if (a != b) body(a, b);
  }

  /// Of a whole in two parts these touch.
  void imply_two_parts() {
    std::vector<std::vector<const Link*>> parts(model_.abstract.objects.size());
    for (const Link& link : model_.abstract.parts) parts[link.from].push_back(&link);
    for (const std::vector<const Link*>& both : parts) {
      if (both.size() != 2 || !realisers_[both[0]->from].empty()) continue;
      for (const Index a : realisers_[both[0]->to])
        for (const Index b : realisers_[both[1]->to])
          add("adjacent", {a, b}, words(*both[0]) + ", and its one other part");
    }
  }

  /// The objects with features, each next to those that it lies `direction` of with none between.
  void imply_order(std::string_view direction) {
    const auto count = static_cast<Index>(model_.abstract.objects.size());
    std::vector<std::vector<Index>> below(count);
    for (Index a = 0; a < count; ++a) {
      if (realisers_[a].empty()) continue;
      for (const Consequence& each : consequences(model_.abstract, a, direction))
        if (!realisers_[each.object].empty()) below[a].push_back(each.object);
    }
    std::vector<std::vector<Index>> next(count), before(count);
    for (Index a = 0; a < count; ++a)
      for (const Index b : below[a]) {
        const bool between = std::any_of(below[a].begin(), below[a].end(), [&](Index m) {
          return std::find(below[m].begin(), below[m].end(), b) != below[m].end();
        });
        if (between) continue;
        next[a].push_back(b);
        before[b].push_back(a);
      }
    for (Index middle = 0; middle < count; ++middle) {
      for (const Index upper : before[middle])
        for (const Index lower : next[middle]) add_order("between", {middle, lower, upper}, direction);
      add_fan(middle, before[middle], direction);
      add_fan(middle, next[middle], direction);
    }
  }

  /// What lies one way of an object lies on one side of it.
  void add_fan(Index object, const std::vector<Index>& others, std::string_view direction) {
    for (std::size_t i = 0; i + 1 < others.size(); ++i)
      add_order("above", {others[i], object, others[i + 1]}, direction);
  }

  /// \param objects  of which each has features
  void add_order(const char* plugin, const std::array<Index, 3>& objects, std::string_view direction) {
    const std::vector<SpatialObject>& all = model_.abstract.objects;
    std::string because;
    for (const Index object : objects) because += (because.empty() ? "" : ", ") + all[object].name;
    because = std::string(direction) + "-" + std::string(inverse_of(direction)) + " order of " + because;
    for (const Index a : realisers_[objects[0]])
      for (const Index b : realisers_[objects[1]])
        for (const Index c : realisers_[objects[2]])
          if (a != b && b != c && a != c) add(plugin, {a, b, c}, because);
  }

  void add(const std::string& plugin, const std::vector<Index>& features, const std::string& because) {
    const PluginManifest* relation = reading_.catalog ? reading_.catalog->find(PluginKind::relations, plugin) : nullptr;
    if (reading_.catalog && !relation) return;
    const std::set<Index> scope(features.begin(), features.end());
    const auto is_family = [&](Index f) { return model_.features[f].count.family(); };
    if (std::count_if(scope.begin(), scope.end(), is_family) > 1) return;  // no relationship names two
    for (std::size_t r = 0; r < model_.relationships.size(); ++r) {
      const Relationship& other = model_.relationships[r];
      if (std::set<Index>(other.features.begin(), other.features.end()) != scope) continue;
      if (r < written_ && !of_places(other)) continue;  // how they are turned says nothing of where they are
      if (r >= written_ && other.plugin != plugin) continue;
      model_.overruled.push_back({because, other.name});
      return;
    }
    Relationship& implied = model_.relationships.emplace_back();
    implied.name = new_name();
    implied.plugin = plugin;
    implied.features = features;
    implied.because = because;
    implied.where = model_.features[features[0]].where;
  }

  bool of_places(const Relationship& relationship) const {
    const PluginManifest* relation =
        reading_.catalog ? reading_.catalog->find(PluginKind::relations, relationship.plugin) : nullptr;
    return !relation || relation->unit == "length";
  }

  std::string new_name() {
    std::string name;
    do name = "a" + std::to_string(++number_);
    while (index_of(model_.relationships, name));
    return name;
  }

  /// A class has what follows of the features that its rule names.
  void extend(ClassRule& rule) const {
    std::set<Index> named;
    for (const Index r : rule.relationships)
      named.insert(model_.relationships[r].features.begin(), model_.relationships[r].features.end());
    for (Index r = static_cast<Index>(written_); r < model_.relationships.size(); ++r) {
      const std::vector<Index>& scope = model_.relationships[r].features;
      if (std::all_of(scope.begin(), scope.end(),
                      [&](Index f) { return named.contains(f) && !model_.features[f].count.family(); }))
        rule.relationships.push_back(r);
    }
  }

  const ModelReading& reading_;
  Model& model_;
  std::vector<std::vector<Index>> realisers_;
  std::size_t written_;
  bool all_ = true;
  std::set<std::string> kinds_;
  int number_ = 0;
};

/// Links that relationships add to those of one direction.
class Orders {
 public:
  Orders(const Model& model, std::string_view direction) : model_(model), direction_(direction) {
    for (const ModelFeature& feature : model.features)
      object_of_.push_back(index_of(model.abstract.objects, feature.realises));
  }

  /// `upper` lies the same way of `lower` as `to` of `from`, where the abstract part says which way that is.
  std::vector<Link> same_way(const Relationship& r, std::array<std::size_t, 4> at) const {
    std::array<Index, 4> object{};
    for (std::size_t i = 0; i < at.size(); ++i) {
      if (at[i] >= r.features.size() || !object_of_[r.features[at[i]]]) return {};
      object[i] = *object_of_[r.features[at[i]]];
    }
    const auto& [upper, lower, from, to] = object;
    if (lies(to, from)) return {link(upper, lower, r)};
    if (lies(from, to)) return {link(lower, upper, r)};
    return {};
  }

  std::vector<Link> added(const Relationship& r) const {
    if (r.plugin == "above")
      return same_way(
          r, r.features.size() > 3 ? std::array<std::size_t, 4>{0, 1, 2, 3} : std::array<std::size_t, 4>{0, 1, 1, 2});
    if (r.plugin != "between") return {};
    std::vector<Link> links = same_way(r, {0, 1, 1, 2});
    for (const Link& other : same_way(r, {2, 0, 1, 2})) links.push_back(other);
    return links;
  }

  /// Whether one object lies the direction of the other, as far as the abstract part says.
  bool lies(Index upper, Index lower) const {
    const std::vector<Consequence> all = consequences(model_.abstract, upper, direction_);
    return std::any_of(all.begin(), all.end(), [&](const Consequence& each) { return each.object == lower; });
  }

 private:
  Link link(Index upper, Index lower, const Relationship& r) const {
    return {upper, lower, std::string(direction_), r.where};
  }

  const Model& model_;
  std::string_view direction_;
  std::vector<std::optional<Index>> object_of_;
};

}  // namespace

void add_implied(const YAML::Node& root, const ModelReading& reading, Model& model) {
  if (!model.abstract.objects.empty()) Implier(root, reading, model).imply();
}

void refuse_contrary_orders(const Model& model, const ModelReading& reading) {
  const std::vector<SpatialObject>& objects = model.abstract.objects;
  for (const std::string_view direction : {"up", "front", "right"}) {
    const Orders orders(model, direction);
    for (const Relationship& relationship : model.relationships)
      for (const Link& link : orders.added(relationship))
        if (link.from == link.to || orders.lies(link.to, link.from))
          reading.errors.add(relationship.where, "relationship '" + relationship.name + "' (" + relationship.plugin +
                                                     ") puts '" + objects[link.from].name + "' " +
                                                     std::string(direction) + " of '" + objects[link.to].name +
                                                     "', but by the associations it lies " +
                                                     std::string(inverse_of(direction)) +
                                                     " of it; change the relationship or the associations");
  }
}

std::vector<AxisFeatures> read_axes(const YAML::Node& root, const std::vector<ModelFeature>& features,
                                    const ModelReading& reading) {
  std::vector<AxisFeatures> axes;
  if (!root["axes"]) return axes;
  for (const auto& entry : root["axes"]) {
    AxisFeatures axis{entry.first.Scalar(), {}, reading.at(entry.first)};
    for (const YAML::Node& name : entry.second) {
      if (const auto feature = index_of(features, name.Scalar()))
        axis.features.push_back(*feature);
      else
        reading.add(name, "axis '" + axis.direction + "' names the unknown feature '" + name.Scalar() + "'; " +
                              name_remedy(name.Scalar(), names_of(features)));
    }
    axes.push_back(std::move(axis));
  }
  return axes;
}

}  // namespace toposcope
