// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "resampler.h"
#include "triangle_shape.h"

namespace toposcope::normalise {

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

void Resampler::flip(const Context& context) {
  for (Index h = 0; h < mesh_.start.size(); ++h) {
    if (h % asked_each == 0 && context.cancelled()) return;
    if (mesh_.stands_for_edge(h) && mesh_.opposite[h] != no_index && mesh_.curve[h] == no_index) flip_edge(h);
  }
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
    if (context.cancelled()) return;
    for (std::size_t i = first; i < last; ++i) {
      const auto v = static_cast<Index>(i);
      if (mesh_.outgoing[v] != no_index && mesh_.kind[v] != Kind::corner) moves[v] = wanted(v);
    }
  });
  if (context.cancelled()) return;
  for (Index v = 0; v < moves.size(); ++v) {
    if (v % asked_each == 0 && context.cancelled()) return;
    if (mesh_.outgoing[v] == no_index || mesh_.kind[v] == Kind::corner) continue;
    if (!move(v, moves[v])) move(v, placed(v, (mesh_.position[v] + moves[v].point) / 2));
  }
}

}  // namespace toposcope::normalise
