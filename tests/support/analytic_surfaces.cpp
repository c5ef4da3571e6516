// SPDX-License-Identifier: BSD-3-Clause
#include "support/analytic_surfaces.h"

#include <cmath>
#include <functional>
#include <random>
#include <stdexcept>

namespace toposcope::test {
namespace {

struct Point {
  Vec3 position, normal;
  double maximum, minimum;
};

/// A grid over a rectangle of parameters, closed in either direction.
struct Chart {
  double width, depth;  ///< of the parameter domain
  bool around_u, around_v;
  double aspect;  ///< cells in u per cell in v
  std::function<Point(double, double)> at;
};

Chart chart(const std::string& kind) {
  if (kind == "sphere") {
    // Latitude by equal areas would stretch the cells: use Mercator's, which keeps them square.
    const double reach = 1.5;
    return {2 * pi, 2 * reach, true, false, 2 * pi / (2 * reach), [=](double u, double v) {
              const double t = v - reach, c = 1 / std::cosh(t);
              const Vec3 n(c * std::cos(u), c * std::sin(u), std::tanh(t));
              return Point{n, n, 1, 1};
            }};
  }
  if (kind == "cylinder")
    return {2 * pi, 2 * pi, true, false, 1, [](double u, double v) {
              const Vec3 n(std::cos(u), std::sin(u), 0);
              return Point{n + Vec3(0, 0, v - pi), n, 1, 0};
            }};
  if (kind == "torus")
    return {2 * pi, 2 * pi, true, true, 2, [](double u, double v) {
              const Vec3 out(std::cos(u), std::sin(u), 0);
              const Vec3 n = std::cos(v) * out + Vec3(0, 0, std::sin(v));
              return Point{2 * out + n, n, 1, std::cos(v) / (2 + std::cos(v))};
            }};
  if (kind == "saddle")
    return {2, 2, false, false, 1, [](double u, double v) {
              const double x = u - 1, y = v - 1;
              // Of the graph z = (x^2 - y^2) / 2; the normal points up, so that x bends towards it: concave.
              const double w2 = 1 + x * x + y * y, w = std::sqrt(w2);
              const double gauss = -1 / (w2 * w2), mean = -(y * y - x * x) / (2 * w2 * w);
              const double root = std::sqrt(mean * mean - gauss);
              return Point{{x, y, (x * x - y * y) / 2}, Vec3(-x, y, 1) / w, mean + root, mean - root};
            }};
  throw std::invalid_argument("no surface '" + kind + "'");
}

}  // namespace

AnalyticSurface make_surface(const std::string& kind, Index faces, Sampling sampling, double noise,
                             std::uint64_t seed) {
  const Chart domain = chart(kind);
  const int nv = static_cast<int>(std::lround(std::sqrt(faces / 2.0 / domain.aspect)));
  const int nu = static_cast<int>(std::lround(faces / 2.0 / nv));
  const int rows_u = domain.around_u ? nu : nu + 1, rows_v = domain.around_v ? nv : nv + 1;
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> jitter(-0.4, 0.4);
  std::normal_distribution<double> normal;
  const bool irregular = sampling == Sampling::irregular;

  AnalyticSurface surface;
  std::vector<Vec3> normals;
  for (int i = 0; i < rows_u; ++i)
    for (int j = 0; j < rows_v; ++j) {
      const bool free_u = irregular && (domain.around_u || (i > 0 && i < nu));
      const bool free_v = irregular && (domain.around_v || (j > 0 && j < nv));
      const double u = domain.width * (i + (free_u ? jitter(random) : 0)) / nu;
      const double v = domain.depth * (j + (free_v ? jitter(random) : 0)) / nv;
      const Point point = domain.at(u, v);
      surface.mesh.positions.push_back(point.position);
      normals.push_back(point.normal);
      surface.maximum.push_back(point.maximum);
      surface.minimum.push_back(point.minimum);
      constexpr int margin = 6;
      surface.interior.push_back((domain.around_u || (i >= margin && i <= nu - margin)) &&
                                 (domain.around_v || (j >= margin && j <= nv - margin)));
    }
  const auto at = [&](int i, int j) { return static_cast<Index>((i % rows_u) * rows_v + j % rows_v); };
  for (int i = 0; i < nu; ++i)
    for (int j = 0; j < nv; ++j) {
      const Index a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1), d = at(i, j + 1);
      if (irregular && random() % 2 == 0) {
        surface.mesh.triangles.push_back({a, b, d});
        surface.mesh.triangles.push_back({b, c, d});
      } else {
        surface.mesh.triangles.push_back({a, b, c});
        surface.mesh.triangles.push_back({a, c, d});
      }
    }
  TriangleSoup& mesh = surface.mesh;
  mesh.input_faces = static_cast<Index>(mesh.triangles.size());
  for (Index f = 0; f < mesh.input_faces; ++f) mesh.face_origin.push_back(f);
  if (noise > 0) {
    const double edge = Mesh(mesh, kind).view().mean_edge;
    for (std::size_t v = 0; v < normals.size(); ++v) mesh.positions[v] += noise * edge * normal(random) * normals[v];
  }
  return surface;
}

AnalyticSurface make_lantern(int around, int bands) {
  AnalyticSurface surface;
  for (int j = 0; j <= bands; ++j)
    for (int i = 0; i < around; ++i) {
      const double u = 2 * pi * (i + (j % 2) / 2.0) / around;
      surface.mesh.positions.emplace_back(std::cos(u), std::sin(u), 2.0 * j / bands - 1);
      surface.maximum.push_back(1);
      surface.minimum.push_back(0);
      surface.interior.push_back(j > bands / 4 && j < 3 * bands / 4);
    }
  const auto at = [&](int j, int i) { return static_cast<Index>(j * around + i % around); };
  for (int j = 0; j < bands; ++j)
    for (int i = 0; i < around; ++i) {
      const int shift = j % 2;  // the vertex above lies half a facet on
      surface.mesh.triangles.push_back({at(j, i), at(j, i + 1), at(j + 1, i + shift)});
      surface.mesh.triangles.push_back({at(j, i + 1), at(j + 1, i + shift + 1), at(j + 1, i + shift)});
    }
  TriangleSoup& mesh = surface.mesh;
  mesh.input_faces = static_cast<Index>(mesh.triangles.size());
  for (Index f = 0; f < mesh.input_faces; ++f) mesh.face_origin.push_back(f);
  return surface;
}

}  // namespace toposcope::test
