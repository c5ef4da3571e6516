// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/evenness.h"

#include <gtest/gtest.h>

#include "support/meshes.h"

namespace toposcope {
namespace {

/// A sphere, its upper half cut in four `times` times.
TriangleSoup half_fine(int subdivisions, int times) {
  TriangleSoup soup = test::make_sphere(subdivisions), fine;
  for (const Triangle& t : soup.triangles) {
    std::vector<std::array<Vec3, 3>> pieces = {{soup.positions[t[0]], soup.positions[t[1]], soup.positions[t[2]]}};
    const bool upper = pieces[0][0].z() + pieces[0][1].z() + pieces[0][2].z() > 0;
    for (int k = 0; upper && k < times; ++k) {
      std::vector<std::array<Vec3, 3>> next;
      for (const auto& [a, b, c] : pieces) {
        const Vec3 x = (b + c) / 2, y = (c + a) / 2, z = (a + b) / 2;
        next.insert(next.end(), {{a, z, y}, {z, b, x}, {y, x, c}, {x, y, z}});
      }
      pieces = std::move(next);
    }
    for (const auto& piece : pieces) {
      const auto first = static_cast<Index>(fine.positions.size());
      fine.positions.insert(fine.positions.end(), piece.begin(), piece.end());
      fine.triangles.push_back({first, first + 1, first + 2});
    }
  }
  fine.face_origin.resize(fine.triangles.size(), 0);
  fine.input_faces = 1;
  return fine;
}

TEST(Evenness, EvenMeshesStayAsTheyAre) {
  EXPECT_FALSE(even_face_count(Mesh(test::make_sphere(4), "sphere").view()));
  EXPECT_FALSE(even_face_count(Mesh(test::make_torus(2, 0.5, 120, 40), "torus").view()));
  EXPECT_FALSE(even_face_count(Mesh(test::make_cylinder(1, 3, 900, 1), "prism").view())) << "long thin triangles";
  EXPECT_FALSE(even_face_count(Mesh(half_fine(2, 3), "few").view())) << "320 faces are too few to judge by";
}

TEST(Evenness, CountsTheFacesOfTheCoarserPart) {
  for (const int times : {1, 2, 3}) {
    const auto count = even_face_count(Mesh(half_fine(3, times), "half").view());
    ASSERT_TRUE(count) << times;
    EXPECT_NEAR(static_cast<double>(*count), 1280, 250) << times;
  }
}

}  // namespace
}  // namespace toposcope
