// SPDX-License-Identifier: BSD-3-Clause
#include "input_surface.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "toposcope/geometry/lines.h"

namespace toposcope::normalise {
namespace {

// A crease shorter than this many edges of the wanted length cannot be drawn with them.
constexpr double shortest_crease = 4;
// Where a crease turns by more than this it has a corner.
constexpr double corner_turn = pi / 4;

Index root(std::vector<Index>& parent, Index v) {
  while (parent[v] != v) v = parent[v] = parent[parent[v]];
  return v;
}

}  // namespace

InputSurface::InputSurface(const MeshView& mesh, double crease_angle, double scale)
    : mesh_(mesh), opposite_(opposite_half_edges(mesh)) {
  find_curves(crease_angle, scale);
  find_corners(scale);
}

Vec3 InputSurface::unit_normal(Index f) const {
  const Triangle& t = mesh_.triangles[f];
  return (mesh_.positions[t[1]] - mesh_.positions[t[0]])
      .cross(mesh_.positions[t[2]] - mesh_.positions[t[0]])
      .stableNormalized();
}

void InputSurface::find_curves(double crease_angle, double scale) {
  curve_.assign(opposite_.size(), 0);
  std::vector<Index> parent(mesh_.positions.size());
  std::iota(parent.begin(), parent.end(), Index{0});
  const double least_cosine = std::cos(crease_angle);
  for (Index h = 0; h < opposite_.size(); ++h) {
    const Index g = opposite_[h];
    curve_[h] = g == no_index || unit_normal(h / 3).dot(unit_normal(g / 3)) < least_cosine;
    if (curve_[h]) parent[root(parent, from(h))] = root(parent, to(h));
  }
  std::vector<double> total(mesh_.positions.size(), 0);
  for (Index h = 0; h < opposite_.size(); ++h)
    if (curve_[h] && h < opposite_[h])
      total[root(parent, from(h))] += opposite_[h] == no_index ? shortest_crease * scale : length(h);
  for (Index h = 0; h < opposite_.size(); ++h)
    if (curve_[h] && total[root(parent, from(h))] < shortest_crease * scale) curve_[h] = 0;
}

void InputSurface::find_corners(double scale) {
  kind_.assign(mesh_.positions.size(), Kind::smooth);
  curves_at_.assign(mesh_.positions.size(), {no_index, no_index});
  std::vector<int> count(mesh_.positions.size(), 0);
  for (Index h = 0; h < opposite_.size(); ++h)
    if (curve_[h] && h < opposite_[h])
      for (Index v : {from(h), to(h)}) {
        if (count[v] < 2) curves_at_[v][static_cast<std::size_t>(count[v])] = h;
        ++count[v];
      }
  for (Index v = 0; v < mesh_.vertex_count(); ++v)
    if (count[v] > 0) kind_[v] = count[v] == 2 ? Kind::crease : Kind::corner;

  // Sharpest first; a corner takes its surroundings with it.
  std::vector<std::pair<double, Index>> turns;
  for (Index v = 0; v < mesh_.vertex_count(); ++v)
    if (kind_[v] == Kind::crease)
      if (const double angle = turn(v, scale / 2); angle > corner_turn) turns.emplace_back(-angle, v);
  std::sort(turns.begin(), turns.end());
  std::vector<char> taken(mesh_.positions.size(), 0);
  for (const auto& [angle, v] : turns) {
    if (taken[v]) continue;
    for (Index h : curves_at_[v]) {
      double reached = 0;
      for (Index x = v; h != no_index && reached < scale; h = beyond(h, x)) {
        reached += length(h);
        x = from(h) == x ? to(h) : from(h);
        if (reached < scale) taken[x] = 1;
        if (x == v) break;
      }
    }
    kind_[v] = Kind::corner;
  }
}

// The other curve edge at v, where there is just one.
Index InputSurface::beyond(Index h, Index v) const {
  if (kind_[v] != Kind::crease) return no_index;
  return curves_at_[v][0] == h ? curves_at_[v][1] : curves_at_[v][0];
}

// By how much a curve turns at v, seen over `scale` (at least one edge) to both sides.
double InputSurface::turn(Index v, double scale) const {
  std::array<Vec3, 2> arm;
  for (std::size_t side = 0; side < 2; ++side) {
    Index h = curves_at_[v][side], x = v;
    double reached = 0;
    while (h != no_index) {
      reached += length(h);
      x = from(h) == x ? to(h) : from(h);
      if (reached >= scale || x == v) break;
      h = beyond(h, x);
    }
    arm[side] = mesh_.positions[x] - mesh_.positions[v];
  }
  return std::atan2(arm[0].cross(arm[1]).norm(), -arm[0].dot(arm[1]));
}

InputSurface::Place InputSurface::on_surface(Index face, const Vec3& x) const {
  const auto closest = [&](Index f) {
    const Triangle& t = mesh_.triangles[f];
    return closest_on_triangle(mesh_.positions[t[0]], mesh_.positions[t[1]], mesh_.positions[t[2]], x);
  };
  TrianglePoint best = closest(face);
  double least = (best.point - x).squaredNorm();
  for (bool nearer = true; nearer;) {
    nearer = false;
    const Index here = face;
    const TrianglePoint at = best;
    const auto look = [&](Index f) {
      if (f == here) return;
      const TrianglePoint other = closest(f);
      const double d = (other.point - x).squaredNorm();
      if (d >= least) return;
      best = other;
      least = d;
      face = f;
      nearer = true;
    };
    // Only beyond the side or corner that stops it can the surface come nearer.
    const auto zeros = std::count(at.weights.begin(), at.weights.end(), 0.0);
    for (Index k = 0; k < 3 && zeros > 0; ++k) {
      if (zeros == 1 && at.weights[(k + 2) % 3] == 0 && opposite_[3 * here + k] != no_index)
        look(opposite_[3 * here + k] / 3);
      if (zeros == 2 && at.weights[k] != 0)
        for (Index f : mesh_.faces_of(mesh_.triangles[here][k])) look(f);
    }
  }
  return {face, best.point};
}

InputSurface::Place InputSurface::on_curve(Index curve, const Vec3& x) const {
  const auto closest = [&](Index h) { return closest_on_segment(mesh_.positions[from(h)], mesh_.positions[to(h)], x); };
  SegmentPoint best = closest(curve);
  double least = (best.point - x).squaredNorm();
  for (;;) {
    if (best.t > 0 && best.t < 1) break;
    const Index next = beyond(curve, best.t <= 0 ? from(curve) : to(curve));
    if (next == no_index) break;
    const SegmentPoint other = closest(next);
    const double d = (other.point - x).squaredNorm();
    if (d >= least) break;
    best = other;
    least = d;
    curve = next;
  }
  return {curve, best.point};
}

}  // namespace toposcope::normalise
