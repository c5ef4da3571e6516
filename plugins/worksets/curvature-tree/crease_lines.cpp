// SPDX-License-Identifier: BSD-3-Clause
#include "crease_lines.h"

#include <array>
#include <cmath>
#include <optional>

namespace creases {
namespace {

constexpr double corner = 50 * toposcope::pi / 180;  // between two edges of a line

/// The face in which an edge runs from a to b, where there is just one.
std::optional<Index> face_along(const MeshView& mesh, Index a, Index b) {
  std::optional<Index> found;
  for (const Index f : mesh.faces_of(a)) {
    const auto& t = mesh.triangles[f];
    for (std::size_t k = 0; k < 3; ++k)
      if (t[k] == a && t[(k + 1) % 3] == b) {
        if (found) return std::nullopt;
        found = f;
      }
  }
  return found;
}

/// The two creases at a vertex of a line.
struct Joint {
  std::array<Index, 2> edges = {toposcope::no_vertex, toposcope::no_vertex};
  int count = 0;
};

class Tracer {
 public:
  Tracer(const MeshView& mesh, const std::vector<Edge>& edges)
      : mesh_(mesh), edges_(edges), joints_(mesh.vertex_count()), used_(edges.size(), false) {
    for (Index e = 0; e < edges.size(); ++e) {
      if (std::abs(edges[e].turn) < sharp) continue;
      for (const Index v : {edges[e].from, edges[e].to})
        if (Joint& joint = joints_[v]; joint.count++ < 2) joint.edges[static_cast<std::size_t>(joint.count - 1)] = e;
    }
  }

  std::vector<Line> run() {
    std::vector<Line> lines;
    // First what has ends, then what is closed.
    for (const bool ends : {true, false})
      for (Index e = 0; e < edges_.size(); ++e) {
        if (std::abs(edges_[e].turn) < sharp || used_[e]) continue;
        for (const Index end : {edges_[e].from, edges_[e].to})
          if (!used_[e] && (!ends || !goes_on(end))) lines.push_back(trace(e, end));
      }
    return lines;
  }

 private:
  bool goes_on(Index v) const {
    const Joint& joint = joints_[v];
    if (joint.count != 2) return false;
    const Edge &a = edges_[joint.edges[0]], &b = edges_[joint.edges[1]];
    if ((a.turn > 0) != (b.turn > 0)) return false;
    const Vec3 in = mesh_.positions[v] - mesh_.positions[other(a, v)];
    const Vec3 out = mesh_.positions[other(b, v)] - mesh_.positions[v];
    return in.dot(out) > std::cos(corner) * in.norm() * out.norm();
  }
  static Index other(const Edge& edge, Index v) { return edge.from == v ? edge.to : edge.from; }

  Line trace(Index e, Index v) {
    Line line{{v}, edges_[e].turn > 0};
    const Index begin = v;
    while (true) {
      used_[e] = true;
      v = other(edges_[e], v);
      if (v == begin) {
        line.closed = true;
        return line;
      }
      line.vertices.push_back(v);
      if (!goes_on(v)) return line;
      const Joint& joint = joints_[v];
      e = joint.edges[0] == e ? joint.edges[1] : joint.edges[0];
      if (used_[e]) return line;
    }
  }

  const MeshView& mesh_;
  const std::vector<Edge>& edges_;
  std::vector<Joint> joints_;
  std::vector<bool> used_;
};

}  // namespace

std::vector<Edge> edges_of(const MeshView& mesh) {
  std::vector<Vec3> normals(mesh.face_count());
  for (Index f = 0; f < mesh.face_count(); ++f) normals[f] = twice_area(mesh, f).stableNormalized();
  std::vector<Edge> edges;
  edges.reserve(mesh.neighbors.size() / 2);
  for (Index a = 0; a < mesh.vertex_count(); ++a)
    for (const Index b : mesh.one_ring(a)) {
      if (b < a) continue;
      const auto left = face_along(mesh, a, b), right = face_along(mesh, b, a);
      if (!left || !right) continue;
      const Vec3 along = mesh.positions[b] - mesh.positions[a];
      const double length = along.norm();
      if (!(length > 0)) continue;
      const double sine = normals[*left].cross(normals[*right]).dot(along) / length;
      edges.push_back({a, b, *left, *right, std::atan2(sine, normals[*left].dot(normals[*right])), length});
    }
  return edges;
}

std::vector<Line> crease_lines(const MeshView& mesh, const std::vector<Edge>& edges) {
  return Tracer(mesh, edges).run();
}

}  // namespace creases
