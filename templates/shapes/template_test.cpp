// SPDX-License-Identifier: BSD-3-Clause
// Run with the plugin's library as its argument.
#include <cmath>

#include "toposcope/testing/plugin_test.h"

int main(int, char** argv) {
  using namespace toposcope;
  const testing::Plugin<ShapeFitter> plugin(argv[1]);
  const Vec3 center(5, -3, 8);
  std::vector<Vec3> cap;  // the upper half of a sphere of radius 2
  for (int i = 0; i < 500; ++i) {
    const double z = (i + 0.5) / 500, angle = 2.4 * i, r = std::sqrt(1 - z * z);
    cap.push_back(center + 2 * Vec3(r * std::cos(angle), r * std::sin(angle), z));
  }
  const FittedShape fitted = testing::fit(*plugin, cap, 0.2);
  TOPOSCOPE_EXPECT(fitted.summary.usable());
  TOPOSCOPE_EXPECT((fitted.centroid - center).norm() < 1e-9);
  TOPOSCOPE_EXPECT(std::abs(fitted.measure("radius")->value - 2) < 1e-9);
  TOPOSCOPE_EXPECT(std::abs(plugin->distance(fitted, center) - 2) < 1e-9);

  for (Vec3& point : cap) point.z() = 0;
  TOPOSCOPE_EXPECT(!testing::fit(*plugin, cap, 0.2).summary.usable());
  return testing::failures;
}
