// SPDX-License-Identifier: BSD-3-Clause
// Run with the plugin's library as its argument.
#include "toposcope/testing/plugin_test.h"

int main(int, char** argv) {
  using namespace toposcope;
  const testing::Plugin<MeshFilter> plugin(argv[1]);
  // A pyramid: its top goes half of the way to the mean of the base, which is the origin.
  const testing::TestMesh mesh({{0, 0, 2}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}},
                               {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}});
  testing::QuietContext context;
  testing::FilteredMesh result;
  plugin->apply(mesh.view(), context, result);
  TOPOSCOPE_EXPECT(result.positions.size() == 5);
  if (result.positions.empty()) return 1;
  TOPOSCOPE_EXPECT((result.positions[0] - Vec3(0, 0, 1)).norm() < 1e-12);
  TOPOSCOPE_EXPECT((result.face_origin == std::vector<Index>{0, 1, 2, 3}));
  return testing::failures;
}
