// SPDX-License-Identifier: BSD-3-Clause
#include "sample/remesh.h"

#include <algorithm>
#include <cmath>

#include "sample/remesh_steps.h"

namespace toposcope {

namespace {

/// Distance of an edge's middle from the surface.
double chord_error(const Implicit& surface, const Point& p, const Point& q) {
  return std::abs(surface(to_vec(0.5 * (p + q))).value);
}

/// Flips edges whose opposite angles sum to more than pi where the new edge follows the surface as well, and edges that
/// leave the surface where the new one follows it better.
std::size_t flip_edges(Halfedges& mesh, const Implicit& surface) {
  std::size_t flips = 0;
  for (const auto edge : mesh.edges()) {
    const auto h = mesh.halfedge_handle(edge, 0), o = mesh.halfedge_handle(edge, 1);
    const auto p = mesh.from_vertex_handle(h), q = mesh.to_vertex_handle(h);
    const auto a = mesh.to_vertex_handle(mesh.next_halfedge_handle(h)),
               b = mesh.to_vertex_handle(mesh.next_halfedge_handle(o));
    const Point &pp = mesh.point(p), &pq = mesh.point(q), &pa = mesh.point(a), &pb = mesh.point(b);
    const auto cotangent = [](const Point& apex, const Point& u, const Point& v) {
      const double area = ((u - apex) % (v - apex)).norm();
      return ((u - apex) | (v - apex)) / std::max(area, 1e-300);
    };
    const double delaunay = cotangent(pa, pp, pq) + cotangent(pb, pp, pq);
    if (delaunay > 1 || mesh.valence(p) < 5 || mesh.valence(q) < 5 || !mesh.is_flip_ok(edge)) continue;
    const Point &np = mesh.normal(p), &nq = mesh.normal(q), &na = mesh.normal(a), &nb = mesh.normal(b);
    const double before = std::min(agreement(pp, pq, pa, np + nq + na), agreement(pq, pp, pb, np + nq + nb));
    const double after = std::min(agreement(pp, pb, pa, np + nb + na), agreement(pq, pa, pb, nq + na + nb));
    if (after < std::min(0.8, before)) continue;
    const double length = (pa - pb).norm();
    // Only an edge between normals that differ can leave the surface.
    if (delaunay >= -1e-3 && (np | nq) > 0.9) continue;
    const double error = chord_error(surface, pp, pq), new_error = chord_error(surface, pa, pb);
    const bool rounder = delaunay < -1e-3 && new_error <= error + 0.02 * length;
    const bool closer = error > 0.08 * length && new_error < 0.5 * error;
    if (!rounder && !closer) continue;
    mesh.flip(edge);
    ++flips;
  }
  return flips;
}

/// Moves every vertex towards the mean of its neighbours, weighted by the faces between them in units of the target
/// size, in its tangent plane, then back onto the surface. A vertex stays where it would leave its sheet of a thin wall
/// or turn a face over.
void relax(Halfedges& mesh, const Implicit& surface, double greatest, Context& context) {
  const SizeField sizes = measure_sizes(mesh, greatest);
  const std::size_t count = mesh.n_vertices();
  std::vector<Point> moved(count), normals(count);
  context.parallel_for(count, 512, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      const Halfedges::VertexHandle v(static_cast<int>(i));
      const Point here = mesh.point(v), normal = mesh.normal(v);
      moved[i] = here;
      normals[i] = normal;
      Point sum(0, 0, 0);
      double weight = 0;
      for (auto it = mesh.cvoh_iter(v); it.is_valid(); ++it) {
        const auto b = mesh.to_vertex_handle(*it), c = mesh.to_vertex_handle(mesh.next_halfedge_handle(*it));
        const Point &p = mesh.point(b), &q = mesh.point(c);
        const double size = sizes.target[i] + sizes.target[SizeField::index(b)] + sizes.target[SizeField::index(c)];
        const double mass = ((p - here) % (q - here)).norm() / (size * size * size);
        sum += mass * (p + q + here) / 3.0;
        weight += mass;
      }
      if (!(weight > 0)) continue;
      Point step = sum / weight - here;
      step -= (step | normal) * normal;
      const Foot foot = settle(surface, to_vec(here + 0.7 * step), rough * greatest);
      const Point there = to_point(foot.point), facing = to_point(foot.gradient.normalized());
      if ((here - there).sqrnorm() > 4 * step.sqrnorm() + rough * rough * greatest * greatest) continue;
      if ((facing | normal) < 0.5) continue;
      bool sound = true;
      for (auto it = mesh.cvoh_iter(v); it.is_valid() && sound; ++it) {
        const auto b = mesh.to_vertex_handle(*it), c = mesh.to_vertex_handle(mesh.next_halfedge_handle(*it));
        const double before = agreement(here, mesh.point(b), mesh.point(c), normal + mesh.normal(b) + mesh.normal(c));
        const double after = agreement(there, mesh.point(b), mesh.point(c), facing + mesh.normal(b) + mesh.normal(c));
        sound = after >= std::min(before, 0.5);
      }
      if (!sound) continue;
      moved[i] = there;
      normals[i] = facing;
    }
  });
  for (std::size_t i = 0; i < count; ++i) {
    const Halfedges::VertexHandle v(static_cast<int>(i));
    mesh.set_point(v, moved[i]);
    mesh.set_normal(v, normals[i]);
  }
}

