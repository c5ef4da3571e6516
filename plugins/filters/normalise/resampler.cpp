// SPDX-License-Identifier: BSD-3-Clause
#include "resampler.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

namespace toposcope::normalise {
namespace {

// Samples lie at most this many edges of the wanted length apart on what is split.
constexpr double sample_spacing = 0.5;
// A face may turn by at most 72 degrees at a time.
constexpr double least_turn_cosine = 0.3;
constexpr double least_roundness = 0.2;
// Edges that cost less to collapse, in edges of the wanted length, are collapsed in any case.
constexpr double too_short = 0.5;

Vec3 normal_of(const std::array<Vec3, 3>& p) {
  return (p[1] - p[0]).cross(p[2] - p[0]);
}

// Whether a face may turn from one area normal to another.
bool turns_little(const Vec3& before, const Vec3& after) {
  return before.dot(after) > least_turn_cosine * before.norm() * after.norm();
}

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

double roundness(const std::array<Vec3, 3>& p) {
  const double squares = (p[1] - p[0]).squaredNorm() + (p[2] - p[1]).squaredNorm() + (p[0] - p[2]).squaredNorm();
  return squares > 0 ? 2 * std::sqrt(3.0) * normal_of(p).norm() / squares : 0;
}

Resampler::Resampler(const InputSurface& surface, const Goal& goal, double free_change)
    : surface_(surface), goal_(goal), free_change_(free_change) {
  mesh_.assign(surface.mesh(), surface.opposite());
  for (Index h = 0; h < mesh_.start.size(); ++h)
    if (surface.is_curve(h)) mesh_.curve[h] = std::min(h, mesh_.opposite[h]);
  for (Index v = 0; v < mesh_.position.size(); ++v) mesh_.kind[v] = surface.kind(v);
}

double Resampler::mean_edge() const {
  double sum = 0, count = 0;
  for (Index h = 0; h < mesh_.start.size(); ++h)
    if (mesh_.stands_for_edge(h)) {
      sum += mesh_.length(h);
      ++count;
    }
  return sum / count;
}

Facet Resampler::facet(Index f) const {
  Facet t{{}, {}, {}, f};
  for (Index k = 0; k < 3; ++k) {
    t.vertex[k] = mesh_.start[3 * f + k];
    t.corner[k] = mesh_.position[t.vertex[k]];
    t.curve[k] = mesh_.curve[3 * f + k] != no_index;
  }
  return t;
}

void Resampler::take_faces_around(Index v) {
  old_faces_.clear();
  facets_.clear();
  mesh_.around(v, [&](Index h) {
    old_faces_.push_back(h / 3);
    facets_.push_back(facet(h / 3));
  });
}

void Resampler::split_long(double longest, Index most_faces) {
  std::priority_queue<std::pair<double, Index>> queue;  // equal lengths: the greater half-edge first
  const auto push = [&](Index h) {
    const Index edge = std::min(h, mesh_.opposite[h]);
    if (const double length = mesh_.length(edge); length > longest) queue.emplace(length, edge);
  };
  for (Index h = 0; h < mesh_.start.size(); ++h)
    if (mesh_.stands_for_edge(h)) push(h);
  while (!queue.empty() && mesh_.faces() < most_faces) {
    const auto [length, h] = queue.top();
    queue.pop();
    if (length != mesh_.length(h)) continue;  // split since
    old_faces_ = {h / 3};
    if (mesh_.opposite[h] != no_index) old_faces_.push_back(mesh_.opposite[h] / 3);
    const Vec3 middle = (mesh_.position[mesh_.start[h]] + mesh_.position[mesh_.end(h)]) / 2;
    const InputSurface::Place from = nearest(mesh_.start[h], middle), beside = nearest(mesh_.end(h), middle);
    const bool nearer = (from.point - middle).squaredNorm() <= (beside.point - middle).squaredNorm();
    const Index v = mesh_.split(h);
    mesh_.anchor[v] = nearer ? from.at : beside.at;
    const Move to = placed(v, middle);
    mesh_.anchor[v] = to.anchor;
    if (carrying_) {
      change_.reserve_faces(mesh_.face_slots());
      change_.lift(old_faces_);
      facets_.clear();
      std::vector<Index> around;
      mesh_.around(v, [&](Index x) { facets_.push_back(facet(x / 3)); });
      change_.measure(facets_, 1e300);
      change_.settle(old_faces_, facets_);
      move(v, to);
    }
    mesh_.around(v, [&](Index x) {
      push(x);
      push(next_half_edge(x));
      if (mesh_.opposite[previous_half_edge(x)] == no_index) push(previous_half_edge(x));
    });
  }
}

void Resampler::carry_samples() {
  carrying_ = true;
  change_.reserve_faces(mesh_.face_slots());
  for (Index v = 0; v < mesh_.position.size(); ++v) {
    if (mesh_.outgoing[v] == no_index) continue;
    Index at = mesh_.outgoing[v] / 3;
    const bool on_curve = mesh_.kind[v] != Kind::smooth;
    if (on_curve)
      mesh_.around(v, [&](Index h) {
        if (mesh_.curve[h] != no_index || mesh_.curve[previous_half_edge(h)] != no_index) at = h / 3;
      });
    change_.add(mesh_.position[v], on_curve, at);
  }
  // The middles of edges that are long, or that the surface bends about so much that a mesh near their ends could miss
  // them.
  const double deep = free_change_ / 4;
  for (Index h = 0; h < mesh_.start.size(); ++h) {
    if (!mesh_.stands_for_edge(h)) continue;
    const double length = mesh_.length(h);
    double sine = 0;
    if (const Index g = mesh_.opposite[h]; g != no_index)
      sine = mesh_.area_normal(h / 3).stableNormalized().cross(mesh_.area_normal(g / 3).stableNormalized()).norm();
    if (length > sample_spacing * goal_.edge || length / 4 * sine > deep)
      change_.add((mesh_.position[mesh_.start[h]] + mesh_.position[mesh_.end(h)]) / 2, mesh_.curve[h] != no_index,
                  h / 3);
  }
}

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

// The surface near a vertex has two sides at a crease and more at a corner: a descent from one need not find the
// others.
InputSurface::Place Resampler::nearest(Index v, const Vec3& x) const {
  if (mesh_.kind[v] == Kind::smooth) return surface_.on_surface(mesh_.anchor[v], x);
  InputSurface::Place best{no_index, x};
  double least = std::numeric_limits<double>::infinity();
  const auto look = [&](Index face) {
    const InputSurface::Place place = surface_.on_surface(face, x);
    const double d = (place.point - x).squaredNorm();
    if (d >= least) return;
    least = d;
    best = place;
  };
  if (mesh_.kind[v] == Kind::corner) {
    // Corners are vertices of the input and keep their numbers.
    for (Index face : surface_.mesh().faces_of(v)) look(face);
    return best;
  }
  const Index curve = curve_at(v), other = surface_.opposite()[curve];
  look(curve / 3);
  if (other != no_index) look(other / 3);
  return best;
}

// The input's half-edge under one of the crease edges of v.
Index Resampler::curve_at(Index v) const {
  Index curve = no_index;
  mesh_.around(v, [&](Index h) {
    for (Index x : {h, previous_half_edge(h)})
      if (curve == no_index) curve = mesh_.curve[x];
  });
  return curve;
}

// The samples tell how far the input is from the mesh. The other way the vertices lie on it, the faces may not: the
// greatest squared distance of the middles of the faces in hand, and of an edge of each.
double Resampler::off_surface() const {
  const double negligible = std::pow(0.01 * goal_.edge, 2);
  double greatest = 0;
  for (const Facet& t : facets_)
    for (const Vec3& x : {Vec3((t.corner[0] + t.corner[1] + t.corner[2]) / 3), Vec3((t.corner[0] + t.corner[1]) / 2)}) {
      double least = std::numeric_limits<double>::infinity();
      for (std::size_t k = 0; k < 3 && least > std::max(greatest, negligible); ++k)
        least = std::min(least, (nearest(t.vertex[k], x).point - x).squaredNorm());
      greatest = std::max(greatest, least);
    }
  return greatest;
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
  for (Index h = 0; h < mesh_.start.size(); ++h)
    if (mesh_.is_half_edge(h)) push(h);
  for (std::size_t step = 0; !queue.empty(); ++step) {
    if (mesh_.faces() <= least_faces && (queue.top().cost > too_short || mesh_.faces() <= least_faces / 2)) return;
    if (step % 1024 == 0 && context.cancelled()) return;
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

void Resampler::flip_edge(Index h) {
  const Index g = mesh_.opposite[h];
  const Vec3 &v = mesh_.position[mesh_.start[h]], &w = mesh_.position[mesh_.end(h)];
  const Vec3 &a = mesh_.position[mesh_.apex(h)], &b = mesh_.position[mesh_.apex(g)];
  const auto cotangent = [&](const Vec3& apex) {
    return (v - apex).dot(w - apex) / std::max((v - apex).cross(w - apex).norm(), 1e-300);
  };
  const double delaunay = cotangent(a) + cotangent(b);
  const double change = std::max(change_.squared(h / 3), change_.squared(g / 3));
  const double free = free_change_ * free_change_;
  if (delaunay > -1e-6 && change <= free) return;
  if (!mesh_.can_flip(h)) return;
  const std::array<Vec3, 3> abw = {a, b, w}, bav = {b, a, v};
  const Vec3 together = normal_of({v, w, a}) + normal_of({w, v, b});
  if (!turns_little(together, normal_of(abw)) || !turns_little(together, normal_of(bav))) return;
  if (std::min(roundness(abw), roundness(bav)) <
      std::min({least_roundness, roundness({v, w, a}), roundness({w, v, b})}))
    return;
  old_faces_ = {h / 3, g / 3};
  const auto curve = [&](Index x) { return mesh_.curve[x] != no_index; };
  facets_.clear();
  facets_.push_back({abw,
                     {mesh_.apex(h), mesh_.apex(g), mesh_.end(h)},
                     {false, curve(previous_half_edge(g)), curve(next_half_edge(h))},
                     h / 3});
  facets_.push_back({bav,
                     {mesh_.apex(g), mesh_.apex(h), mesh_.start[h]},
                     {false, curve(previous_half_edge(h)), curve(next_half_edge(g))},
                     g / 3});
  change_.lift(old_faces_);
  const double after = change_.measure(facets_, std::max(change, free));
  const bool rounder = delaunay < -1e-6 && after <= std::max(change, free);
  const bool closer = change > free && after < 0.5 * change;
  if (!rounder && !closer) return;
  if (off_surface() > goal_.max_change * goal_.max_change) return;
  change_.settle(old_faces_, facets_);
  mesh_.flip(h);
}

void Resampler::flip() {
  for (Index h = 0; h < mesh_.start.size(); ++h)
    if (mesh_.stands_for_edge(h) && mesh_.opposite[h] != no_index && mesh_.curve[h] == no_index) flip_edge(h);
}

Resampler::Move Resampler::placed(Index v, const Vec3& target) const {
  if (mesh_.kind[v] == Kind::crease) {
    const InputSurface::Place place = surface_.on_curve(curve_at(v), target);
    return {place.point, place.at / 3, place.at};
  }
  const InputSurface::Place place = surface_.on_surface(mesh_.anchor[v], target);
  return {place.point, place.at};
}

// The middle of a vertex's neighbours along its crease, or the centre of the faces around it, weighted by area.
Resampler::Move Resampler::wanted(Index v) const {
  const Vec3& here = mesh_.position[v];
  Vec3 sum = Vec3::Zero();
  double weight = 0;
  if (mesh_.kind[v] == Kind::crease) {
    mesh_.around(v, [&](Index h) {
      if (mesh_.curve[h] != no_index) sum += mesh_.position[mesh_.end(h)];
      const Index last = previous_half_edge(h);
      if (mesh_.curve[last] != no_index && mesh_.opposite[last] == no_index) sum += mesh_.position[mesh_.start[last]];
    });
    return placed(v, sum / 2);
  }
  mesh_.around(v, [&](Index h) {
    const Vec3 &p = mesh_.position[mesh_.end(h)], &q = mesh_.position[mesh_.apex(h)];
    const double area = (p - here).cross(q - here).norm();
    sum += area / 3 * (p + q + here);
    weight += area;
  });
  return placed(v, weight > 0 ? Vec3(sum / weight) : here);
}

bool Resampler::move(Index v, const Move& to) {
  take_faces_around(v);
  double change = free_change_ * free_change_;
  for (Facet& t : facets_) {
    const Vec3 before = normal_of(t.corner);
    const double round = roundness(t.corner);
    for (Index k = 0; k < 3; ++k)
      if (mesh_.start[3 * t.face + k] == v) t.corner[k] = to.point;
    if (round > 1e-3 && !turns_little(before, normal_of(t.corner))) return false;
    if (roundness(t.corner) < std::min(least_roundness, round)) return false;
    change = std::max(change, change_.squared(t.face));
  }
  change_.lift(old_faces_);
  if (!std::isfinite(change_.measure(facets_, change))) return false;
  if (off_surface() > goal_.max_change * goal_.max_change) return false;
  change_.settle(old_faces_, facets_);
  mesh_.position[v] = to.point;
  mesh_.anchor[v] = to.anchor;
  if (to.curve != no_index)
    mesh_.around(v, [&](Index h) {
      for (Index x : {h, previous_half_edge(h)})
        if (mesh_.curve[x] != no_index) {
          mesh_.curve[x] = to.curve;
          if (mesh_.opposite[x] != no_index) mesh_.curve[mesh_.opposite[x]] = to.curve;
        }
    });
  return true;
}

void Resampler::relax(Context& context) {
  std::vector<Move> moves(mesh_.position.size());
  context.parallel_for(moves.size(), 512, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      const auto v = static_cast<Index>(i);
      if (mesh_.outgoing[v] != no_index && mesh_.kind[v] != Kind::corner) moves[v] = wanted(v);
    }
  });
  for (Index v = 0; v < moves.size(); ++v) {
    if (mesh_.outgoing[v] == no_index || mesh_.kind[v] == Kind::corner) continue;
    if (!move(v, moves[v])) move(v, placed(v, (mesh_.position[v] + moves[v].point) / 2));
  }
}

}  // namespace toposcope::normalise
