// SPDX-License-Identifier: BSD-3-Clause
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "toposcope/curvature.h"
#include "toposcope/large_array.h"

namespace toposcope {
namespace {

constexpr std::size_t grain = 1024;

constexpr double reach = 2;              // radius of the neighbourhood, in mean edges around the vertex
constexpr double last_step = 0.75;       // of the radius: from farther out the walk goes no further
constexpr std::size_t most_points = 48;  // where a mesh is much finer here than on average, the nearest by steps
constexpr double faces_away = -0.3;      // cosine between normals
constexpr double ridge = 1e-5;           // of the squared reach; biases by less than 0.1 %

/// Least squares with six unknowns by the normal equations, unrolled: this is the inner loop of the estimate.
class SixUnknowns {
 public:
  using Row = std::array<double, 6>;

  void add(const Row& row, double value) {
    for (int i = 0; i < 6; ++i) {
      for (int j = 0; j <= i; ++j) gram_[i][j] += row[i] * row[j];
      right_[i] += value * row[i];
    }
  }
  void add_to_diagonal(int i, double value) { gram_[i][i] += value; }
  /// By L D L^T; the diagonal's ridge keeps the matrix definite.
  Row solve() {
    for (int j = 0; j < 6; ++j) {
      Row scaled;
      for (int k = 0; k < j; ++k) scaled[k] = gram_[j][k] * gram_[k][k];
      for (int k = 0; k < j; ++k) gram_[j][j] -= gram_[j][k] * scaled[k];
      for (int i = j + 1; i < 6; ++i) {
        for (int k = 0; k < j; ++k) gram_[i][j] -= gram_[i][k] * scaled[k];
        gram_[i][j] /= gram_[j][j];
      }
    }
    Row c = right_;
    for (int i = 0; i < 6; ++i)
      for (int k = 0; k < i; ++k) c[i] -= gram_[i][k] * c[k];
    for (int i = 0; i < 6; ++i) c[i] /= gram_[i][i];
    for (int i = 5; i >= 0; --i)
      for (int k = i + 1; k < 6; ++k) c[i] -= gram_[k][i] * c[k];
    return c;
  }

 private:
  double gram_[6][6] = {};
  Row right_ = {};
};

/// Vertices that a walk from p reaches without leaving the ball, p first.
class Neighbourhood {
 public:
  explicit Neighbourhood(const MeshView& mesh)
      : mesh_(mesh), reached_from_(large_array<Index>(mesh.vertex_count(), std::numeric_limits<Index>::max())) {}

  const std::vector<Index>& around(Index p) {
    const auto ring = mesh_.one_ring(p);
    const Vec3 here = mesh_.positions[p];
    points_.assign(1, p);
    reached_from_[p] = p;
    double edges = 0;
    for (Index q : ring) {
      edges += (mesh_.positions[q] - here).norm();
      reached_from_[q] = p;
      points_.push_back(q);
    }
    const double radius =
        reach * std::max(mesh_.mean_edge, edges / static_cast<double>(std::max<std::size_t>(1, ring.size())));
    const double squared = radius * radius, squared_turn = last_step * last_step * squared;
    for (std::size_t i = 1; i < points_.size() && points_.size() < most_points; ++i) {
      if ((mesh_.positions[points_[i]] - here).squaredNorm() > squared_turn) continue;
      for (Index q : mesh_.one_ring(points_[i]))
        if (reached_from_[q] != p && (mesh_.positions[q] - here).squaredNorm() <= squared) {
          reached_from_[q] = p;
          points_.push_back(q);
        }
    }
    return points_;
  }

