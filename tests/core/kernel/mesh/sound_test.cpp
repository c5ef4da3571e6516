// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/sound.h"

#include <gtest/gtest.h>

#include <random>

#include "mesh/repair.h"
#include "support/meshes.h"
#include "support/plugins.h"

namespace toposcope {
namespace {

/// Both in one soup.
TriangleSoup with(TriangleSoup soup, const TriangleSoup& other) {
  const auto shift = static_cast<Index>(soup.positions.size());
  soup.positions.insert(soup.positions.end(), other.positions.begin(), other.positions.end());
  for (const auto& [a, b, c] : other.triangles) {
    soup.face_origin.push_back(static_cast<Index>(soup.triangles.size()));
    soup.triangles.push_back({a + shift, b + shift, c + shift});
  }
  soup.input_faces = static_cast<Index>(soup.triangles.size());
  return soup;
}

TriangleSoup turned(TriangleSoup soup) {
  for (Triangle& t : soup.triangles) std::swap(t[1], t[2]);
  return soup;
}

TriangleSoup far_away(const TriangleSoup& soup) {
  return test::transformed(soup, Eigen::Matrix3d::Identity(), 1, Vec3(5, 0, 0));
}

/// Where a mesh is called sound the repair must agree, to the last count.
bool is_sound(const TriangleSoup& soup, unsigned threads = 1) {
  const std::optional<RepairReport> sound = examine(soup, &test::context(threads));
  if (!sound) return false;
  TriangleSoup repaired = soup;
  const RepairReport report = repair(repaired, "mesh");
  EXPECT_FALSE(report.changed());
  EXPECT_FALSE(report.notable());
  EXPECT_EQ(repaired.triangles, soup.triangles);
  EXPECT_EQ(repaired.positions, soup.positions);
  EXPECT_EQ(sound->components, report.components);
  EXPECT_EQ(sound->closed_components, report.closed_components);
  EXPECT_EQ(sound->holes, report.holes);
  EXPECT_EQ(sound->border_edges, report.border_edges);
  EXPECT_EQ(sound->euler, report.euler);
  EXPECT_EQ(sound->genus, report.genus);
  return true;
}

TEST(Sound, WhatNeedsNoRepair) {
  EXPECT_TRUE(is_sound(test::make_sphere(4)));
  EXPECT_TRUE(is_sound(test::make_torus(2, 1, 40, 20)));
  EXPECT_TRUE(is_sound(test::make_grid(30, 20)));
  EXPECT_TRUE(is_sound(test::make_cylinder(1, 2, 40, 10, false)));
  EXPECT_TRUE(is_sound(test::make_cylinder(1, 2, 400, 10)));  // a hub of 400 faces
  EXPECT_TRUE(is_sound(test::make_box({1, 2, 3})));
  EXPECT_TRUE(is_sound(test::shuffled(test::make_torus(2, 1, 200, 100), 1), 4));
  EXPECT_TRUE(is_sound(with(test::make_sphere(3), far_away(test::make_grid(5, 5)))));
}

TEST(Sound, WhatNeedsOne) {
  const TriangleSoup sphere = test::make_sphere(3);
  const auto broken = [&](const auto& change) {
    TriangleSoup soup = sphere;
    change(soup);
    return soup;
  };
  EXPECT_FALSE(is_sound(turned(sphere)));
  EXPECT_FALSE(is_sound(with(sphere, sphere)));  // twice at one place
  EXPECT_FALSE(is_sound(broken([](TriangleSoup& s) { std::swap(s.triangles[7][0], s.triangles[7][1]); })));
  EXPECT_FALSE(is_sound(broken([](TriangleSoup& s) { s.positions.push_back(Vec3(1, 2, 3)); })));
  EXPECT_FALSE(is_sound(broken([](TriangleSoup& s) { s.positions[3].x() = std::nan(""); })));
  EXPECT_FALSE(is_sound(broken([](TriangleSoup& s) { s.triangles.push_back(s.triangles[5]); })));
  EXPECT_FALSE(is_sound(broken([](TriangleSoup& s) { s.triangles[4][1] = s.triangles[4][0]; })));
  EXPECT_FALSE(is_sound(broken([](TriangleSoup& s) { s.triangles[4][1] = 100000; })));
  EXPECT_FALSE(is_sound(broken([](TriangleSoup& s) { s.triangles[4][1] = s.triangles[300][0]; })));
  // A seam that is open by rounding alone.
  TriangleSoup seam = test::make_grid(6, 6);
  seam = with(seam, test::transformed(seam, Eigen::Matrix3d::Identity(), 1, Vec3(1 + 1e-9, 0, 0)));
  EXPECT_FALSE(is_sound(seam));
  // Two faces back to back.
  TriangleSoup pillow{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 1}}, {0, 1}, 2};
  EXPECT_FALSE(is_sound(pillow));
}

/// Whatever is done to a mesh, nothing is called sound that the repair would change.
TEST(Sound, AgreesWithTheRepairOnDamagedMeshes) {
  std::mt19937_64 random(1);
  int sound = 0;
  for (int trial = 0; trial < 300; ++trial) {
    TriangleSoup soup = trial % 3 == 0   ? test::make_sphere(1)
                        : trial % 3 == 1 ? test::make_grid(4, 3)
                                         : test::make_cylinder(1, 1, 7, 2, false);
    const auto face = [&]() -> std::size_t { return random() % soup.triangles.size(); };
    for (std::uint64_t blow = random() % 3; blow > 0; --blow) switch (random() % 4) {
        case 0:
          soup.triangles.erase(soup.triangles.begin() + static_cast<std::ptrdiff_t>(face()));
          break;
        case 1:
          soup.triangles[face()][random() % 3] = static_cast<Index>(random() % soup.positions.size());
          break;
        case 2:
          soup.positions[random() % soup.positions.size()] = soup.positions[random() % soup.positions.size()];
          break;
        default:
          soup.triangles.push_back(soup.triangles[face()]);
          std::swap(soup.triangles.back()[0], soup.triangles.back()[1]);
      }
    soup.input_faces = static_cast<Index>(soup.triangles.size());
    soup.face_origin.resize(soup.triangles.size());
    for (Index f = 0; f < soup.input_faces; ++f) soup.face_origin[f] = f;
    sound += is_sound(soup);
  }
  EXPECT_GT(sound, 50);
  EXPECT_LT(sound, 250);
}

}  // namespace
}  // namespace toposcope
