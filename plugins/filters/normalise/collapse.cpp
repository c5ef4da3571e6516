// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <queue>

#include "resampler.h"
#include "triangle_shape.h"

namespace toposcope::normalise {
namespace {

// Edges that cost less to collapse, in edges of the wanted length, are collapsed in any case.
constexpr double too_short = 0.5;

struct Candidate {
  double cost;
  Index half_edge;
  Index stamp;
  bool operator>(const Candidate& other) const {
    return cost != other.cost ? cost > other.cost : half_edge > other.half_edge;
  }
};
using Cheapest = std::priority_queue<Candidate, std::vector<Candidate>, std::greater<>>;

}  // namespace

// Puts the faces around the start of h into hand as they would be, if they may be so.
bool Resampler::prepare_collapse(Index h, const Limits& limits) {
  const Index v = mesh_.start[h], w = mesh_.end(h), g = mesh_.opposite[h];
  if (mesh_.kind[v] == Kind::corner || (mesh_.kind[v] == Kind::crease && mesh_.curve[h] == no_index)) return false;
  if (!mesh_.can_collapse(h)) return false;
  old_faces_.clear();
  facets_.clear();
  bool sound = true;
  double worst_before = 1, worst_after = 1;
  mesh_.around(v, [&](Index x) {
    old_faces_.push_back(x / 3);
    if (x == h || previous_half_edge(x) == g) return;
    const Index p = mesh_.end(x), q = mesh_.apex(x);
    // Sides that fall together are on a crease if one of them was.
    const bool first = mesh_.curve[x] != no_index || (p == mesh_.apex(h) && mesh_.curve[next_half_edge(h)] != no_index);
    const bool last = mesh_.curve[previous_half_edge(x)] != no_index ||
                      (g != no_index && q == mesh_.apex(g) && mesh_.curve[previous_half_edge(g)] != no_index);
    const std::array<Vec3, 3> before = {mesh_.position[v], mesh_.position[p], mesh_.position[q]};
    const std::array<Vec3, 3> after = {mesh_.position[w], mesh_.position[p], mesh_.position[q]};
    const double round = roundness(before);
    worst_before = std::min(worst_before, round);
    worst_after = std::min(worst_after, roundness(after));
    sound = sound && (after[1] - after[0]).squaredNorm() <= limits.longest * limits.longest &&
            (after[2] - after[0]).squaredNorm() <= limits.longest * limits.longest &&
            (round < 1e-3 || turns_little(normal_of(before), normal_of(after)));
    facets_.push_back({after, {w, p, q}, {first, mesh_.curve[next_half_edge(x)] != no_index, last}, x / 3});
  });
  return sound && worst_after >= std::min(limits.roundness, worst_before);
}

std::optional<double> Resampler::collapse_cost(Index h, const Limits& limits) {
  if (!prepare_collapse(h, limits)) return {};
  change_.lift(old_faces_);
  const double limit = limits.change * limits.change;
  double squared = change_.measure(facets_, limit);
  if (!std::isfinite(squared)) return {};
  squared = std::max(squared, off_surface());
  if (squared > limit) return {};
  return (mesh_.length(h) + goal_.shape_weight * std::sqrt(squared)) / goal_.edge;
}

void Resampler::collapse(Index least_faces, const Limits& limits, Context& context) {
  std::vector<Index> stamp(mesh_.start.size(), 0);
  Cheapest queue;
  const auto push = [&](Index h) {
    if (h != no_index) queue.push({mesh_.length(h) / goal_.edge, h, ++stamp[h]});
  };
  for (Index h = 0; h < mesh_.start.size(); ++h) {
    if (h % asked_each == 0 && context.cancelled()) return;
    if (mesh_.is_half_edge(h)) push(h);
  }
  for (std::size_t step = 0; !queue.empty(); ++step) {
    if (mesh_.faces() <= least_faces && (queue.top().cost > too_short || mesh_.faces() <= least_faces / 2)) return;
    if (step % asked_each == 0 && context.cancelled()) return;
    const Candidate candidate = queue.top();
    queue.pop();
    const Index h = candidate.half_edge;
    if (!mesh_.is_half_edge(h) || candidate.stamp != stamp[h]) continue;
    const std::optional<double> cost = collapse_cost(h, limits);
    if (!cost) continue;
    // The cost in the queue is a lower bound: the length alone, or what it was before a neighbour changed.
    if (!queue.empty() && *cost > queue.top().cost) {
      queue.push({*cost, h, candidate.stamp});
      continue;
    }
    const Index w = mesh_.end(h);
    change_.settle(old_faces_, facets_);
    mesh_.collapse(h);
    mesh_.around(w, [&](Index x) {
      push(x);
      push(previous_half_edge(x));
    });
  }
}

}  // namespace toposcope::normalise
