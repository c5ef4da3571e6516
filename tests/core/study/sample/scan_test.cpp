// SPDX-License-Identifier: BSD-3-Clause
#include "sample/scan.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "base/errors.h"
#include "core/study/sample/sample_fixture.h"
#include "sample/isosurface.h"
#include "sample/solid.h"
#include "support/plugins.h"
#include "support/program.h"
#include "toposcope/geometry/closest_face.h"

namespace toposcope {
namespace {

using test::edges;
using test::feature;
using test::value;
using test::vec;

Sample scanned(const SampleRequest& request, const ScanSettings& settings, unsigned threads = 2) {
  RunContext context({.threads = threads});
  return scan(make_scan_target(request, context), settings, test::host(), context);
}

/// Back in the object's own frame.
Vec3 unposed(const ScanRecord& scan, const Vec3& p) {
  const Vec3 moved = p - scan.translation;
  return moved.x() * scan.rotation[0] + moved.y() * scan.rotation[1] + moved.z() * scan.rotation[2];
}

struct Case {
  const char* name;
  const char* kind;
  std::map<std::string, double> parameters;
  Index faces;
  long euler;
};
std::ostream& operator<<(std::ostream& out, const Case& c) {
  return out << c.name;
}

class ScannedObject : public testing::TestWithParam<Case> {};

TEST_P(ScannedObject, IsClosedWithItsFeaturesInTheirPlaces) {
  const Case& c = GetParam();
  const Sample made = scanned({.kind = c.kind, .parameters = c.parameters}, {.faces = c.faces, .seed = 5});
  const Solid solid = make_solid(c.kind, made.parameters);
  EXPECT_TRUE(is_closed_manifold(made.mesh));
  EXPECT_EQ(static_cast<long>(made.mesh.positions.size()) - static_cast<long>(made.mesh.triangles.size() / 2), c.euler);
  EXPECT_NEAR(static_cast<double>(made.mesh.triangles.size()), c.faces, 0.03 * c.faces);
  ASSERT_TRUE(made.scan);
  EXPECT_FALSE(made.scan->partial);

  // The surface is where it was, but for hollows that no view sees into.
  const double edge = edges(made.mesh).mean;
  double off = 0;
  for (const Vec3& p : made.mesh.positions) off += std::abs(solid.surface(unposed(*made.scan, p)).value);
  EXPECT_LT(off / static_cast<double>(made.mesh.positions.size()), 0.05 * edge);

  const ClosestFace surface(made.mesh.positions, made.mesh.triangles);
  for (const TruthFeature& f : made.truth.features) {
    SCOPED_TRACE(f.name);
    ASSERT_EQ(f.points.size(), f.vertices.size());
    double distance = 0;
    for (std::size_t i = 0; i < f.points.size(); ++i) {
      EXPECT_LT(std::abs(solid.surface(unposed(*made.scan, f.points[i])).value), 1e-9) << "points stay exact";
      distance += std::sqrt(surface(f.points[i]).squared_distance);
      const double to_vertex = (made.mesh.positions[f.vertices[i]] - f.points[i]).squaredNorm();
      for (const Vec3& p : made.mesh.positions) ASSERT_GE((p - f.points[i]).squaredNorm(), to_vertex);
    }
    EXPECT_EQ(std::set<Index>(f.vertices.begin(), f.vertices.end()).size(), f.vertices.size());
    if (!f.points.empty()) {
      EXPECT_LT(distance / static_cast<double>(f.points.size()), 0.25 * edge);
    }
    if (f.shape == "circle" && !f.points.empty()) {
      const Vec3 center = vec(value(f, "center")), normal = vec(value(f, "normal"));
      for (const Vec3& p : f.points) {
        EXPECT_NEAR((p - center).norm(), value(f, "radius").front(), 1e-9);
        EXPECT_NEAR((p - center).dot(normal), 0, 1e-9);
      }
    }
  }

  ASSERT_EQ(made.face_part.size(), made.mesh.triangles.size());
  std::size_t right = 0;
  for (std::size_t f = 0; f < made.face_part.size(); ++f) {
    const Triangle& t = made.mesh.triangles[f];
    const Vec3 center = (made.mesh.positions[t[0]] + made.mesh.positions[t[1]] + made.mesh.positions[t[2]]) / 3;
    const Vec3 exact = project(solid.surface, unposed(*made.scan, center), 1);
    right += solid.part_of(exact) == made.face_part[f] ? 1 : 0;
  }
  EXPECT_GT(static_cast<double>(right), 0.99 * static_cast<double>(made.face_part.size()));
}

INSTANTIATE_TEST_SUITE_P(
    Kinds, ScannedObject,
    testing::Values(Case{"cup_5k", "cup", {}, 5000, 0}, Case{"cup_20k", "cup", {}, 20000, 0},
                    Case{"thin_glass", "cup", {{"handle", 0}, {"wall", 2.4}, {"lip_radius", 1}}, 10000, 2},
                    Case{"tee_5k", "tee", {}, 5000, -2}, Case{"tee_10k", "tee", {}, 10000, -2},
                    Case{"airplane_10k", "airplane", {}, 10000, 2}),
    [](const auto& c) { return std::string(c.param.name); });

TEST(Scan, PoseIsARotationAndFollowsTheSeed) {
  const Sample a = scanned({.kind = "cup"}, {.faces = 2000, .seed = 1});
  const Sample b = scanned({.kind = "cup"}, {.faces = 2000, .seed = 2});
  for (const Sample* sample : {&a, &b}) {
    Eigen::Matrix3d rotation;
    for (Eigen::Index k = 0; k < 3; ++k) rotation.row(k) = sample->scan->rotation[static_cast<std::size_t>(k)];
    EXPECT_LT((rotation * rotation.transpose() - Eigen::Matrix3d::Identity()).norm(), 1e-12);
    EXPECT_NEAR(rotation.determinant(), 1, 1e-12);
  }
  EXPECT_GT((a.scan->rotation[0] - b.scan->rotation[0]).norm() + (a.scan->rotation[1] - b.scan->rotation[1]).norm(),
            0.01);
  EXPECT_GT((a.scan->translation - b.scan->translation).norm(), 0.01);
}

TEST(Scan, IsTheSameAtAnyThreadCount) {
  for (const Index seen_from : {0U, 3U}) {
    const ScanSettings settings{.faces = 3000, .viewpoints = 30, .seen_from = seen_from, .seed = 9};
    const Sample one = scanned({.kind = "cup"}, settings, 1), two = scanned({.kind = "cup"}, settings, 2);
    EXPECT_EQ(one.mesh.positions, two.mesh.positions);
    EXPECT_EQ(one.mesh.triangles, two.mesh.triangles);
    EXPECT_EQ(one.face_part, two.face_part);
    EXPECT_EQ(truth_json(one), truth_json(two));
  }
}

TEST(Scan, SeenFromOneSideIsOpenAndTellsOnlyWhatIsThere) {
  const Sample whole = scanned({.kind = "cup"}, {.faces = 10000, .seed = 1});
  std::set<std::string> dropped, kept;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const Sample part = scanned({.kind = "cup"}, {.faces = 10000, .seen_from = 2, .seed = seed});
    EXPECT_TRUE(part.scan->partial);
    EXPECT_FALSE(is_closed_manifold(part.mesh));
    EXPECT_LT(part.mesh.triangles.size(), 0.75 * 10000);
    EXPECT_GT(part.mesh.triangles.size(), 500U);
    EXPECT_NEAR(edges(part.mesh).mean, edges(whole.mesh).mean, 0.1 * edges(whole.mesh).mean);
    const Solid solid = make_solid("cup", part.parameters);
    for (const Vec3& p : part.mesh.positions)
      EXPECT_LT(std::abs(solid.surface(unposed(*part.scan, p)).value), 1.5 * part.scan->spacing)
          << "nothing that closes the surface is left";
    const ClosestFace surface(part.mesh.positions, part.mesh.triangles);
    for (const TruthFeature& f : part.truth.features) {
      (f.points.empty() ? dropped : kept).insert(f.name);
      const auto all = static_cast<double>(feature(whole.truth.features, f.name).points.size());
      if (!f.points.empty()) {
        // Points whose vertex is shared are left out, so that few less than the share may be listed.
        EXPECT_GE(static_cast<double>(f.points.size()), 0.8 * least_share * all) << f.name;
      }
      for (const Vec3& p : f.points) EXPECT_LE(std::sqrt(surface(p).squared_distance), 3 * part.scan->spacing);
      for (const TruthGroup& group : f.groups) EXPECT_FALSE(group.members.empty());
    }
  }
  EXPECT_FALSE(dropped.empty());
  EXPECT_FALSE(kept.empty());
}

TEST(Scan, WithoutPartsTheRestIsTheSame) {
  const Sample with = scanned({.kind = "cup"}, {.faces = 2000, .seed = 3});
  const Sample without = scanned({.kind = "cup"}, {.faces = 2000, .seed = 3, .parts = false});
  EXPECT_FALSE(with.part_names.empty());
  EXPECT_TRUE(without.part_names.empty());
  EXPECT_EQ(with.mesh.positions, without.mesh.positions);
  EXPECT_EQ(with.mesh.triangles, without.mesh.triangles);
  for (std::size_t f = 0; f < with.truth.features.size(); ++f)
    EXPECT_EQ(with.truth.features[f].points, without.truth.features[f].points);
}

TEST(Scan, ErrorsNameValueAndRemedy) {
  RunContext context({.threads = 2});
  const Sample target = make_scan_target({.kind = "tee"}, context);
  const auto message = [&](const ScanSettings& settings) -> std::string {
    try {
      scan(target, settings, test::host(), context);
    } catch (const UsageError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(message({.viewpoints = 2}).find("viewpoints is 2: it must lie between 4 and 1000"), std::string::npos);
  EXPECT_NE(message({.seen_from = 2000}).find("2000 viewpoints: it must be at most 1000"), std::string::npos);
  EXPECT_NE(message({.noise_rel = -1}).find("noise is -1 box diagonals"), std::string::npos);
  EXPECT_NE(message({.noise_rel = NAN}).find("it must lie between 0 and 0.02"), std::string::npos);
}

TEST(SampleCommand, ScansAndWritesHowInTheTruth) {
  const test::TemporaryFolder folder;
  const std::string mesh = (folder / "cup.ply").string();
  const test::Outcome done = test::toposcope("sample cup --scan --view 3 --scan-noise 0.001 --faces 2000 -o " + mesh);
  ASSERT_EQ(done.exit_code, 0) << done.err;
  const auto truth = nlohmann::json::parse(test::read_text(folder / "cup.truth.json"));
  const auto& record = truth.at("sample").at("scan");
  EXPECT_EQ(record.at("viewpoints"), 3);
  EXPECT_EQ(record.at("partial"), true);
  EXPECT_EQ(record.at("noise_rel"), 0.001);
  EXPECT_EQ(record.at("rotation").size(), 3U);
  const test::Outcome both = test::toposcope("sample cup --scan --noise 0.01 -o " + mesh);
  EXPECT_EQ(both.exit_code, 2);
  EXPECT_NE(both.err.find("--scan-noise"), std::string::npos) << both.err;
  EXPECT_EQ(test::toposcope("sample cup --view 3 -o " + mesh).exit_code, 2) << "only with --scan";
}

}  // namespace
}  // namespace toposcope
