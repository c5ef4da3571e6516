// SPDX-License-Identifier: BSD-3-Clause
#include <random>

#include "plugins/filters/filter_fixture.h"

namespace {

using namespace toposcope;
using namespace toposcope::test;

constexpr double lambda = 0.63, pass_band = 0.1;

double transfer(double k, int passes) {
  const double mu = 1 / (pass_band - 1 / lambda);
  return std::pow((1 - lambda * k) * (1 - mu * k), passes);
}

TriangleSoup noisy(TriangleSoup soup, double deviation, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal(0, deviation);
  for (Vec3& p : soup.positions) p += Vec3(normal(random), normal(random), normal(random));
  return soup;
}

double radial_noise(const TriangleSoup& soup) {
  double sum = 0, squares = 0;
  for (const Vec3& p : soup.positions) {
    sum += p.norm();
    squares += p.squaredNorm();
  }
  const auto n = static_cast<double>(soup.positions.size());
  return std::sqrt(squares / n - sum * sum / (n * n));
}

TEST(Taubin, EigenvectorsOfTheTorusAreScaledByTheTransferFunction) {
  const int nu = 24, nv = 16;
  for (const auto& [m, l] : std::vector<std::pair<int, int>>{{1, 0}, {0, 2}, {3, 2}, {12, 8}, {5, 7}})
    for (const int passes : {1, 4}) {
      // Positions are a pair of eigenvectors of the grid, whatever they look like as a surface.
      TriangleSoup soup = make_torus(3, 1, nu, nv);
      for (int i = 0; i < nu; ++i)
        for (int j = 0; j < nv; ++j) {
          const double phase = 2 * pi * (double(m) * i / nu + double(l) * j / nv) + 0.3;
          soup.positions[static_cast<std::size_t>(i * nv + j)] = {std::cos(phase), std::sin(phase), 0};
        }
      const double a = 2 * pi * m / nu, b = 2 * pi * l / nv;
      const double k = 1 - (std::cos(a) + std::cos(b) + std::cos(a + b)) / 3;
      const Filtered result = filtered("taubin", soup, {{"passes", std::to_string(passes)}});
      for (std::size_t v = 0; v < soup.positions.size(); ++v)
        EXPECT_LT((result.mesh.positions[v] - transfer(k, passes) * soup.positions[v]).norm(), 1e-12)
            << m << ' ' << l << ' ' << passes;
    }
}

TEST(Taubin, BoundaryIsAClosedCurveOfItsOwn) {
  const int around = 20;
  TriangleSoup soup = make_cylinder(1, 2, around, 6, false);
  const double k = 1 - std::cos(2 * pi / around);
  const Filtered result = filtered("taubin", soup, {{"passes", "5"}});
  for (std::size_t v = 0; v < around; ++v) {
    const Vec3 expected(transfer(k, 5) * soup.positions[v].x(), transfer(k, 5) * soup.positions[v].y(), -1);
    EXPECT_LT((result.mesh.positions[v] - expected).norm(), 1e-12);
  }
}

TEST(Taubin, KeptBoundaryDoesNotMove) {
  const TriangleSoup soup = noisy(make_grid(8, 8), 0.01, 3);
  const Filtered result = filtered("taubin", soup, {{"boundary", "keep"}});
  int kept = 0, moved = 0;
  for (std::size_t v = 0; v < soup.positions.size(); ++v) {
    const bool same = soup.positions[v] == result.mesh.positions[v];
    kept += same;
    moved += !same;
  }
  EXPECT_EQ(kept, 32);
  EXPECT_EQ(moved, 49);
}

// No wave grows by more than the filter's gain in the middle of its pass band.
TEST(Taubin, SphereKeepsItsVolume) {
  const TriangleSoup soup = make_sphere(4);
  for (const auto& [passes, bound] : std::vector<std::pair<int, double>>{{10, 0.005}, {50, 0.02}}) {
    const double ratio = volume(filtered("taubin", soup, {{"passes", std::to_string(passes)}}).mesh) / volume(soup);
    EXPECT_NEAR(ratio, 1, bound) << passes;
    EXPECT_LT(ratio, std::pow(transfer(pass_band / 2, passes), 3));
    EXPECT_GT(ratio, 1);
  }
}

TEST(Taubin, NoiseFallsAndTheSphereStays) {
  const TriangleSoup clean = make_sphere(4), soup = noisy(clean, 0.01, 7);
  const Filtered result = filtered("taubin", soup, {{"passes", "50"}});
  EXPECT_LT(radial_noise(result.mesh), radial_noise(soup) / 3);
  EXPECT_NEAR(volume(result.mesh) / volume(filtered("taubin", clean, {{"passes", "50"}}).mesh), 1, 0.002);
}

TEST(Taubin, PlaneStaysFlat) {
  const TriangleSoup soup = transformed(make_grid(9, 7), random_rotation(2), 3, Vec3(1, 2, 3));
  const Vec3 normal = face_normal(soup, soup.triangles[0]).normalized();
  for (const Vec3& p : filtered("taubin", soup, {}).mesh.positions)
    EXPECT_NEAR(normal.dot(p - soup.positions[0]), 0, 1e-12);
}

TEST(Taubin, FacesAndTheirOriginsStay) {
  const TriangleSoup soup = make_sphere(2);
  const Filtered result = filtered("taubin", soup, {});
  EXPECT_EQ(result.mesh.triangles, soup.triangles);
  for (Index f = 0; f < soup.triangles.size(); ++f) EXPECT_EQ(result.mesh.face_origin[f], f);
  EXPECT_FALSE(filtered("taubin", soup, {{"passes", "0"}}).called);
}

TEST(Taubin, PoseScaleAndOrderDoNotMatter) {
  const TriangleSoup soup = noisy(make_torus(3, 1, 30, 12), 0.05, 5);
  const TriangleSoup plain = filtered("taubin", soup, {}).mesh;
  std::vector<Index> new_vertex;
  const Eigen::Matrix3d rotation = random_rotation(9);
  const Vec3 shift(4, 5, 6);
  const TriangleSoup other = transformed(shuffled(soup, 11, &new_vertex), rotation, 100, shift);
  const TriangleSoup result = filtered("taubin", other, {}).mesh;
  for (std::size_t v = 0; v < soup.positions.size(); ++v)
    EXPECT_LT((result.positions[new_vertex[v]] - (rotation * (100 * plain.positions[v]) + shift)).norm(), 1e-9);
}

TEST(Taubin, SameAtAnyThreadCount) {
  const TriangleSoup soup = noisy(make_sphere(5), 0.01, 1);
  EXPECT_EQ(filtered("taubin", soup, {}, test::context(1)).mesh.positions,
            filtered("taubin", soup, {}, test::context(4)).mesh.positions);
}

TEST(Taubin, NonManifoldMeshesAreSmoothedToo) {
  TriangleSoup book{{{0, 0, 0}, {0, 0, 4}, {1, 0, 0}, {0, 1, 0}, {-1, -1, 0}, {9, 9, 9}}, {}, {}, 0};
  book.triangles = {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}};
  book.face_origin = {0, 1, 2};
  book.input_faces = 3;
  const Filtered result = filtered("taubin", book, {});
  EXPECT_EQ(result.mesh.positions[5], book.positions[5]) << "a vertex without faces stays";
  for (const Vec3& p : result.mesh.positions) EXPECT_TRUE(p.allFinite());
}

TEST(Taubin, AmplifyingSettingsAreRefused) {
  try {
    test::filter("taubin", {{"lambda", "0.9"}});
    FAIL() << "not refused";
  } catch (const std::exception& error) {
    EXPECT_NE(std::string(error.what()).find("lambda"), std::string::npos) << error.what();
  }
}

}  // namespace
