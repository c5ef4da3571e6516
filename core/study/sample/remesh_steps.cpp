// SPDX-License-Identifier: BSD-3-Clause
#include "sample/remesh_steps.h"

#include <algorithm>
#include <cmath>

namespace toposcope {

double agreement(const Point& a, const Point& b, const Point& c, const Point& normal) {
  const Point area = (b - a) % (c - a);
  const double size = area.norm() * normal.norm();
  return size > 0 ? (area | normal) / size : -1;
}

SizeField measure_sizes(const Halfedges& mesh, double greatest) {
  SizeField sizes{greatest, std::vector<double>(mesh.n_vertices(), greatest)};
  const auto for_each_edge = [&](const auto& bound) {
    for (const auto e : mesh.edges()) {
      const auto h = mesh.halfedge_handle(e, 0);
      const auto p = mesh.from_vertex_handle(h), q = mesh.to_vertex_handle(h);
      bound(p, q, (mesh.point(q) - mesh.point(p)).norm());
    }
  };
  for_each_edge([&](auto p, auto q, double length) {
    const double bend = std::acos(std::clamp(mesh.normal(p) | mesh.normal(q), -1.0, 1.0));
    const double target = std::max(SizeField::least * greatest, SizeField::turn * length / std::max(bend, 1e-9));
    for (const auto v : {p, q}) sizes.target[SizeField::index(v)] = std::min(sizes.target[SizeField::index(v)], target);
  });
  for (int pass = 0; pass < 4; ++pass)
    for_each_edge([&](auto p, auto q, double length) {
      double &a = sizes.target[SizeField::index(p)], &b = sizes.target[SizeField::index(q)];
      a = std::min(a, b + SizeField::growth * length);
      b = std::min(b, a + SizeField::growth * length);
    });
  return sizes;
}

namespace {

/// Least agreement of the faces that a collapse would leave.
double agreement_after(const Halfedges& mesh, Halfedges::HalfedgeHandle collapse) {
  const auto gone = mesh.from_vertex_handle(collapse), kept = mesh.to_vertex_handle(collapse);
  const Point &point = mesh.point(kept), &normal = mesh.normal(kept);
  double least = 1;
  for (auto it = mesh.cvoh_iter(gone); it.is_valid(); ++it) {
    const auto b = mesh.to_vertex_handle(*it), c = mesh.to_vertex_handle(mesh.next_halfedge_handle(*it));
    if (b == kept || c == kept) continue;
    least = std::min(least, agreement(point, mesh.point(b), mesh.point(c), normal + mesh.normal(b) + mesh.normal(c)));
  }
  return least;
}

}  // namespace

void split_edges(Halfedges& mesh, const Implicit& surface, double greatest) {
  constexpr double longest = 1.5;
  const SizeField sizes = measure_sizes(mesh, greatest);
  std::vector<Halfedges::EdgeHandle> edges;
  for (const auto e : mesh.edges())
    if (mesh.calc_edge_length(e) > longest * sizes.along(mesh, e)) edges.push_back(e);
  for (const auto e : edges) {
    const auto h = mesh.halfedge_handle(e, 0);
    const Point& p = mesh.point(mesh.from_vertex_handle(h));
    const Point& q = mesh.point(mesh.to_vertex_handle(h));
    const Foot middle = settle(surface, to_vec(0.5 * (p + q)), rough * greatest);
    const auto v = mesh.add_vertex(to_point(middle.point));
    mesh.set_normal(v, to_point(middle.gradient.normalized()));
    mesh.split(e, v);
  }
}

void decimate(Halfedges& mesh, double greatest, std::size_t faces) {
  constexpr double least_agreement = 0.5;
  constexpr double most = 0.35;  ///< of the edges are looked at in a round: the longer ones had better wait
  struct Candidate {
    double length;
    int edge;
    bool operator<(const Candidate& other) const {
      return length != other.length ? length < other.length : edge < other.edge;
    }
  };
  const SizeField sizes = measure_sizes(mesh, greatest);
  std::size_t count = mesh.n_faces();
  std::vector<Candidate> candidates;
  std::vector<bool> touched(mesh.n_vertices());
  const auto touch = [&](Halfedges::VertexHandle v) { touched[SizeField::index(v)] = true; };
  for (std::size_t collapses = 1; count > faces && collapses > 0;) {
    candidates.clear();
    for (int e = 0; e < static_cast<int>(mesh.n_edges()); ++e) {
      const Halfedges::EdgeHandle edge(e);
      if (!mesh.status(edge).deleted())
        candidates.push_back({mesh.calc_edge_length(edge) / sizes.along(mesh, edge), e});
    }
    const auto end = candidates.begin() + static_cast<std::ptrdiff_t>(most * static_cast<double>(candidates.size()));
    std::partial_sort(candidates.begin(), end, candidates.end());
    std::fill(touched.begin(), touched.end(), false);
    collapses = 0;
    for (auto it = candidates.begin(); it != end && count > faces; ++it) {
      const Halfedges::EdgeHandle edge(it->edge);
      if (mesh.status(edge).deleted()) continue;
      auto best = mesh.halfedge_handle(edge, 0);
      if (touched[SizeField::index(mesh.from_vertex_handle(best))] ||
          touched[SizeField::index(mesh.to_vertex_handle(best))])
        continue;
      const auto other = mesh.opposite_halfedge_handle(best);
      double agreed = agreement_after(mesh, best);
      if (const double turned = agreement_after(mesh, other); turned > agreed) {
        agreed = turned;
        best = other;
      }
      if (agreed < least_agreement || !mesh.is_collapse_ok(best)) continue;
      const auto kept = mesh.to_vertex_handle(best);
      mesh.collapse(best);
      touch(kept);
      for (auto v = mesh.cvv_iter(kept); v.is_valid(); ++v) touch(*v);
      count -= 2;
      ++collapses;
    }
  }
  mesh.garbage_collection();
}

}  // namespace toposcope
