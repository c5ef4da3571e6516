// SPDX-License-Identifier: BSD-3-Clause
#include "convex_hull.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

#include "toposcope/geometry/point_sets.h"

namespace toposcope::geometry {
namespace {

constexpr Index none = std::numeric_limits<Index>::max();
constexpr double inside_tolerance = 1e-10;  ///< in normalized coordinates
constexpr double tie_tolerance = 1e-12;

/// Picks the greatest value; among equals the point farthest from the middle. A convex function over a face has its
/// maximum at a corner, so what is picked is an extreme point and not just some point of a flat side.
struct Farthest {
  Index point = none;
  double value = -std::numeric_limits<double>::infinity();
  double radius = 0;

  void offer(Index candidate, double candidate_value, double candidate_radius) {
    if (candidate_value < value - tie_tolerance) return;
    if (candidate_value <= value + tie_tolerance && candidate_radius <= radius) return;
    *this = {candidate, candidate_value, candidate_radius};
  }
};

struct Face {
  std::array<Index, 3> vertices{};
  std::array<Index, 3> across{};  ///< face beyond the edge from vertex i to i + 1
  Vec3 normal;
  double offset = 0;
  Index outside = none;  ///< first of a linked list of points beyond the face
  bool alive = true;
  bool visible = false;
};

struct HorizonEdge {
  Index from, to;
  Index face;  ///< the face that stays
  std::size_t edge;
};

class Quickhull {
 public:
  explicit Quickhull(std::span<const Vec3> points) : points_(points), next_(points.size(), none) {}

  std::vector<Triangle> run() {
    std::vector<Triangle> triangles;
    if (!make_simplex()) return triangles;
    for (Index f = 0; f < faces_.size(); ++f)
      while (faces_[f].alive && faces_[f].outside != none) add_farthest(f);
    for (const Face& face : faces_)
      if (face.alive) triangles.push_back(face.vertices);
    return triangles;
  }

 private:
  double distance(const Face& face, Index p) const { return face.normal.dot(points_[p]) - face.offset; }

  template <class Value>
  Farthest farthest(Value value) const {
    Farthest best;
    for (Index p = 0; p < points_.size(); ++p) best.offer(p, value(points_[p]), points_[p].squaredNorm());
    return best;
  }

  Face make_face(Index a, Index b, Index c) const {
    Face face;
    face.vertices = {a, b, c};
    face.normal = (points_[b] - points_[a]).cross(points_[c] - points_[a]).stableNormalized();
    face.offset = face.normal.dot(points_[a] + points_[b] + points_[c]) / 3;
    return face;
  }

  bool make_simplex() {
    if (points_.size() < 4) return false;
    const Index a = farthest([](const Vec3& p) { return -p.x(); }).point;
    const Index b = farthest([&](const Vec3& p) { return (p - points_[a]).norm(); }).point;
    const Vec3 along = (points_[b] - points_[a]).stableNormalized();
    const auto [c, from_line, r] = farthest([&](const Vec3& p) { return along.cross(p - points_[a]).norm(); });
    if (from_line <= inside_tolerance) return false;
    const Face base = make_face(a, b, c);
    const auto height = [&](const Vec3& p) { return base.normal.dot(p) - base.offset; };
    const auto [d, from_plane, s] = farthest([&](const Vec3& p) { return std::abs(height(p)); });
    if (from_plane <= inside_tolerance) return false;
    const auto [u, v, w] = height(points_[d]) < 0 ? std::array{a, b, c} : std::array{a, c, b};
    faces_ = {make_face(u, v, w), make_face(u, d, v), make_face(v, d, w), make_face(w, d, u)};
    faces_[0].across = {1, 2, 3};
    faces_[1].across = {3, 2, 0};
    faces_[2].across = {1, 3, 0};
    faces_[3].across = {2, 1, 0};
    for (Index p = 0; p < points_.size(); ++p) assign(p, 0);
    return true;
  }

  /// Puts a point on the list of the first face from `first` on that it lies beyond.
  void assign(Index p, Index first) {
    for (Index f = first; f < faces_.size(); ++f)
      if (distance(faces_[f], p) > inside_tolerance) {
        next_[p] = faces_[f].outside;
        faces_[f].outside = p;
        return;
      }
  }

