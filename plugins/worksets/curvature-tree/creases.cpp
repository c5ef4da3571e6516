// SPDX-License-Identifier: BSD-3-Clause

// Tessellations read by their creases. Between creases flat faces are exact, and where a surface bends its facets are
// about equally wide: so a rounding ends where a flat wall begins, although the surface goes on smoothly.

#include "creases.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "crease_lines.h"

namespace creases {
namespace {

using component_tree::Components;
using toposcope::Index;
using toposcope::MeshView;
using toposcope::Triangle;
using toposcope::Vec3;

constexpr double flat = 1e-3;    // rad: faces that make one facet
constexpr double alike = 3;      // ratio of the widths of facets of one bend
constexpr double one_way = 0.9;  // of the turning of a part that is convex or concave

class Groups {
 public:
  explicit Groups(Index count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), Index{0}); }
  Index find(Index i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(Index a, Index b) {
    a = find(a), b = find(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<Index> parent_;
};

struct Facet {
  double area = 0, bent = 0;  ///< and the length of edges at which the surface goes on, bent
  double width() const { return bent > 0 ? 2 * area / bent : std::numeric_limits<double>::infinity(); }
};

struct Turning {
  double convex = 0, concave = 0;
};

/// Faces by the part that they belong to, in compressed rows; parts in the order of their first faces.
struct Rows {
  std::vector<Index> offsets = {0}, faces;
};
Rows rows_of(Groups& groups, Index count) {
  std::vector<Index> number(count, toposcope::no_vertex);
  Rows rows;
  for (Index f = 0; f < count; ++f)
    if (groups.find(f) == f) {
      number[f] = static_cast<Index>(rows.offsets.size() - 1);
      rows.offsets.push_back(0);
    }
  for (Index f = 0; f < count; ++f) ++rows.offsets[number[groups.find(f)] + 1];
  std::partial_sum(rows.offsets.begin(), rows.offsets.end(), rows.offsets.begin());
  std::vector<Index> next(rows.offsets.begin(), rows.offsets.end() - 1);
  rows.faces.resize(count);
  for (Index f = 0; f < count; ++f) rows.faces[next[number[groups.find(f)]]++] = f;
  return rows;
}

/// Takes sets of vertices of faces, each vertex once.
class Collector {
 public:
  Collector(const MeshView& mesh, Index min_vertices)
      : mesh_(mesh), min_vertices_(min_vertices), mark_(mesh.vertex_count(), 0) {}

  /// The vertices of these faces; and those of them of which all faces are among these, where they are connected.
  void add(std::span<const Index> faces, Components& to) {
    all_.clear();
    for (const Index f : faces)
      for (const Index v : mesh_.triangles[f])
        if (mark_[v]++ == 0) all_.push_back(v);
    std::sort(all_.begin(), all_.end());
    inner_.clear();
    for (const Index v : all_)
      if (mark_[v] == mesh_.faces_of(v).size()) inner_.push_back(v);
    for (const Index v : all_) mark_[v] = 0;
    add(all_, 1, to);
    if (inner_.size() < all_.size() && connected()) add(inner_, 1, to);
  }
  void add(std::span<const Index> vertices, double saliency, Components& to) const {
    if (vertices.size() < min_vertices_) return;
    to.vertices.insert(to.vertices.end(), vertices.begin(), vertices.end());
    to.offsets.push_back(to.vertices.size());
    to.saliency.push_back(saliency);
  }

 private:
  bool connected() {
    if (inner_.empty()) return false;
    for (const Index v : inner_) mark_[v] = 1;
    reached_.assign(1, inner_.front());
    mark_[inner_.front()] = 0;
    for (std::size_t i = 0; i < reached_.size(); ++i)
      for (const Index q : mesh_.one_ring(reached_[i]))
        if (mark_[q] == 1) {
          mark_[q] = 0;
          reached_.push_back(q);
        }
    for (const Index v : inner_) mark_[v] = 0;
    return reached_.size() == inner_.size();
  }

  const MeshView& mesh_;
  Index min_vertices_;
  std::vector<std::uint32_t> mark_;
  std::vector<Index> all_, inner_, reached_;
};

/// The largest parts first, so that a limit leaves out small ones.
std::vector<Index> by_area(const Rows& rows, const std::vector<double>& area) {
  std::vector<double> total(rows.offsets.size() - 1, 0);
  for (Index part = 0; part < total.size(); ++part)
    for (Index i = rows.offsets[part]; i < rows.offsets[part + 1]; ++i) total[part] += area[rows.faces[i]];
  std::vector<Index> order(total.size());
  std::iota(order.begin(), order.end(), Index{0});
  std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) { return total[a] > total[b]; });
  return order;
}

}  // namespace

Parts parts_of(const MeshView& mesh, const component_tree::Limits& limits) {
  const Index count = mesh.face_count();
  std::vector<double> area(count);
  for (Index f = 0; f < count; ++f) area[f] = twice_area(mesh, f).norm() / 2;
  const std::vector<Edge> edges = edges_of(mesh);

  Groups facets(count);
  for (const Edge& e : edges)
    if (std::abs(e.turn) < flat) facets.join(e.left, e.right);
  std::vector<Facet> facet(count);
  for (Index f = 0; f < count; ++f) facet[facets.find(f)].area += area[f];
  for (const Edge& e : edges)
    if (std::abs(e.turn) >= flat && std::abs(e.turn) < sharp)
      for (const Index f : {e.left, e.right}) facet[facets.find(f)].bent += e.length;
  Groups parts(count);
  for (const Edge& e : edges) {
    if (std::abs(e.turn) >= sharp) continue;
    const double a = facet[facets.find(e.left)].width(), b = facet[facets.find(e.right)].width();
    if (std::abs(e.turn) < flat || std::max(a, b) <= alike * std::min(a, b)) parts.join(e.left, e.right);
  }
  std::vector<Turning> turning(count);
  for (const Edge& e : edges) {
    if (std::abs(e.turn) < flat || parts.find(e.left) != parts.find(e.right)) continue;
    Turning& here = turning[parts.find(e.left)];
    (e.turn > 0 ? here.convex : here.concave) += e.length * std::abs(e.turn);
  }

  Parts found;
  found.flat.resize(mesh.vertex_count(), false);
  if (!mesh.input_vertices.empty())
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      const auto faces = mesh.faces_of(v);
      if (faces.empty() || mesh.input_vertices[v] != toposcope::no_vertex) continue;
      const Index part = parts.find(faces.front());
      const bool inside = std::all_of(faces.begin(), faces.end(), [&](Index f) { return parts.find(f) == part; });
      found.flat[v] = inside && turning[part].convex + turning[part].concave == 0;
    }
  Collector collector(mesh, limits.min_vertices);
  for (const Line& line : crease_lines(mesh, edges))
    if (Components& to = line.convex ? found.convex : found.concave; to.size() < limits.max_components)
      collector.add(line.vertices, 1, to);
  const Rows rows = rows_of(parts, count);
  for (const Index part : by_area(rows, area)) {
    const std::span<const Index> faces =
        std::span(rows.faces).subspan(rows.offsets[part], rows.offsets[part + 1] - rows.offsets[part]);
    const auto [convex, concave] = turning[parts.find(faces.front())];
    Components* to = nullptr;
    if (convex + concave == 0)
      to = &found.planar;
    else if (convex >= one_way * (convex + concave))
      to = &found.convex;
    else if (concave >= one_way * (convex + concave))
      to = &found.concave;
    if (to != nullptr && to->size() < 2 * limits.max_components) collector.add(faces, *to);
  }
  return found;
}

}  // namespace creases
