// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <map>

#include "base/errors.h"
#include "core/study/sample/sample_fixture.h"
#include "sample/lifting_surface.h"
#include "sample/solid.h"
#include "support/random.h"

namespace toposcope {
namespace {

using test::feature;

ParameterValues parameters(const std::map<std::string, double>& given = {}) {
  return check_parameters(airplane_kind(), given);
}

std::vector<Vec3> endpoints(const TruthFeature& f) {
  std::vector<Vec3> ends;
  for (const auto& [name, v] : f.parameters)
    if (name == "endpoints")
      for (std::size_t i = 0; i + 2 < v.size(); i += 3) ends.emplace_back(v[i], v[i + 1], v[i + 2]);
  return ends;
}

double distance_to_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const double t = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
  return (p - a - t * (b - a)).norm();
}

Planform planform() {
  Planform p;
  p.origin = Vec3(1, 2, 3);
  p.u = Vec3(-0.8, 0.6, 0);
  p.v = Vec3(0, 0, 1);
  p.span = 20;
  p.root_chord = 8;
  p.tip_chord = 5;
  p.sweep = 0.4;
  return p;
}

TEST(LiftingSurface, GradientIsTheUnitDerivative) {
  const LiftingSurface wing(planform());
  test::Random random(3);
  int compared = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vec3 p(random.uniform(-12, 12), random.uniform(-6, 12), random.uniform(-5, 28));
    const Distance d = wing(p);
    EXPECT_NEAR(d.gradient.norm(), 1, 1e-12);
    if (d.value < 0.01) continue;  // inside there are ridges
    constexpr double step = 1e-6;
    for (int k = 0; k < 3; ++k) {
      const double slope = (wing(p + step * Vec3::Unit(k)).value - wing(p - step * Vec3::Unit(k)).value) / (2 * step);
      EXPECT_NEAR(slope, d.gradient[k], 1e-5);
    }
    ++compared;
  }
  EXPECT_GT(compared, 1000);
}

TEST(LiftingSurface, DistanceIsToTheNearestBall) {
  // Without rounding, the balls are known: linear radii between leading edge, thickest part and trailing edge. A
  // straight wing has its section's measures everywhere.
  Planform p = planform();
  p.sweep = 0;
  p.tip_chord = p.root_chord;
  p.tip_rounding = 0;
  const LiftingSurface wing(p);
  const double half = 0.5 * p.thickness * p.root_chord;
  const auto at = [&](double u, double v, double w) { return Vec3(p.origin + u * p.u + v * p.v + w * p.u.cross(p.v)); };
  EXPECT_NEAR(wing(at(0, 10, 0)).value, 0, 1e-12) << "leading edge";
  EXPECT_NEAR(wing(at(-2, 10, 0)).value, 2, 1e-12);
  EXPECT_NEAR(wing(at(p.root_chord, 10, 0)).value, 0, 1e-12) << "trailing edge";
  EXPECT_NEAR(wing(at(0.3 * p.root_chord, 10, half)).value, 0, 1e-12) << "thickest part";
  EXPECT_NEAR(wing(at(0.3 * p.root_chord, 10, -half - 3)).value, 3, 1e-12);
  EXPECT_NEAR(wing(at(0.3 * p.root_chord, p.span, 0)).value, 0, 1e-12) << "tip";
}

TEST(LiftingSurface, OutlineLiesOnItAndIsContinuous) {
  for (const double rounding : {0.0, 0.4, 1.0}) {
    Planform p = planform();
    p.tip_rounding = rounding;
    const LiftingSurface wing(p);
    const Vec3 normal = p.u.cross(p.v);
    const auto pieces = wing.outline();
    Vec3 last = pieces.front().from;
    for (const auto& piece : pieces) {
      EXPECT_LT((piece.from - last).norm(), 1e-9);
      last = piece.to;
      for (const Vec3& x : {piece.from, Vec3(0.5 * (piece.from + piece.to)), piece.to}) {
        if (piece.radius > 0 && x != piece.from && x != piece.to) continue;
        EXPECT_NEAR(wing(x).value, 0, 1e-10);
        EXPECT_NEAR(wing(x).gradient.dot(normal), 0, 1e-7) << "the outline is the widest place";
      }
    }
    for (const Vec3& corner : wing.tip_corners()) EXPECT_NEAR((corner - p.origin).dot(p.v), p.span, 1e-9);
  }
}

