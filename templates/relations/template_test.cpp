// SPDX-License-Identifier: BSD-3-Clause
// Run with the plugin's library as its argument.
#include <cmath>

#include "toposcope/testing/plugin_test.h"

int main(int, char** argv) {
  using namespace toposcope;
  const testing::Plugin<RelationTester> plugin(argv[1]);
  testing::QuietContext context;
  FittedShape near, far;
  near.centroid = Vec3(1, 0, 0);
  far.centroid = Vec3(0, 1.5, 0);
  const RelationOperand operands[] = {{&near, {}, {}}, {&far, {}, {}}};
  RelationInput input{operands, {}, 0.1, nullptr};
  input.object_box.sides = {4, 4, 2};  // its diagonal is 6
  const RelationResult result = plugin->test(input, plugin.arguments().options(), context);
  TOPOSCOPE_EXPECT(result.applicable);
  TOPOSCOPE_EXPECT(std::abs(result.residual - 0.5) < 1e-12);
  TOPOSCOPE_EXPECT(std::abs(result.tolerance - 0.12) < 1e-12);

  far.centroid = Vec3(0, 0, -1);
  TOPOSCOPE_EXPECT(plugin->test(input, plugin.arguments().options(), context).residual < 1e-12);
  return testing::failures;
}
