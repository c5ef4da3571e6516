// SPDX-License-Identifier: BSD-3-Clause
// Points on known ellipses. Run with the plugin's library as its argument.

#include <cmath>
#include <random>

#include "toposcope/geometry/lines.h"
#include "toposcope/testing/plugin_test.h"

namespace {

using namespace toposcope;

constexpr double edge = 0.05;

/// Points about a tilted ellipse with semi-axes a and b, from parameter 0 to `to`, in two rows.
struct Arc {
  double a, b, to, noise;
  Vec3 center{3, -2, 5}, u{0.8, 0, 0.6}, v{0, 1, 0};
  std::vector<Vec3> points(std::uint32_t seed) const {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal(0, noise);
    const int count = static_cast<int>(to * (a + b) / 2 / edge);
    std::vector<Vec3> result;
    for (int i = 0; i < count; ++i) {
      const double t = to * (i + 0.5) / count;
      const double x = normal(random), y = normal(random), z = normal(random);
      result.push_back(center + a * std::cos(t) * u + b * std::sin(t) * v + Vec3(x, y, z));
    }
    return result;
  }
};

}  // namespace

int main(int, char** argv) {
  const testing::Plugin<ShapeFitter> plugin(argv[1]);
  const Vec3 normal(-0.6, 0, 0.8);
  // Exact points give the exact ellipse, from nearly a circle to one of ten to one, whole or half of it.
  for (const double b : {0.99, 0.7, 0.3, 0.1})
    for (const double to : {2 * pi, 1.2 * pi}) {
      const Arc arc{1, b, to, 0};
      const FittedShape fitted = testing::fit(*plugin, arc.points(1), edge);
      TOPOSCOPE_EXPECT(fitted.summary.usable());
      if (!fitted.summary.usable()) continue;
      TOPOSCOPE_EXPECT(std::abs(fitted.measure("semi_major")->value - 1) < 1e-6);
      TOPOSCOPE_EXPECT(std::abs(fitted.measure("semi_minor")->value - b) < 1e-6);
      TOPOSCOPE_EXPECT((fitted.centroid - arc.center).norm() < 1e-6);
      TOPOSCOPE_EXPECT(line_angle(fitted.direction, normal) < 1e-6);
      TOPOSCOPE_EXPECT(line_angle(Vec3(fitted.parameter("axis")->values.data()), arc.u) < (b > 0.9 ? 1e-3 : 1e-6));
      // Its centre is as far from it as the short axis, and a point over an end of the long axis as high as it is.
      TOPOSCOPE_EXPECT(std::abs(plugin->distance(fitted, arc.center) - b) < 1e-6);
      TOPOSCOPE_EXPECT(std::abs(plugin->distance(fitted, arc.center + arc.u + 0.2 * normal) - 0.2) < 1e-6);
    }
  // Noise: errors over 100 draws are what the fit says they are, within a factor of 1.5.
  double major = 0, minor = 0, center = 0;
  for (std::uint32_t seed = 1; seed <= 100; ++seed) {
    const Arc arc{1, 0.6, 2 * pi, 0.02};
    const FittedShape fitted = testing::fit(*plugin, arc.points(seed), edge);
    TOPOSCOPE_EXPECT(fitted.summary.usable());
    if (!fitted.summary.usable()) continue;
    major += std::pow((fitted.measure("semi_major")->value - 1) / fitted.measure("semi_major")->sd, 2) / 100;
    minor += std::pow((fitted.measure("semi_minor")->value - 0.6) / fitted.measure("semi_minor")->sd, 2) / 100;
    center += (fitted.centroid - arc.center).squaredNorm() / std::pow(fitted.centroid_sd, 2) / 300;
  }
  for (const double variance : {major, minor, center}) {
    TOPOSCOPE_EXPECT(variance > 1 / 2.25);
    TOPOSCOPE_EXPECT(variance < 2.25);
  }
  // Outliers: a tenth of the points somewhere else do not move it.
  std::vector<Vec3> points = Arc{1, 0.6, 2 * pi, 0.005}.points(1);
  const std::size_t good = points.size();
  for (std::size_t i = 0; i < good / 10; ++i)
    points.push_back(points[i] + Vec3(0.3, 0.2, 0) * static_cast<double>(i % 4));
  const FittedShape robust = testing::fit(*plugin, points, edge);
  TOPOSCOPE_EXPECT(robust.summary.usable() && std::abs(robust.measure("semi_minor")->value - 0.6) < 0.01);
  // A short arc determines none.
  TOPOSCOPE_EXPECT(!testing::fit(*plugin, Arc{1, 0.6, 0.3, 0.002}.points(1), 0.01).summary.usable());
  return testing::failures;
}
