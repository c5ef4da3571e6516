// SPDX-License-Identifier: BSD-3-Clause
#include "mirror.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "toposcope/geometry/lines.h"

namespace toposcope::mirror {

Vec3 mean(std::span<const Vec3> points) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& p : points) sum += p;
  return sum / static_cast<double>(points.size());
}

SortedPoints::SortedPoints(std::span<const Vec3> points, const Vec3& axis) : axis_(axis) {
  struct Key {
    double along;
    Index index;
  };
  std::vector<Key> keys(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) keys[i] = {axis.dot(points[i]), static_cast<Index>(i)};
  std::sort(keys.begin(), keys.end(), [&](const Key& a, const Key& b) {
    if (a.along != b.along) return a.along < b.along;
    const Vec3 &p = points[a.index], &q = points[b.index];
    return std::lexicographical_compare(p.data(), p.data() + 3, q.data(), q.data() + 3);
  });
  entries_.reserve(points.size());
  for (const Key& key : keys) entries_.push_back({key.along, points[key.index]});
}

SortedPoints SortedPoints::thinned(std::size_t limit, double phase) const {
  if (size() <= limit) return *this;
  SortedPoints thin(axis_);
  thin.entries_.reserve(limit);
  const double part = static_cast<double>(size()) / static_cast<double>(limit);
  for (std::size_t i = 0; i < limit; ++i)
    thin.entries_.push_back(entries_[static_cast<std::size_t>((static_cast<double>(i) + phase) * part)]);
  return thin;
}

const Vec3& SortedPoints::nearest(const Vec3& x, double& squared) const {
  const double key = axis_.dot(x);
  std::size_t up = static_cast<std::size_t>(
      std::lower_bound(entries_.begin(), entries_.end(), key, [](const Entry& e, double k) { return e.key < k; }) -
      entries_.begin());
  std::size_t down = up;
  std::size_t best = up < entries_.size() ? up : up - 1;
  squared = std::numeric_limits<double>::infinity();
  const auto visit = [&](std::size_t i) {
    const double d = (entries_[i].point - x).squaredNorm();
    if (d < squared) {
      squared = d;
      best = i;
    }
  };
  const auto within = [&](std::size_t i) {
    const double gap = entries_[i].key - key;
    return gap * gap < squared;
  };
  bool upwards = true, downwards = true;
  while (upwards || downwards) {
    upwards = upwards && up < entries_.size() && within(up);
    if (upwards) visit(up++);
    downwards = downwards && down > 0 && within(down - 1);
    if (downwards) visit(--down);
  }
  return entries_[best].point;
}

double mean_squared(const SortedPoints& queries, const SortedPoints& targets) {
  double sum = 0, squared = 0;
  for (std::size_t i = 0; i < queries.size(); ++i) {
    targets.nearest(queries[i], squared);
    sum += squared;
  }
  return sum / static_cast<double>(queries.size());
}

namespace {

/// Normal equations of the plane's three freedoms: two tilts about `point` and a shift along the normal.
struct NormalEquations {
  std::array<std::array<double, 3>, 3> matrix = {};
  std::array<double, 3> gradient = {};
  double cost = 0;  ///< weighted sum of squared distances
};

// Adds the pairs (mirrored query, its nearest target), each query with weight 1 / queries.
void accumulate(const SortedPoints& queries, const SortedPoints& targets, const Plane& plane,
                const std::array<Vec3, 2>& tangents, NormalEquations& equations) {
  const double weight = 1 / static_cast<double>(queries.size());
  for (std::size_t i = 0; i < queries.size(); ++i) {
    const Vec3& q = queries[i];
    const Vec3 lever = q - plane.point;
    const double height = plane.normal.dot(lever);
    double squared = 0;
    const Vec3 mirrored = q - 2 * height * plane.normal;
    const Vec3 error = mirrored - targets.nearest(mirrored, squared);
    const std::array<Vec3, 3> columns = {Vec3(-2 * (tangents[0].dot(lever) * plane.normal + height * tangents[0])),
                                         Vec3(-2 * (tangents[1].dot(lever) * plane.normal + height * tangents[1])),
                                         Vec3(2 * plane.normal)};
    for (std::size_t row = 0; row < 3; ++row) {
      for (std::size_t column = 0; column <= row; ++column)
        equations.matrix[row][column] += weight * columns[row].dot(columns[column]);
      equations.gradient[row] += weight * columns[row].dot(error);
    }
    equations.cost += weight * squared;
  }
}

// Solves the 3 x 3 system by Cholesky's method, each pivot raised by a relative amount: a direction that the points
// do not determine then stays where it is.
std::array<double, 3> solve(NormalEquations e) {
  auto& m = e.matrix;
  const auto diagonal = std::array<double, 3>{m[0][0], m[1][1], m[2][2]};
  for (std::size_t i = 0; i < 3; ++i) m[i][i] += 1e-9 * diagonal[i] + std::numeric_limits<double>::min();
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      for (std::size_t k = 0; k < j; ++k) m[i][j] -= m[i][k] * m[j][k];
      m[i][j] /= m[j][j];
      m[i][i] -= m[i][j] * m[i][j];
    }
    m[i][i] = std::sqrt(std::max(m[i][i], 1e-12 * diagonal[i] + std::numeric_limits<double>::min()));
  }
  std::array<double, 3> x = {};
  for (std::size_t i = 0; i < 3; ++i) {
    x[i] = -e.gradient[i];
    for (std::size_t k = 0; k < i; ++k) x[i] -= m[i][k] * x[k];
    x[i] /= m[i][i];
  }
  for (std::size_t i = 3; i-- > 0;) {
    for (std::size_t k = i + 1; k < 3; ++k) x[i] -= m[k][i] * x[k];
    x[i] /= m[i][i];
  }
  return x;
}

}  // namespace

Refined refine(Plane plane, const Side& first, const Side& second, int steps) {
  Refined best;
  for (int step = 0; step <= steps; ++step) {
    const Vec3 tangent = any_perpendicular(plane.normal);
    const std::array<Vec3, 2> tangents = {tangent, plane.normal.cross(tangent)};
    NormalEquations equations;
    accumulate(first.queries, second.targets, plane, tangents, equations);
    accumulate(second.queries, first.targets, plane, tangents, equations);
    const double now = equations.cost / 2;
    const bool pays = now < 0.99 * best.mean_squared;
    if (now < best.mean_squared) best = {plane, now};
    if (!pays || now == 0) break;
    const std::array<double, 3> move = solve(equations);
    const Vec3 tilt = move[0] * tangents[0] + move[1] * tangents[1];
    plane.point += move[2] * plane.normal;
    plane.normal = (plane.normal + tilt).normalized();
  }
  return best;
}

}  // namespace toposcope::mirror