 private:
  const MeshView& mesh_;
  std::vector<Index> points_, reached_from_;
};

/// Fits z = c0 + c1 x + c2 y + c3 x^2/2 + c4 xy + c5 y^2/2 and turns its second fundamental form into the frame of the
/// quadric's own normal at p.
void fit_quadric(const MeshView& mesh, const std::vector<Vec3>& normals, std::span<const Index> points, Vec3& normal,
                 ShapeOperator& fitted) {
  const Index p = points.front();
  const Vec3 axis = normals[p];
  const auto [u, v] = tangent_frame(axis);
  double squared_reach = 0;
  for (Index q : points) squared_reach = std::max(squared_reach, (mesh.positions[q] - mesh.positions[p]).squaredNorm());
  if (squared_reach == 0) return;
  const double scale = std::sqrt(squared_reach);

  SixUnknowns quadric;
  double count = 0;
  for (Index q : points) {
    if (normals[q].dot(axis) < faces_away) continue;
    const Vec3 d = (mesh.positions[q] - mesh.positions[p]) / scale;
    const double x = d.dot(u), y = d.dot(v), flat = x * x + y * y;
    // A circle through p with a chord d bends by 2 z / d^2, not by 2 z / (x^2 + y^2) as a parabola does: with chords in
    // place of their shadows spheres are exact, and a fold never bends more than its points are close.
    const double stretch = flat > 0 ? d.squaredNorm() / flat : 0;
    quadric.add({1, x, y, stretch * x * x / 2, stretch * x * y, stretch * y * y / 2}, d.dot(axis));
    ++count;
  }
  constexpr double rounding = 1e-12;  // keeps a neighbourhood on one line solvable
  for (int i = 0; i < 3; ++i) quadric.add_to_diagonal(i, rounding * count);
  for (int i = 3; i < 6; ++i) quadric.add_to_diagonal(i, (i == 4 ? 2 : 1) * ridge * count);  // the Hessian's norm
  const std::array<double, 6> c = quadric.solve();
  for (double coefficient : c)
    if (!std::isfinite(coefficient)) return;

  const double slope = std::sqrt(1 + c[1] * c[1] + c[2] * c[2]);
  normal = (axis - c[1] * u - c[2] * v) / slope;
  const auto [s, t] = tangent_frame(normal);
  // A tangent vector's second fundamental form depends on its components along the graph's parameters alone.
  const auto form = [&](const Vec3& a, const Vec3& b) {
    const double ax = a.dot(u), ay = a.dot(v), bx = b.dot(u), by = b.dot(v);
    return -(c[3] * ax * bx + c[4] * (ax * by + ay * bx) + c[5] * ay * by) / (slope * scale);
  };
  const double ss = form(s, s), tt = form(t, t);
  fitted = {(ss + tt) / 2, (ss - tt) / 2, form(s, t)};
}

/// The turning by twice the angle between a tangent plane's frame, carried to another plane, and the frame there.
struct DoubleTurn {
  float cosine = 0, sine = 0;  // both 0 where the planes face away from each other: nothing is carried
};

DoubleTurn carry(const Vec3& from, const Vec3& to, const TangentFrame& there) {
  const double cosine = from.dot(to);
  if (cosine < faces_away) return {};
  const Vec3 u = tangent_frame(from).u;
  const Vec3 carried = u - (to.dot(u) / (1 + cosine)) * (from + to);
  const double x = carried.dot(there.u), y = carried.dot(there.v), norm = x * x + y * y;
  if (!(norm > 0)) return {};
  return {static_cast<float>((x * x - y * y) / norm), static_cast<float>(2 * x * y / norm)};
}

}  // namespace

TangentFrame tangent_frame(const Vec3& n) {
  const double sign = std::copysign(1.0, n.z()), a = -1 / (sign + n.z()), b = n.x() * n.y() * a;
  return {{1 + sign * n.x() * n.x() * a, sign * b, -sign * n.x()}, {b, sign + n.y() * n.y() * a, -n.y()}};
}

std::vector<Vec3> vertex_normals(const MeshView& mesh, Context& context) {
  std::vector<Vec3> normals = large_array<Vec3>(mesh.vertex_count());
  context.parallel_for(mesh.vertex_count(), grain, [&](std::size_t first, std::size_t last) {
    for (Index v = static_cast<Index>(first); v < last; ++v) {
      Vec3 sum = Vec3::Zero();
      for (Index f : mesh.faces_of(v)) {
        const Triangle& t = mesh.triangles[f];
        const std::size_t k = t[0] == v ? 0 : t[1] == v ? 1 : 2;
        const Vec3 a = mesh.positions[t[(k + 1) % 3]] - mesh.positions[v];
        const Vec3 b = mesh.positions[t[(k + 2) % 3]] - mesh.positions[v];
        const double squares = a.squaredNorm() * b.squaredNorm();
        if (squares > 0) sum += a.cross(b) * (mesh.mean_edge * mesh.mean_edge / squares);
      }
      normals[v] = sum.stableNormalized();
    }
  });
  return normals;
}

ShapeOperators fit_shape_operators(const MeshView& mesh, Context& context) {
  const std::vector<Vec3> normals = vertex_normals(mesh, context);
  ShapeOperators operators;
  reserve_large(operators.normals, normals.size());
  operators.normals = normals;
  operators.at = large_array<ShapeOperator>(normals.size());
  // Few chunks: each has a mark per vertex of the mesh.
  const std::size_t chunk = std::max<std::size_t>(grain, mesh.vertex_count() / 16);
  context.parallel_for(mesh.vertex_count(), chunk, [&](std::size_t first, std::size_t last) {
    Neighbourhood neighbourhood(mesh);
    for (Index p = static_cast<Index>(first); p < last; ++p) {
      if (p % grain == 0 && context.cancelled()) return;
      fit_quadric(mesh, normals, neighbourhood.around(p), operators.normals[p], operators.at[p]);
    }
  });
  return operators;
}

void diffuse(const MeshView& mesh, ShapeOperators& operators, int passes, Context& context) {
  if (passes == 0) return;
  const std::vector<Vec3>& normals = operators.normals;
  std::vector<DoubleTurn> turns = large_array<DoubleTurn>(mesh.neighbors.size());
  context.parallel_for(mesh.vertex_count(), grain, [&](std::size_t first, std::size_t last) {
    for (Index p = static_cast<Index>(first); p < last; ++p) {
      const TangentFrame frame = tangent_frame(normals[p]);
      for (Index i = mesh.neighbor_offsets[p]; i < mesh.neighbor_offsets[p + 1]; ++i)
        turns[i] = carry(normals[mesh.neighbors[i]], normals[p], frame);
    }
  });
  std::vector<ShapeOperator> next = large_array<ShapeOperator>(operators.at.size());
  for (int pass = 0; pass < passes && !context.cancelled(); ++pass) {
    context.parallel_for(mesh.vertex_count(), grain, [&](std::size_t first, std::size_t last) {
      for (Index p = static_cast<Index>(first); p < last; ++p) {
        ShapeOperator sum = operators.at[p];
        double count = 1;
        for (Index i = mesh.neighbor_offsets[p]; i < mesh.neighbor_offsets[p + 1]; ++i) {
          const ShapeOperator& other = operators.at[mesh.neighbors[i]];
          const double cosine = turns[i].cosine, sine = turns[i].sine;
          if (cosine == 0 && sine == 0) continue;
          sum.mean += other.mean;
          sum.deviator_x += cosine * other.deviator_x - sine * other.deviator_y;
          sum.deviator_y += sine * other.deviator_x + cosine * other.deviator_y;
          ++count;
        }
        next[p] = {sum.mean / count, sum.deviator_x / count, sum.deviator_y / count};
      }
    });
    operators.at.swap(next);
  }
}

int diffusion_passes(const MeshView& mesh, double deviation, int least) {
  constexpr double variance_per_pass = 0.43;  // 6/7 of half a squared edge: six neighbours and the vertex itself
  constexpr double most = 12;
  const double edges = deviation / mesh.mean_edge;
  return static_cast<int>(std::clamp(std::round(edges * edges / variance_per_pass), static_cast<double>(least), most));
}

Curvature principal_curvatures(const ShapeOperators& operators) {
  Curvature curvature;
  reserve_large(curvature.maximum, operators.at.size());
  reserve_large(curvature.minimum, operators.at.size());
  for (const auto& [mean, x, y] : operators.at) {
    const double half = std::sqrt(x * x + y * y);
    curvature.maximum.push_back(mean + half);
    curvature.minimum.push_back(mean - half);
  }
  return curvature;
}

}  // namespace toposcope