void improve(Halfedges& mesh, const Implicit& surface, double greatest, int rounds, Context& context) {
  for (int i = 0; i < rounds && !context.cancelled(); ++i) {
    flip_edges(mesh, surface);
    relax(mesh, surface, greatest, context);
  }
}

Halfedges to_halfedges(const TriangleSoup& soup, const Implicit& surface, Context& context) {
  Halfedges mesh;
  mesh.reserve(soup.positions.size(), 3 * soup.triangles.size() / 2, soup.triangles.size());
  for (const Vec3& p : soup.positions) mesh.add_vertex(to_point(p));
  context.parallel_for(soup.positions.size(), 1024, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i)
      mesh.set_normal(Halfedges::VertexHandle(static_cast<int>(i)),
                      to_point(surface(soup.positions[i]).gradient.normalized()));
  });
  for (const Triangle& t : soup.triangles)
    mesh.add_face(Halfedges::VertexHandle(static_cast<int>(t[0])), Halfedges::VertexHandle(static_cast<int>(t[1])),
                  Halfedges::VertexHandle(static_cast<int>(t[2])));
  return mesh;
}

}  // namespace

TriangleSoup remesh(const TriangleSoup& soup, const Implicit& surface, Index faces, Context& context) {
  Halfedges mesh = to_halfedges(soup, surface, context);
  double scale = 0;
  for (const Vec3& p : soup.positions) scale = std::max(scale, (p - soup.positions.front()).norm());

  double area = 0;
  for (const auto f : mesh.faces()) area += mesh.calc_face_area(f);
  const double even = std::sqrt(4 / std::sqrt(3.0) * area / faces);  // edge of equal equilateral triangles

  // In two steps: the second sees well-shaped triangles, so that few are left that could not be collapsed.
  improve(mesh, surface, even, 1, context);
  split_edges(mesh, surface, even);
  decimate(mesh, even, static_cast<std::size_t>(1.4 * faces));
  improve(mesh, surface, even, 3, context);
  for (int attempt = 0; attempt < 4 && mesh.n_faces() > faces + 1; ++attempt) {
    decimate(mesh, even, faces);
    improve(mesh, surface, even, 4, context);
  }
  improve(mesh, surface, even, 8, context);

  TriangleSoup result;
  result.positions.reserve(mesh.n_vertices());
  for (const auto v : mesh.vertices()) result.positions.push_back(to_vec(mesh.point(v)));
  context.parallel_for(result.positions.size(), 512, [&](std::size_t first, std::size_t last) {
    for (std::size_t v = first; v < last; ++v) result.positions[v] = project(surface, result.positions[v], scale);
  });
  for (const auto f : mesh.faces()) {
    Triangle triangle;
    std::size_t corner = 0;
    for (const auto v : mesh.fv_range(f)) triangle[corner++] = static_cast<Index>(v.idx());
    result.triangles.push_back(triangle);
  }
  return result;
}

}  // namespace toposcope