  void add_farthest(Index f) {
    Farthest best;
    for (Index p = faces_[f].outside; p != none; p = next_[p])
      best.offer(p, distance(faces_[f], p), points_[p].squaredNorm());
    find_horizon(f, best.point);
    if (!closed_horizon()) {  // rounding: the point is no farther out than that, so leave it inside
      for (Index v : visible_) faces_[v].visible = false;
      remove_outside(f, best.point);
      return;
    }
    add_cone(best.point);
  }

  void remove_outside(Index f, Index point) {
    Index* link = &faces_[f].outside;
    while (*link != point) link = &next_[*link];
    *link = next_[point];
  }

  /// Walks over all faces that see `eye`, depth first and edges in order, so that the horizon comes out as a cycle.
  void find_horizon(Index start, Index eye) {
    struct Step {
      Index face;
      std::size_t edge, left;
    };
    horizon_.clear();
    visible_.assign(1, start);
    faces_[start].visible = true;
    std::vector<Step> stack{{start, 0, 3}};
    while (!stack.empty()) {
      Step& step = stack.back();
      if (step.left-- == 0) {
        stack.pop_back();
        continue;
      }
      const Face& face = faces_[step.face];
      const std::size_t edge = step.edge;
      step.edge = (edge + 1) % 3;
      const Index other = face.across[edge];
      if (faces_[other].visible) continue;
      const Index to = face.vertices[(edge + 1) % 3];
      std::size_t back = 0;
      while (faces_[other].vertices[back] != to) ++back;
      if (distance(faces_[other], eye) > inside_tolerance) {
        faces_[other].visible = true;
        visible_.push_back(other);
        stack.push_back({other, (back + 1) % 3, 2});
      } else {
        horizon_.push_back({face.vertices[edge], to, other, back});
      }
    }
  }

  bool closed_horizon() const {
    for (std::size_t i = 0; i < horizon_.size(); ++i)
      if (horizon_[i].to != horizon_[(i + 1) % horizon_.size()].from) return false;
    return horizon_.size() >= 3;
  }

  void add_cone(Index eye) {
    const Index first = static_cast<Index>(faces_.size()), count = static_cast<Index>(horizon_.size());
    for (Index i = 0; i < count; ++i) {
      const HorizonEdge& edge = horizon_[i];
      faces_.push_back(make_face(edge.from, edge.to, eye));
      faces_.back().across = {edge.face, first + (i + 1) % count, first + (i + count - 1) % count};
      faces_[edge.face].across[edge.edge] = first + i;
    }
    for (Index f : visible_) {
      faces_[f].alive = faces_[f].visible = false;
      for (Index p = faces_[f].outside; p != none;) {
        const Index following = next_[p];
        if (p != eye) assign(p, first);
        p = following;
      }
    }
  }

  std::span<const Vec3> points_;
  std::vector<Index> next_;
  std::vector<Face> faces_;
  std::vector<HorizonEdge> horizon_;
  std::vector<Index> visible_;
};

}  // namespace

std::vector<Triangle> convex_hull(std::span<const Vec3> points) {
  return Quickhull(points).run();
}

}  // namespace toposcope::geometry

namespace toposcope {

std::vector<Index> hull_vertices(std::span<const Vec3> points) {
  std::vector<Index> vertices;
  if (points.empty()) return vertices;
  const geometry::PrincipalFrame frame = geometry::principal_frame(points);
  if (frame.dimension == 0) return {0};
  std::vector<Vec3> normalized;
  normalized.reserve(points.size());
  for (const Vec3& p : points) normalized.push_back(frame.normalized(p));
  if (frame.dimension == 3)
    for (const Triangle& t : geometry::convex_hull(normalized)) vertices.insert(vertices.end(), t.begin(), t.end());
  if (vertices.empty()) {  // flat, linear or a single place
    std::vector<Eigen::Vector2d> flat;
    flat.reserve(points.size());
    for (const Vec3& p : normalized) flat.push_back(p.head<2>());
    vertices = geometry::convex_polygon(flat);
  }
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  return vertices;
}

}  // namespace toposcope
