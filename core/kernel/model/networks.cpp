// SPDX-License-Identifier: BSD-3-Clause
#include "model/networks.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

namespace toposcope {

std::string_view inverse_of(std::string_view kind) {
  static constexpr std::array<std::pair<std::string_view, std::string_view>, 6> pairs = {
      {{"bounded-by", "boundary-of"},
       {"has-part", "part-of"},
       {"adjacent-to", "adjacent-to"},
       {"up", "down"},
       {"front", "back"},
       {"right", "left"}}};
  for (const auto& [forward, backward] : pairs) {
    if (kind == forward) return backward;
    if (kind == backward) return forward;
  }
  return {};
}

std::vector<Link> links_from(const AbstractModel& model, Index object) {
  std::vector<Link> links;
  for (const std::vector<Link>* network : {&model.topology, &model.parts, &model.associations})
    for (const Link& link : *network) {
      if (link.from == object) links.push_back(link);
      if (link.to == object) links.push_back({link.to, link.from, std::string(inverse_of(link.kind)), link.where});
    }
  return links;
}

std::vector<Index> find_cycle(Index object_count, const std::vector<Link>& links) {
  std::vector<std::vector<Index>> next(object_count);
  for (const Link& link : links) next[link.from].push_back(link.to);

  enum class Visit : std::uint8_t { none, open, done };
  std::vector<Visit> visit(object_count, Visit::none);
  struct Step {
    Index object;
    std::size_t taken;
  };
  // Depth first with a path of our own: a chain of links may be longer than the stack.
  for (Index start = 0; start < object_count; ++start) {
    if (visit[start] != Visit::none) continue;
    std::vector<Step> path = {{start, 0}};
    visit[start] = Visit::open;
    while (!path.empty()) {
      Step& step = path.back();
      if (step.taken == next[step.object].size()) {
        visit[step.object] = Visit::done;
        path.pop_back();
        continue;
      }
      const Index target = next[step.object][step.taken++];
      if (visit[target] == Visit::none) {
        visit[target] = Visit::open;
        path.push_back({target, 0});
      } else if (visit[target] == Visit::open) {
        std::vector<Index> cycle;
        auto first = std::find_if(path.begin(), path.end(), [&](const Step& s) { return s.object == target; });
        for (; first != path.end(); ++first) cycle.push_back(first->object);
        return cycle;
      }
    }
  }
  return {};
}

}  // namespace toposcope
