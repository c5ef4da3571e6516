// SPDX-License-Identifier: BSD-3-Clause
#include "point_sets.h"

#include <cmath>

#include "inputs.h"

namespace toposcope {
namespace {

constexpr double edge = 0.05;

void cut(PointSets& points, std::size_t sets) {
  points.offsets.clear();
  for (std::size_t k = 0; k <= sets; ++k) points.offsets.push_back(static_cast<Index>(points.points.size() * k / sets));
}

/// A surface x(u, v), u and v from 0 to 1, as nu x nv uneven points with noise.
template <class Surface>
PointSets sampled(const char* name, int nu, int nv, std::size_t sets, const Surface& surface) {
  PointSets result{name, {}, edge, {}};
  Random random(7);
  for (int i = 0; i < nu; ++i)
    for (int j = 0; j < nv; ++j) {
      const double u = (i + random.uniform(0.3, 0.7)) / nu, v = (j + random.uniform(0.3, 0.7)) / nv;
      const double x = random.normal(), y = random.normal(), z = random.normal();
      result.points.push_back(Vec3(surface(u, v)) + 0.004 * Vec3(x, y, z));
    }
  cut(result, sets);
  return result;
}

}  // namespace

std::vector<PointSets> ordinary_points(std::size_t sets) {
  const auto ring = [](double from, double to) {
    return [=](double u, double v) {
      const double angle = from + (to - from) * u;
      return Vec3(0.8 * std::cos(angle), 0.8 * std::sin(angle), edge * (v - 0.5));
    };
  };
  return {
      sampled("a ring", 100, 2, sets, ring(0, 2 * pi)),
      sampled("two thirds of a ring", 70, 2, sets, ring(0.4, 0.4 + 4 * pi / 3)),
      sampled("a straight strip", 34, 3, sets, [](double u, double v) { return Vec3(1.7 * u, 0.15 * v, 0.05); }),
      sampled("a bent strip", 60, 2, sets,
              [](double u, double v) {
                const double x = u < 0.6 ? 1.8 * u : 1.08, y = u < 0.6 ? 0 : 1.8 * (u - 0.6);
                return Vec3(x, y, 0.1 * v);
              }),
      sampled("a flat patch", 26, 18, sets, [](double u, double v) { return Vec3(1.3 * u, 0.9 * v, 0.2); }),
      sampled("a cap", 24, 12, sets,
              [](double u, double v) {
                const double angle = 2 * pi * u, height = 0.05 + 0.5 * v,
                             r = std::sqrt(1 - (1 - height) * (1 - height));
                return Vec3(r * std::cos(angle), r * std::sin(angle), height);
              }),
      sampled("a piece of a tube", 28, 20, sets,
              [](double u, double v) {
                const double angle = 4 * u;
                return Vec3(0.35 * std::cos(angle), 0.35 * std::sin(angle), v);
              }),
      sampled("a wavy sheet", 24, 18, sets,
              [](double u, double v) { return Vec3(1.2 * u, 0.9 * v, 0.15 * std::sin(7 * u + 2 * v)); }),
  };
}

std::vector<PointSets> degenerate_points(std::size_t sets) {
  std::vector<PointSets> all = {{"no point", {}, edge, {}},
                                {"one point", {{1, 2, 3}}, edge, {}},
                                {"two points", {{1, 2, 3}, {1.05, 2, 3}}, edge, {}},
                                {"three points", {{1, 2, 3}, {1.05, 2, 3}, {1, 2.04, 3}}, edge, {}},
                                {"four points", {{1, 2, 3}, {1.05, 2, 3}, {1, 2.04, 3}, {1.1, 2.1, 3.05}}, edge, {}}};
  PointSets line{"points on a line", {}, edge, {}}, spot{"points at one place", {}, edge, {}};
  for (int i = 0; i < 40; ++i) {
    line.points.emplace_back(edge * i, 0, 0);
    spot.points.emplace_back(1, 2, 3);
  }
  all.push_back(std::move(line));
  all.push_back(std::move(spot));
  all.push_back(ordinary_points(1)[0]);
  all.back().name = "points of a mesh without edge length";
  all.back().mean_edge = 0;
  for (PointSets& each : all) cut(each, sets);
  return all;
}

PointSets moved(const PointSets& points, const Motion& motion) {
  PointSets result = points;
  result.mean_edge *= motion.scale;
  for (Vec3& p : result.points) p = motion(p);
  if (motion.shuffle == 0) return result;
  Random random(motion.shuffle);
  for (std::size_t k = 0; k + 1 < points.offsets.size(); ++k) {
    std::vector<Vec3> set(result.points.begin() + points.offsets[k], result.points.begin() + points.offsets[k + 1]);
    random.shuffle(set);
    std::copy(set.begin(), set.end(), result.points.begin() + points.offsets[k]);
  }
  return result;
}

}  // namespace toposcope
