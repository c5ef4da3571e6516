// SPDX-License-Identifier: BSD-3-Clause
// Run with the plugin's library as its argument.
#include <algorithm>

#include "toposcope/testing/plugin_test.h"

int main(int, char** argv) {
  using namespace toposcope;
  const testing::Plugin<WorkingSetClassifier> plugin(argv[1]);
  // A roof: two flat rectangles that meet at a right angle in the vertices of column 5.
  std::vector<Vec3> positions;
  std::vector<Triangle> triangles;
  for (int i = 0; i <= 10; ++i)
    for (int j = 0; j <= 10; ++j) positions.emplace_back(i, j, -std::abs(i - 5));
  for (Index i = 0; i < 10; ++i)
    for (Index j = 0; j < 10; ++j) {
      const Index a = 11 * i + j, b = a + 11;
      triangles.insert(triangles.end(), {{a, b, b + 1}, {a, b + 1, a + 1}});
    }
  const testing::TestMesh mesh(positions, triangles);
  testing::QuietContext context;
  testing::FoundSets found;
  plugin->classify(mesh.view(), context, found);
  TOPOSCOPE_EXPECT(found.sets.size() == 1);
  if (found.sets.empty()) return 1;
  std::sort(found.sets[0].vertices.begin(), found.sets[0].vertices.end());
  TOPOSCOPE_EXPECT((found.sets[0].vertices == std::vector<Index>{55, 56, 57, 58, 59, 60, 61, 62, 63, 64, 65}));

  const testing::Plugin<WorkingSetClassifier> blunt(argv[1], {{"angle", "100"}});
  testing::FoundSets none;
  blunt->classify(mesh.view(), context, none);
  TOPOSCOPE_EXPECT(none.sets.empty());
  return testing::failures;
}
