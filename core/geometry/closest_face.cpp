// SPDX-License-Identifier: BSD-3-Clause
#include "toposcope/geometry/closest_face.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include "toposcope/geometry/lines.h"

namespace toposcope {
namespace {

constexpr Index leaf_size = 6;
constexpr std::size_t greatest_depth = 64;  // halving: 2^32 faces need 32

TrianglePoint on_side(const Vec3& p, const Vec3& q, const Vec3& x, std::size_t i, std::size_t j) {
  const SegmentPoint on = closest_on_segment(p, q, x);
  TrianglePoint result{on.point, {0, 0, 0}};
  result.weights[i] = 1 - on.t;
  result.weights[j] = on.t;
  return result;
}

double squared_distance_to_box(const Vec3& low, const Vec3& high, const Vec3& x) {
  return (low - x).cwiseMax(x - high).cwiseMax(0.0).squaredNorm();
}

}  // namespace

// By the regions of the triangle's plane (Ericson, Real-Time Collision Detection, 5.1.5).
TrianglePoint closest_on_triangle(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& x) {
  const Vec3 ab = b - a, ac = c - a, ax = x - a;
  const double d1 = ab.dot(ax), d2 = ac.dot(ax);
  if (d1 <= 0 && d2 <= 0) return {a, {1, 0, 0}};
  const Vec3 bx = x - b;
  const double d3 = ab.dot(bx), d4 = ac.dot(bx);
  if (d3 >= 0 && d4 <= d3) return {b, {0, 1, 0}};
  const Vec3 cx = x - c;
  const double d5 = ab.dot(cx), d6 = ac.dot(cx);
  if (d6 >= 0 && d5 <= d6) return {c, {0, 0, 1}};
  const double vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
  const double sum = va + vb + vc;
  // Nearly collinear corners have no plane to speak of.
  if (!(sum > 1e-14 * ab.squaredNorm() * ac.squaredNorm())) {
    TrianglePoint best = on_side(a, b, x, 0, 1);
    for (const TrianglePoint& side : {on_side(b, c, x, 1, 2), on_side(c, a, x, 2, 0)})
      if ((side.point - x).squaredNorm() < (best.point - x).squaredNorm()) best = side;
    return best;
  }
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return on_side(a, b, x, 0, 1);
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return on_side(a, c, x, 0, 2);
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) return on_side(b, c, x, 1, 2);
  const double v = vb / sum, w = vc / sum;
  return {a + v * ab + w * ac, {1 - v - w, v, w}};
}

ClosestFace::ClosestFace(std::span<const Vec3> positions, std::span<const Triangle> triangles)
    : positions_(positions), triangles_(triangles), order_(triangles.size()) {
  std::iota(order_.begin(), order_.end(), Index{0});
  std::vector<Vec3> centers;
  centers.reserve(triangles.size());
  for (const Triangle& t : triangles) centers.push_back((positions[t[0]] + positions[t[1]] + positions[t[2]]) / 3);
  nodes_.reserve(2 * triangles.size() / leaf_size + 2);
  nodes_.emplace_back();
  build(0, 0, static_cast<Index>(triangles.size()), centers);
}

// Halves by number along the longest side of the box, so the depth is the logarithm.
void ClosestFace::build(Index node, Index first, Index count, std::vector<Vec3>& centers) {
  const double far = std::numeric_limits<double>::infinity();
  Vec3 low(far, far, far), high(-far, -far, -far), inner_low = low, inner_high = high;
  for (Index i = first; i < first + count; ++i) {
    for (Index v : triangles_[order_[i]]) {
      low = low.cwiseMin(positions_[v]);
      high = high.cwiseMax(positions_[v]);
    }
    inner_low = inner_low.cwiseMin(centers[order_[i]]);
    inner_high = inner_high.cwiseMax(centers[order_[i]]);
  }
  nodes_[node] = {low, high, first, count};
  if (count <= leaf_size) return;
  Eigen::Index axis = 0;
  (inner_high - inner_low).maxCoeff(&axis);
  const auto begin = order_.begin() + first, middle = begin + count / 2;
  std::nth_element(begin, middle, begin + count, [&](Index f, Index g) {
    return centers[f][axis] != centers[g][axis] ? centers[f][axis] < centers[g][axis] : f < g;
  });
  const auto children = static_cast<Index>(nodes_.size());
  nodes_[node].first = children;
  nodes_[node].count = 0;
  nodes_.emplace_back();
  nodes_.emplace_back();
  build(children, first, count / 2, centers);
  build(children + 1, first + count / 2, count - count / 2, centers);
}

ClosestFace::Hit ClosestFace::operator()(const Vec3& x) const {
  Hit best;
  best.squared_distance = std::numeric_limits<double>::infinity();
  struct Entry {
    Index node;
    double squared_distance;
  };
  std::array<Entry, greatest_depth> stack;
  std::size_t size = 0;
  stack[size++] = {0, 0};
  while (size > 0) {
    const Entry entry = stack[--size];
    if (entry.squared_distance > best.squared_distance) continue;
    const Node& node = nodes_[entry.node];
    for (Index i = node.first; i < node.first + node.count; ++i) {
      const Index f = order_[i];
      const Triangle& t = triangles_[f];
      const Vec3 point = closest_on_triangle(positions_[t[0]], positions_[t[1]], positions_[t[2]], x).point;
      const double d = (point - x).squaredNorm();
      if (d < best.squared_distance || (d == best.squared_distance && f < best.face)) best = {f, point, d};
    }
    if (node.count > 0) continue;
    Entry near{node.first, squared_distance_to_box(nodes_[node.first].low, nodes_[node.first].high, x)};
    Entry far{node.first + 1, squared_distance_to_box(nodes_[node.first + 1].low, nodes_[node.first + 1].high, x)};
    if (far.squared_distance < near.squared_distance) std::swap(near, far);
    stack[size++] = far;
    stack[size++] = near;
  }
  return best;
}

std::vector<Index> nearest_faces(const MeshView& input, std::span<const Vec3> positions,
                                 std::span<const Triangle> triangles, Context& context) {
  const ClosestFace closest(input.positions, input.triangles);
  std::vector<Index> nearest(triangles.size());
  context.parallel_for(triangles.size(), 512, [&](std::size_t first, std::size_t last) {
    for (std::size_t f = first; f < last; ++f) {
      const Triangle& t = triangles[f];
      nearest[f] = closest((positions[t[0]] + positions[t[1]] + positions[t[2]]) / 3).face;
    }
  });
  return nearest;
}

}  // namespace toposcope
