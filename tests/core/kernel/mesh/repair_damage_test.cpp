// SPDX-License-Identifier: BSD-3-Clause

// Meshes damaged at random in the ways of exporters: whatever comes, what is repaired is sound and needs no repair.

#include <gtest/gtest.h>

#include "base/errors.h"
#include "repair_fixture.h"
#include "support/random.h"

namespace toposcope {
namespace {

using namespace test;

TriangleSoup sound_mesh(Random& random) {
  switch (random.below(6)) {
    case 0:
      return make_sphere(2);
    case 1:
      return make_torus(2, 0.5, 12, 8);
    case 2:
      return make_grid(8, 8);
    case 3:
      return make_cylinder(1, 2, 10, 3, false);
    case 4:
      return make_box({1, 2, 3}, 3);
    default:
      return make_can(1, 2, 10, 3, 3);
  }
}

void damage(std::vector<Vec3>& positions, std::vector<Triangle>& triangles, Random& random) {
  const auto place = [&] { return random.below(positions.size()); };
  Triangle& t = triangles[random.below(triangles.size())];
  const auto middle = static_cast<Index>(positions.size());
  switch (random.below(10)) {
    case 0:  // a face twice
      return triangles.push_back(Triangle(t));
    case 1:  // turned over
      return std::swap(t[1], t[2]);
    case 2:  // hung elsewhere
      t[random.below(3)] = place();
      return;
    case 3:  // two vertices at one place
      positions[place()] = Vec3(positions[place()]);
      return;
    case 4:  // a cap: without area, its far corner on the longest side
      positions[t[0]] = (positions[t[1]] + positions[t[2]]) / 2;
      return;
    case 5:  // a side without length
      positions[t[0]] = Vec3(positions[t[1]]);
      return;
    case 6:  // a face through the room
      return triangles.push_back({place(), place(), place()});
    case 7:  // a needle
      positions[t[0]] = positions[t[1]] + 1e-9 * (positions[t[2]] - positions[t[1]]);
      return;
    case 8:  // a hole
      if (triangles.size() > 1) std::swap(t, triangles.back()), triangles.pop_back();
      return;
    default:  // a face without area along a side
      positions.push_back(0.3 * positions[t[0]] + 0.7 * positions[t[1]]);
      return triangles.push_back({t[0], middle, t[1]});
  }
}

TEST(Repair, OfADamagedMeshLeavesNothingToRepair) {
  for (std::uint64_t seed = 0; seed < 1500; ++seed) {
    Random random(seed);
    TriangleSoup mesh = sound_mesh(random);
    for (Index count = 1 + random.below(6); count > 0; --count) damage(mesh.positions, mesh.triangles, random);
    TriangleSoup soup = soup_of(mesh.positions, mesh.triangles);
    repaired(soup, "seed " + std::to_string(seed));
  }
}

/// Corners on a small grid meet in every way: planes, lines, points, caps beside caps.
TEST(Repair, OfASoupOnAGridLeavesNothingToRepair) {
  for (std::uint64_t seed = 0; seed < 1500; ++seed) {
    Random random(seed);
    std::vector<Vec3> positions;
    for (Index v = 3 + random.below(10); v > 0; --v)
      positions.emplace_back(random.below(3), random.below(3), random.below(3));
    std::vector<Triangle> triangles;
    for (Index f = 1 + random.below(40); f > 0; --f)
      triangles.push_back(
          {random.below(positions.size()), random.below(positions.size()), random.below(positions.size())});
    TriangleSoup soup = soup_of(positions, triangles);
    try {
      repaired(soup, "seed " + std::to_string(seed));
    } catch (const MeshError&) {
      continue;  // nothing of it has an area
    }
  }
}

}  // namespace
}  // namespace toposcope
