// SPDX-License-Identifier: BSD-3-Clause
#include "model/reasoning.h"

#include <algorithm>
#include <optional>

#include "model/networks.h"

namespace toposcope {
namespace {

/// The links of a model from either end.
class Links {
 public:
  explicit Links(const AbstractModel& model) : from_(model.objects.size()) {
    for (const std::vector<Link>* network : {&model.topology, &model.parts, &model.associations})
      for (const Link& link : *network) {
        from_[link.from].push_back(link);
        from_[link.to].push_back({link.to, link.from, std::string(inverse_of(link.kind)), link.where});
      }
  }
  const std::vector<Link>& of(Index object) const { return from_[object]; }
  std::size_t size() const { return from_.size(); }

 private:
  std::vector<std::vector<Link>> from_;
};

/// Breadth first: the objects reached, each with the link by which it was.
class Walk {
 public:
  explicit Walk(std::size_t objects) : by_(objects), seen_(objects, false) {}

  void start(Index object) {
    seen_[object] = true;
    order_.push_back(object);
  }
  bool reach(const Link& link) {
    if (seen_[link.to]) return false;
    by_[link.to] = link;
    start(link.to);
    return true;
  }
  const std::vector<Index>& order() const { return order_; }
  std::vector<Link> chain_to(Index object) const {
    std::vector<Link> chain;
    for (; by_[object]; object = by_[object]->from) chain.push_back(*by_[object]);
    std::reverse(chain.begin(), chain.end());
    return chain;
  }

 private:
  std::vector<std::optional<Link>> by_;
  std::vector<bool> seen_;
  std::vector<Index> order_;
};

/// From `start` along links of these kinds.
Walk walk(const Links& links, Index start, const std::vector<std::string_view>& kinds) {
  Walk walk(links.size());
  walk.start(start);
  for (std::size_t i = 0; i < walk.order().size(); ++i)
    for (const Link& link : links.of(walk.order()[i]))
      if (std::find(kinds.begin(), kinds.end(), link.kind) != kinds.end()) walk.reach(link);
  return walk;
}

std::vector<Consequence> all_reached(const Walk& walk) {
  std::vector<Consequence> all;
  for (std::size_t i = 1; i < walk.order().size(); ++i)
    all.push_back({walk.order()[i], walk.chain_to(walk.order()[i])});
  return all;
}

/// The boundary of an object: a step down in dimension, then steps down or to parts.
std::vector<Consequence> boundary(const Links& links, Index subject) {
  Walk walk(links.size());
  walk.start(subject);
  for (std::size_t i = 0; i < walk.order().size(); ++i)
    for (const Link& link : links.of(walk.order()[i]))
      if (link.kind == "bounded-by" || (i > 0 && link.kind == "has-part")) walk.reach(link);
  return all_reached(walk);
}

/// What an object bounds: steps up in dimension or to wholes, the last one up.
std::vector<Consequence> bounded(const Links& links, Index subject) {
  const Walk up = walk(links, subject, {"boundary-of", "part-of"});
  std::vector<Consequence> all;
  for (Consequence& each : all_reached(up)) {
    if (each.chain.back().kind != "boundary-of") {
      // Reached first as a whole; it may be bounded all the same.
      const auto by = [&](const Link& link) {
        return link.kind == "bounded-by" &&
               std::find(up.order().begin(), up.order().end(), link.to) != up.order().end();
      };
      const std::vector<Link>& own = links.of(each.object);
      const auto link = std::find_if(own.begin(), own.end(), by);
      if (link == own.end()) continue;
      each.chain = up.chain_to(link->to);
      each.chain.push_back({link->to, link->from, "boundary-of", link->where});
    }
    all.push_back(std::move(each));
  }
  return all;
}

/// What is adjacent to an object by its own links, or by a boundary in common.
std::vector<Consequence> neighbours(const Links& links, Index subject) {
  std::vector<Consequence> all;
  for (const Link& link : links.of(subject)) {
    if (link.kind == "adjacent-to") all.push_back({link.to, {link}});
    if (link.kind != "bounded-by") continue;
    for (const Link& back : links.of(link.to))
      if (back.kind == "boundary-of" && back.to != subject) all.push_back({back.to, {link, back}});
  }
  return all;
}

std::vector<Consequence> adjacent(const Links& links, Index subject) {
  const Walk inside = walk(links, subject, {"has-part"}), outside = walk(links, subject, {"part-of"});
  std::vector<bool> excluded(links.size(), false);
  for (const Walk* each : {&inside, &outside})
    for (const Index object : each->order()) excluded[object] = true;
  std::vector<std::optional<Consequence>> found(links.size());
  std::vector<Index> order;
  const auto add = [&](Index object, std::vector<Link> chain) {
    if (excluded[object]) return;
    if (!found[object]) order.push_back(object);
    if (!found[object] || chain.size() < found[object]->chain.size()) found[object] = {object, std::move(chain)};
  };
  for (const Index part : inside.order())
    for (const Consequence& neighbour : neighbours(links, part)) {
      std::vector<Link> chain = inside.chain_to(part);
      chain.insert(chain.end(), neighbour.chain.begin(), neighbour.chain.end());
      const Walk wholes = walk(links, neighbour.object, {"part-of"});
      for (const Index whole : wholes.order()) {
        std::vector<Link> longer = chain;
        for (const Link& link : wholes.chain_to(whole)) longer.push_back(link);
        add(whole, std::move(longer));
      }
    }
  std::vector<Consequence> all;
  for (const Index object : order) all.push_back(std::move(*found[object]));
  return all;
}

}  // namespace

std::vector<Consequence> consequences(const AbstractModel& model, Index subject, std::string_view relation) {
  const Links links(model);
  std::vector<Consequence> all = relation == "bounded-by"    ? boundary(links, subject)
                                 : relation == "boundary-of" ? bounded(links, subject)
                                 : relation == "adjacent-to" ? adjacent(links, subject)
                                                             : all_reached(walk(links, subject, {relation}));
  std::stable_sort(all.begin(), all.end(),
                   [](const auto& a, const auto& b) { return a.chain.size() < b.chain.size(); });
  return all;
}

}  // namespace toposcope
