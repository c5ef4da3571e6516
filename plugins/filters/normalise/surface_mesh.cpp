// SPDX-License-Identifier: BSD-3-Clause
#include "surface_mesh.h"

#include <Eigen/Geometry>
#include <algorithm>

namespace toposcope::normalise {

Vec3 SurfaceMesh::area_normal(Index f) const {
  const Vec3 &a = position[start[3 * f]], &b = position[start[3 * f + 1]], &c = position[start[3 * f + 2]];
  return (b - a).cross(c - a) / 2;
}

double SurfaceMesh::area() const {
  double sum = 0;
  for (Index f = 0; f < face_slots(); ++f)
    if (is_face(f)) sum += area_normal(f).norm();
  return sum;
}

void SurfaceMesh::assign(const MeshView& mesh, const std::vector<Index>& opposites) {
  position.assign(mesh.positions.begin(), mesh.positions.end());
  kind.assign(position.size(), Kind::smooth);
  anchor.assign(position.size(), no_index);
  outgoing.assign(position.size(), no_index);
  mark_.assign(position.size(), 0);
  opposite = opposites;
  curve.assign(opposite.size(), no_index);
  start.clear();
  for (const Triangle& t : mesh.triangles) start.insert(start.end(), t.begin(), t.end());
  live_faces_ = face_slots();
  for (Index h = 0; h < start.size(); ++h) {
    const Index v = start[h];
    if (outgoing[v] == no_index || opposite[h] == no_index) outgoing[v] = h;
    if (anchor[v] == no_index) anchor[v] = h / 3;
  }
}

void SurfaceMesh::link(Index h, Index g) {
  if (h != no_index) opposite[h] = g;
  if (g != no_index) opposite[g] = h;
}

// Makes `half_edge`, which leaves v, or on the boundary the last one clockwise of it, the outgoing one.
void SurfaceMesh::settle(Index v, Index half_edge) {
  Index h = half_edge;
  while (opposite[h] != no_index) {
    h = next_half_edge(opposite[h]);
    if (h == half_edge) break;
  }
  outgoing[v] = h;
}

Index SurfaceMesh::new_face() {
  ++live_faces_;
  if (!free_faces_.empty()) {
    const Index f = free_faces_.back();
    free_faces_.pop_back();
    return f;
  }
  const Index f = face_slots();
  start.resize(start.size() + 3, no_index);
  opposite.resize(start.size(), no_index);
  curve.resize(start.size(), no_index);
  return f;
}

void SurfaceMesh::drop_face(Index f) {
  --live_faces_;
  std::fill_n(start.begin() + 3 * f, 3, no_index);
  free_faces_.push_back(f);
}

bool SurfaceMesh::can_collapse(Index h) {
  const Index g = opposite[h];
  const Index v = start[h], w = end(h);
  const auto on_boundary = [&](Index x) { return opposite[outgoing[x]] == no_index; };
  if (g != no_index && on_boundary(v) && on_boundary(w)) return false;
  // The far corner of each face that vanishes must keep a fan of at least one face, and inside of at least three.
  for (Index side : {h, g}) {
    if (side == no_index) continue;
    if (opposite[next_half_edge(side)] == no_index && opposite[previous_half_edge(side)] == no_index) return false;
    const Index far = apex(side);
    if (on_boundary(far)) continue;
    int valence = 0;
    around(far, [&](Index) { ++valence; });
    if (valence <= 3) return false;
  }
  ++query_;
  ring(v, [&](Index x) { mark_[x] = query_; });
  int common = 0;
  ring(w, [&](Index x) { common += mark_[x] == query_; });
  return common == (g == no_index ? 1 : 2);
}

void SurfaceMesh::collapse(Index h) {
  const Index v = start[h], w = end(h), g = opposite[h];
  const Index sides[] = {h, g};
  around(v, [&](Index x) { start[x] = w; });
  Index leaves_w = no_index;
  for (Index side : sides) {
    if (side == no_index) continue;
    const Index far = apex(side);
    const Index outer = opposite[next_half_edge(side)], inner = opposite[previous_half_edge(side)];
    // They meet now: `outer` runs from the far corner to w, `inner` back; one of them may be missing.
    Index line = curve[next_half_edge(side)];
    if (line == no_index) line = curve[previous_half_edge(side)];
    link(outer, inner);
    for (Index x : {outer, inner})
      if (x != no_index) curve[x] = line;
    leaves_w = inner != no_index ? inner : next_half_edge(outer);
    drop_face(side / 3);
    settle(far, outer != no_index ? outer : next_half_edge(inner));
  }
  outgoing[v] = no_index;
  settle(w, leaves_w);
}

bool SurfaceMesh::can_flip(Index h) const {
  const Index g = opposite[h];
  if (g == no_index || curve[h] != no_index) return false;
  const Index a = apex(h), b = apex(g);
  bool joined = a == b;
  ring(a, [&](Index x) { joined = joined || x == b; });
  return !joined;
}

void SurfaceMesh::flip(Index h) {
  const Index g = opposite[h];
  const Index hn = next_half_edge(h), hp = previous_half_edge(h), gn = next_half_edge(g), gp = previous_half_edge(g);
  const Index v = start[h], w = start[g], a = start[hp], b = start[gp];
  const Index outer[] = {opposite[hn], opposite[hp], opposite[gn], opposite[gp]};
  const Index lines[] = {curve[hn], curve[hp], curve[gn], curve[gp]};
  // Face of h becomes a b w, face of g becomes b a v.
  start[h] = a;
  start[hn] = b;
  start[hp] = w;
  start[g] = b;
  start[gn] = a;
  start[gp] = v;
  link(hn, outer[3]);
  link(hp, outer[0]);
  link(gn, outer[1]);
  link(gp, outer[2]);
  curve[hn] = lines[3];
  curve[hp] = lines[0];
  curve[gn] = lines[1];
  curve[gp] = lines[2];
  settle(a, h);
  settle(b, g);
  settle(w, hp);
  settle(v, gp);
}

Index SurfaceMesh::split(Index h) {
  const Index g = opposite[h], v = start[h], w = end(h);
  const auto m = static_cast<Index>(position.size());
  position.push_back((position[v] + position[w]) / 2);
  kind.push_back(curve[h] == no_index ? Kind::smooth : Kind::crease);
  anchor.push_back(anchor[v]);
  outgoing.push_back(no_index);
  mark_.push_back(0);

  // Face v w a keeps its slot as m w a and gives v m a away; likewise w v b on the other side.
  const Index new_h = 3 * new_face();
  const Index a = apex(h);
  start[new_h] = v;
  start[new_h + 1] = m;
  start[new_h + 2] = a;
  start[h] = m;
  link(new_h + 2, opposite[previous_half_edge(h)]);
  curve[new_h + 2] = curve[previous_half_edge(h)];
  link(new_h + 1, previous_half_edge(h));
  curve[new_h + 1] = curve[previous_half_edge(h)] = no_index;
  curve[new_h] = curve[h];
  link(new_h, no_index);
  if (g != no_index) {
    const Index new_g = 3 * new_face();
    const Index b = apex(g);
    start[new_g] = m;
    start[new_g + 1] = v;
    start[new_g + 2] = b;
    start[next_half_edge(g)] = m;
    link(new_g + 1, opposite[next_half_edge(g)]);
    curve[new_g + 1] = curve[next_half_edge(g)];
    link(new_g + 2, next_half_edge(g));
    curve[new_g + 2] = curve[next_half_edge(g)] = no_index;
    curve[new_g] = curve[g];
    link(new_g, new_h);
    settle(b, new_g + 2);
  }
  settle(m, h);
  settle(v, new_h);
  settle(w, next_half_edge(h));
  settle(a, new_h + 2);
  return m;
}

}  // namespace toposcope::normalise