TEST(Airplane, EdgesFollowTheirLineGroups) {
  for (const auto& given : {std::map<std::string, double>{}, {{"t_tail", 1}}, {{"engines", 2}, {"engine_drop", 1}}}) {
    const Solid solid = make_airplane(parameters(given));
    ASSERT_EQ(solid.features.size(), 5U);
    for (const TruthFeature& f : solid.features) {
      SCOPED_TRACE(f.name);
      const std::vector<Vec3> ends = endpoints(f);
      ASSERT_EQ(ends.size(), 4U) << "three segments: leading edge, tip, trailing edge";
      EXPECT_GT(f.points.size(), 15U);
      std::size_t exact = 0;
      for (const Vec3& p : f.points) {
        EXPECT_NEAR(solid.surface(p).value, 0, 1e-8);
        double least = 1e9;
        for (std::size_t i = 0; i < 3; ++i) least = std::min(least, distance_to_segment(p, ends[i], ends[i + 1]));
        EXPECT_LT(least, 1.5) << "at a rounded corner";
        exact += least < 1e-8;
      }
      EXPECT_GT(exact, 0.55 * static_cast<double>(f.points.size()));
      EXPECT_LT((f.points.front() - ends.front()).norm(), 1e-9);
      EXPECT_LT((f.points.back() - ends.back()).norm(), 1e-9);
    }
  }
}

TEST(Airplane, SidesMirrorEachOtherAndPortIsLeft) {
  const Solid solid = make_airplane(parameters());
  for (const char* name : {"WingE", "HzStabE"}) {
    const TruthFeature &port = feature(solid.features, std::string("p") + name),
                       &other = feature(solid.features, std::string("s") + name);
    ASSERT_EQ(port.points.size(), other.points.size());
    for (std::size_t i = 0; i < port.points.size(); ++i) {
      EXPECT_GT(port.points[i].y(), 0) << "the nose looks along +x, up is +z";
      EXPECT_EQ(port.points[i], other.points[i].cwiseProduct(Vec3(1, -1, 1)));
    }
  }
  test::Random random(5);
  for (int i = 0; i < 200; ++i) {
    const Vec3 p(random.uniform(-110, 10), random.uniform(-60, 60), random.uniform(-20, 30));
    EXPECT_EQ(solid.surface(p).value, solid.surface(p.cwiseProduct(Vec3(1, -1, 1))).value);
  }
  for (const Vec3& p : feature(solid.features, "vStabE").points) EXPECT_EQ(p.y(), 0);
}

TEST(Airplane, HasItsMeasures) {
  const Solid solid = make_airplane(parameters({{"wing_dihedral", 0}}));
  EXPECT_NEAR(solid.surface(Vec3(-25, 0, 6)).value, 0, 1e-9) << "top of the fuselage";
  EXPECT_NEAR(solid.surface(Vec3(0, 0, 0)).value, 0, 1e-9) << "nose";
  EXPECT_NEAR(solid.surface(Vec3(-100, 0, 0)).value, 0, 1e-9) << "tail";
  const std::vector<Vec3> wing = endpoints(feature(solid.features, "pWingE"));
  EXPECT_NEAR(wing[1].y(), 50, 1e-9) << "half the span";
  EXPECT_NEAR((wing[1] - wing[2]).norm(), 12, 1e-9) << "the tip's chord";
  EXPECT_NEAR(wing[1].x(), -34 - 50 * std::tan(12 * pi / 180), 1e-9);
  EXPECT_NEAR(wing[1].z(), -3, 1e-9);
  EXPECT_NEAR((wing[0] - wing[1]).normalized().dot(Vec3(std::tan(12 * pi / 180), -1, 0).normalized()), 1, 1e-12);
  EXPECT_NEAR(endpoints(feature(solid.features, "vStabE"))[1].z(), 20, 1e-9);
}

TEST(Airplane, PartsAreWhereTheyAre) {
  const Solid solid = make_airplane(parameters({{"engines", 2}}));
  ASSERT_EQ(solid.part_names, (std::vector<std::string>{"body", "wing", "stabilizer", "rudder", "engine"}));
  EXPECT_EQ(solid.part_of(Vec3(-25, 0, 6)), 0U);
  for (const TruthFeature& f : solid.features) {
    const std::size_t expected = f.name.find("Wing") != f.name.npos ? 1 : f.name == "vStabE" ? 3 : 2;
    for (std::size_t i = 5; i + 5 < f.points.size(); ++i) EXPECT_EQ(solid.part_of(f.points[i]), expected) << f.name;
  }
}

TEST(Airplane, RefusesWhatDoesNotFit) {
  const auto refused = [](const std::map<std::string, double>& given, const char* word) {
    try {
      make_airplane(parameters(given));
      ADD_FAILURE() << word;
    } catch (const UsageError& e) {
      EXPECT_NE(std::string(e.what()).find(word), std::string::npos) << e.what();
    }
  };
  refused({{"engines", 3}}, "engines is 3");
  refused({{"engines", 5}}, "between 0 and 4");
  refused({{"engines", 2}, {"engine_drop", 4}}, "engine_drop is 4");
  refused({{"wing_height", 6}}, "wing_height is 6");
  refused({{"fin_position", 90}}, "fin_position is 90");
  refused({{"wing_position", 70}}, "move the wing forward");
  refused({{"wing_sweep", 70}}, "wing_sweep is 70");
  refused({{"trailing_edge", 0.1}}, "trailing_edge is 0.1");
}

}  // namespace
}  // namespace toposcope
