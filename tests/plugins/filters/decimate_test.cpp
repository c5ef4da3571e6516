// SPDX-License-Identifier: BSD-3-Clause
#include "plugins/filters/filter_fixture.h"

namespace {

using namespace toposcope;
using namespace toposcope::test;

TEST(Decimate, CubeKeepsItsShapeDownToTwelveFaces) {
  const TriangleSoup soup = transformed(make_box(Vec3(2, 3, 4), 6), random_rotation(3), 10, Vec3(1, 2, 3));
  const Filtered result = filtered("decimate", soup, {{"faces", "12"}});
  ASSERT_EQ(result.mesh.triangles.size(), 12U);
  EXPECT_EQ(result.mesh.positions.size(), 8U);
  EXPECT_NEAR(area(result.mesh) / area(soup), 1, 1e-12);
  EXPECT_NEAR(volume(result.mesh) / volume(soup), 1, 1e-12);
  EXPECT_TRUE(is_manifold(result.mesh));
  expect_nearest_origins(result.mesh, soup);
}

TEST(Decimate, SquareKeepsItsBoundary) {
  const TriangleSoup soup = make_grid(10, 10);
  const Filtered result = filtered("decimate", soup, {{"faces", "2"}});
  ASSERT_EQ(result.mesh.triangles.size(), 2U);
  EXPECT_NEAR(area(result.mesh), area(soup), 1e-12);
  for (const Triangle& t : result.mesh.triangles) EXPECT_GT(face_normal(result.mesh, t).z(), 0.1);
}

TEST(Decimate, OpenCylinderKeepsItsCircles) {
  const TriangleSoup soup = make_cylinder(1, 2, 48, 20, false);
  const Filtered result = filtered("decimate", soup, {{"faces", "200"}});
  EXPECT_LE(result.mesh.triangles.size(), 201U);
  EXPECT_EQ(euler(result.mesh), 0);
  int boundary = 0;
  EXPECT_TRUE(is_manifold(result.mesh, &boundary));
  EXPECT_NEAR(area(result.mesh) / area(soup), 1, 0.02);
  double low = 0, high = 0;
  for (const Vec3& p : result.mesh.positions) {
    low = std::min(low, p.z());
    high = std::max(high, p.z());
    EXPECT_NEAR(p.head<2>().norm(), 1, 1e-12);
  }
  EXPECT_EQ(low, -1);
  EXPECT_EQ(high, 1);
}

// Faces between points of a sphere lie below it by their sagitta, which falls as one over their number, and so does
// the volume that they miss.
TEST(Decimate, ErrorOnASphereFallsWithTheNumberOfFaces) {
  const TriangleSoup soup = make_sphere(5);
  double before = 0;
  for (const int faces : {160, 640, 2560}) {
    const Filtered result = filtered("decimate", soup, {{"faces", std::to_string(faces)}});
    ASSERT_EQ(result.mesh.triangles.size(), static_cast<std::size_t>(faces));
    EXPECT_TRUE(is_manifold(result.mesh));
    EXPECT_EQ(euler(result.mesh), 2);
    for (const Triangle& t : result.mesh.triangles)
      EXPECT_GT(face_normal(result.mesh, t).dot(result.mesh.positions[t[0]]), 0);
    const double missed = 1 - volume(result.mesh) / (4 * pi / 3);
    if (before > 0) {
      EXPECT_GT(before / missed, 3);
      EXPECT_LT(before / missed, 5);
    }
    before = missed;
  }
}

TEST(Decimate, TorusKeepsItsHole) {
  const TriangleSoup soup = make_torus(3, 1, 60, 24);
  for (const char* faces : {"500", "60", "1"}) {
    Listening listening;
    const Filtered result = filtered("decimate", soup, {{"faces", faces}}, listening.context);
    EXPECT_TRUE(is_manifold(result.mesh));
    EXPECT_EQ(euler(result.mesh), 0);
    expect_nearest_origins(result.mesh, soup);
    EXPECT_EQ(listening.warnings.size(), std::string(faces) == "1" ? 1U : 0U);
  }
}

TEST(Decimate, SmallMeshesPassUntouched) {
  EXPECT_FALSE(filtered("decimate", make_sphere(2), {{"faces", "320"}}).called);
  const TriangleSoup one{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}, {0}, 1};
  EXPECT_FALSE(filtered("decimate", one, {{"faces", "1"}}).called);
}

TEST(Decimate, ScaleAndPlaceDoNotMatter) {
  const TriangleSoup soup = make_torus(3, 1, 40, 16);
  const TriangleSoup plain = filtered("decimate", soup, {{"faces", "300"}}).mesh;
  for (const double scale : {1e-30, 1e30}) {
    const TriangleSoup other = transformed(soup, Eigen::Matrix3d::Identity(), scale, Vec3::Zero());
    const TriangleSoup result = filtered("decimate", other, {{"faces", "300"}}).mesh;
    EXPECT_EQ(result.triangles.size(), plain.triangles.size());
    EXPECT_NEAR(volume(result) / std::pow(scale, 3) / volume(plain), 1, 0.01);
  }
}

TEST(Decimate, NonManifoldMeshesAreRefused) {
  TriangleSoup book{{{0, 0, 0}, {0, 0, 4}, {1, 0, 0}, {0, 1, 0}, {-1, -1, 0}}, {}, {}, 0};
  book.triangles = {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}};
  book.face_origin = {0, 1, 2};
  book.input_faces = 3;
  try {
    filtered("decimate", book, {{"faces", "1"}});
    FAIL() << "not refused";
  } catch (const std::exception& error) {
    EXPECT_NE(std::string(error.what()).find("prepare"), std::string::npos) << error.what();
  }
}

}  // namespace
