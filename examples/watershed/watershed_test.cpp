// SPDX-License-Identifier: BSD-3-Clause
// Solids whose sides are known: each must come out as one region. Run with the plugin's library as its argument.

#include <algorithm>
#include <cmath>
#include <string>

#include "../solids.h"
#include "toposcope/testing/plugin_test.h"

namespace {

using namespace toposcope;

/// Regions found on a solid, and how well the worst of its sides is met: intersection over union with the best region.
struct Match {
  std::size_t regions = 0, borders = 0;
  double worst = 1;
};

Match match(const testing::Plugin<WorkingSetClassifier>& plugin, const solids::Solid& solid) {
  const testing::TestMesh mesh(solid.positions, solid.triangles);
  testing::QuietContext context;
  testing::FoundSets found;
  plugin->classify(mesh.view(), context, found);
  Match result;
  int sides = 0;
  for (const int side : solid.side_of) sides = std::max(sides, side + 1);
  for (const auto& set : found.sets) ++(set.type == "region" ? result.regions : result.borders);
  for (int side = 0; side < sides; ++side) {
    double best = 0;
    const auto whole = static_cast<double>(std::count(solid.side_of.begin(), solid.side_of.end(), side));
    for (const auto& set : found.sets) {
      if (set.type != "region") continue;
      // Vertices on an edge belong to no side and are free to go to either.
      double both = 0, others = 0;
      for (const Index v : set.vertices) {
        both += solid.side_of[v] == side;
        others += solid.side_of[v] >= 0 && solid.side_of[v] != side;
      }
      best = std::max(best, both / (whole + others));
    }
    result.worst = std::min(result.worst, best);
  }
  return result;
}

}  // namespace

int main(int, char** argv) {
  const testing::Plugin<WorkingSetClassifier> plugin(argv[1]);
  for (const double noise : {0.0, 0.01, 0.03}) {  // of an edge
    for (std::uint32_t seed = 1; seed <= 3; ++seed) {
      const Match block = match(plugin, solids::block(20, noise, seed));
      TOPOSCOPE_EXPECT(block.regions == 6);
      TOPOSCOPE_EXPECT(block.borders == 12);
      TOPOSCOPE_EXPECT(block.worst > 0.97);
      const Match can = match(plugin, solids::oval_can(1, 0.7, 1.6, 80, noise, seed));
      TOPOSCOPE_EXPECT(can.regions == 3);
      TOPOSCOPE_EXPECT(can.borders == 2);
      TOPOSCOPE_EXPECT(can.worst > 0.97);
    }
  }
  // Nothing to divide.
  TOPOSCOPE_EXPECT(match(plugin, solids::sphere(4)).regions == 1);
  // Where the wall must be higher than it is, there is none.
  const testing::Plugin<WorkingSetClassifier> blunt(argv[1], {{"depth", "9"}});
  TOPOSCOPE_EXPECT(match(blunt, solids::block(20, 0, 1)).regions == 1);
  return testing::failures;
}
