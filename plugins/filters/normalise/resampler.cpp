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

}  // namespace

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

void Resampler::split_long(double longest, Index most_faces, const Context& context) {
  std::priority_queue<std::pair<double, Index>> queue;  // equal lengths: the greater half-edge first
  const auto push = [&](Index h) {
    const Index edge = std::min(h, mesh_.opposite[h]);
    if (const double length = mesh_.length(edge); length > longest) queue.emplace(length, edge);
  };
  for (Index h = 0; h < mesh_.start.size(); ++h)
    if (mesh_.stands_for_edge(h)) push(h);
  for (std::size_t split = 0; !queue.empty() && mesh_.faces() < most_faces; ++split) {
    if (split % asked_each == 0 && context.cancelled()) return;
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

void Resampler::carry_samples(const Context& context) {
  carrying_ = true;
  change_.reserve_faces(mesh_.face_slots());
  for (Index v = 0; v < mesh_.position.size(); ++v) {
    if (v % asked_each == 0 && context.cancelled()) return;
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
    if (h % asked_each == 0 && context.cancelled()) return;
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

Resampler::Move Resampler::placed(Index v, const Vec3& target) const {
  if (mesh_.kind[v] == Kind::crease) {
    const InputSurface::Place place = surface_.on_curve(curve_at(v), target);
    return {place.point, place.at / 3, place.at};
  }
  const InputSurface::Place place = surface_.on_surface(mesh_.anchor[v], target);
  return {place.point, place.at};
}

}  // namespace toposcope::normalise
