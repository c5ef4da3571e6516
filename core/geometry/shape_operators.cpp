// SPDX-License-Identifier: BSD-3-Clause
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "neighbourhood.h"
#include "toposcope/geometry/curvature.h"
#include "toposcope/geometry/large_array.h"

namespace toposcope {
namespace {

constexpr std::size_t grain = 1024;

constexpr Neighbourhood::Limits near = {.reach = 2, .last_step = 0.75, .most_points = 48};
constexpr double faces_away = -0.3;  // cosine between normals
constexpr double ridge = 1e-5;       // of the squared reach; biases by less than 0.1 %

/// Least squares with six unknowns by the normal equations: the inner loop of the estimate. Rows are kept in columns,
/// so that sums run over contiguous numbers, four at a time.
class SixUnknowns {
 public:
  /// \param most  rows to come
  void start(std::size_t most) {
    count_ = 0;
    const std::size_t padded = (most + 3) / 4 * 4;
    if (padded <= stride_) return;
    stride_ = padded;
    columns_.resize(7 * stride_);
  }
  void add(const std::array<double, 6>& row, double value) {
    for (std::size_t i = 0; i < 6; ++i) column(i)[count_] = row[i];
    column(6)[count_++] = value;
  }
  double count() const { return static_cast<double>(count_); }

  /// By L D L^T. \param damping  added to the diagonal; keeps the matrix definite
  std::array<double, 6> solve(const std::array<double, 6>& damping) {
    const std::size_t padded = (count_ + 3) / 4 * 4;
    for (std::size_t i = 0; i < 7; ++i) std::fill(column(i) + count_, column(i) + padded, 0.0);
    double gram[6][6], right[6], inverse[6];
    for (std::size_t i = 0; i < 6; ++i) {
      for (std::size_t j = 0; j <= i; ++j) gram[i][j] = product(column(i), column(j), padded);
      gram[i][i] += damping[i];
      right[i] = product(column(i), column(6), padded);
    }
    for (int j = 0; j < 6; ++j) {
      double scaled[6];
      for (int k = 0; k < j; ++k) scaled[k] = gram[j][k] * gram[k][k];
      for (int k = 0; k < j; ++k) gram[j][j] -= gram[j][k] * scaled[k];
      inverse[j] = 1 / gram[j][j];
      for (int i = j + 1; i < 6; ++i) {
        for (int k = 0; k < j; ++k) gram[i][j] -= gram[i][k] * scaled[k];
        gram[i][j] *= inverse[j];
      }
    }
    std::array<double, 6> c;
    for (int i = 0; i < 6; ++i) {
      c[i] = right[i];
      for (int k = 0; k < i; ++k) c[i] -= gram[i][k] * c[k];
    }
    for (int i = 0; i < 6; ++i) c[i] *= inverse[i];
    for (int i = 5; i >= 0; --i)
      for (int k = i + 1; k < 6; ++k) c[i] -= gram[k][i] * c[k];
    return c;
  }

 private:
  double* column(std::size_t i) { return columns_.data() + i * stride_; }
  static double product(const double* a, const double* b, std::size_t count) {
    std::array<double, 4> sum = {};
    for (std::size_t i = 0; i < count; i += 4)
      for (std::size_t lane = 0; lane < 4; ++lane) sum[lane] += a[i + lane] * b[i + lane];
    return (sum[0] + sum[1]) + (sum[2] + sum[3]);
  }

  std::vector<double> columns_;  ///< of the six unknowns' coefficients and of the values
  std::size_t stride_ = 0, count_ = 0;
};

/// Fits z = c0 + c1 x + c2 y + c3 x^2/2 + c4 xy + c5 y^2/2 and turns its second fundamental form into the frame of the
/// quadric's own normal at p.
/// \param normal  of p; that of the quadric afterwards
void fit_quadric(std::span<const Neighbour> points, const std::vector<Vec3>& normals, SixUnknowns& quadric,
                 Vec3& normal, ShapeOperator& fitted) {
  const Vec3 axis = normal;
  const TangentFrame plane = tangent_frame(axis);
  const Vec3 &u = plane.u, &v = plane.v;
  double squared_reach = 0;
  for (const Neighbour& q : points) squared_reach = std::max(squared_reach, q.offset.squaredNorm());
  if (squared_reach == 0) return;
  const double scale = std::sqrt(squared_reach), per_scale = 1 / scale;

  quadric.start(points.size() + 1);
  quadric.add({1, 0, 0, 0, 0, 0}, 0);  // p itself
  for (const Neighbour& q : points) {
    if (normals[q.vertex].dot(axis) < faces_away) continue;
    const Vec3 d = q.offset * per_scale;
    const double x = d.dot(u), y = d.dot(v), flat = x * x + y * y;
    // A circle through p with a chord d bends by 2 z / d^2, not by 2 z / (x^2 + y^2) as a parabola does: with chords in
    // place of their shadows spheres are exact, and a fold never bends more than its points are close.
    const double stretch = flat > 0 ? d.squaredNorm() / flat : 0;
    quadric.add({1, x, y, stretch * x * x / 2, stretch * x * y, stretch * y * y / 2}, d.dot(axis));
  }
  constexpr double rounding = 1e-12;  // keeps a neighbourhood on one line solvable
  const double still = rounding * quadric.count(), bent = ridge * quadric.count();
  // The ridge is on the Hessian's Frobenius norm, in which the mixed term counts twice.
  const std::array<double, 6> c = quadric.solve({still, still, still, bent, 2 * bent, bent});
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
    Neighbourhood neighbourhood(mesh, near);
    SixUnknowns quadric;
    for (Index p = static_cast<Index>(first); p < last; ++p) {
      if (p % grain == 0 && context.cancelled()) return;
      fit_quadric(neighbourhood.around(p), normals, quadric, operators.normals[p], operators.at[p]);
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
  constexpr double most = 8;
  const double edges = deviation / mesh.mean_edge;
  return static_cast<int>(std::clamp(std::round(edges * edges / variance_per_pass), static_cast<double>(least), most));
}

Curvature principal_curvatures(const ShapeOperators& operators) {
  Curvature curvature;
  reserve_large(curvature.maximum, operators.at.size());
  reserve_large(curvature.minimum, operators.at.size());
  for (const ShapeOperator& at : operators.at) {
    const PrincipalCurvatures principal = principal_curvatures(at);
    curvature.maximum.push_back(principal.maximum);
    curvature.minimum.push_back(principal.minimum);
  }
  return curvature;
}

}  // namespace toposcope
