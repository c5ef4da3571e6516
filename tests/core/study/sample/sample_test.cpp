// SPDX-License-Identifier: BSD-3-Clause
#include "sample/sample.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numeric>

#include "base/errors.h"
#include "core/study/sample/sample_fixture.h"
#include "sample/solid.h"

namespace toposcope {
namespace {

using test::edges;
using test::feature;
using test::make;
using test::value;
using test::volume;

TEST(Sample, VolumeOfAGlassIsThatOfTwoFrustums) {
  const Sample sample = make({.kind = "cup", .parameters = {{"handle", 0}}});
  const auto frustum = [](double a, double b, double h) { return pi * h / 3 * (a * a + a * b + b * b); };
  const double across = 4 / std::cos(std::atan2(41 - 35, 95));  // the wall, cut square to the axis
  const double inner_bottom = 35 + (41 - 35) * 5 / 95.0 - across;
  const double expected = frustum(41, 35, 95) - frustum(41 - across, inner_bottom, 90);
  EXPECT_NEAR(volume(sample.mesh), expected, 0.02 * expected);  // the rest is what the roundings take and give
}

TEST(Sample, RimIsTheCrestAndBottomIsTheLowestPlane) {
  const Sample sample = make({.kind = "cup", .faces = 5000});
  double highest = -1, lowest = 1e9;
  for (const Vec3& p : sample.mesh.positions) {
    highest = std::max(highest, p.z());
    lowest = std::min(lowest, p.z());
  }
  const double edge = edges(sample.mesh).mean;
  EXPECT_NEAR(value(feature(sample.truth.features, "rim"), "center")[2], 95, 1e-9);
  EXPECT_LE(highest, 95 + 1e-9);
  EXPECT_GT(highest, 95 - 0.1 * edge);
  EXPECT_NEAR(lowest, 0, 1e-9);
  const double slope = 6.0 / 95;
  EXPECT_NEAR(value(feature(sample.truth.features, "rim"), "radius").front(),
              41 - 2 * slope - 2 / std::cos(std::atan(slope)), 1e-9)
      << "the crest of a half-round lip stands over the wall's middle at the height of the arc's centre";
  for (const Vec3& p : feature(sample.truth.features, "bottom").points) EXPECT_EQ(p.z(), 0);
}

TEST(Sample, HandleEndsLieOnTheWallAndTheirRingsAroundThem) {
  const Sample sample = make({.kind = "cup", .faces = 20000});
  const TruthFeature& f = feature(sample.truth.features, "handleCon");
  const std::vector<double>& ends = value(f, "endpoints");
  ASSERT_EQ(ends.size(), 6U);
  ASSERT_EQ(f.groups.size(), 2U);
  for (std::size_t g = 0; g < 2; ++g) {
    const Vec3 end(ends[3 * g], ends[3 * g + 1], ends[3 * g + 2]);
    EXPECT_NEAR(end.x(), 35 + 6 * end.z() / 95, 1e-9);
    EXPECT_NEAR(end.z(), g == 0 ? 77 : 23, 1e-9);
    for (const Index i : f.groups[g].members) {
      const double distance = (f.points[i] - end).norm();
      EXPECT_GT(distance, 5) << "the handle's radius";
      EXPECT_LT(distance, 5 + 4 + 1) << "with its fillet";
    }
    EXPECT_GT(f.groups[g].members.size(), 15U);
    EXPECT_LT((f.groups[g].centroid - end).norm(), 2);
  }
}

TEST(Sample, HandleAndItsFilletStayOutOfTheCavity) {
  // Wall thinner than the fillet's radius: a fillet between handle and inner wall would bulge inwards.
  const Sample sample = make({.kind = "cup", .parameters = {{"wall", 3}, {"lip_radius", 1.5}}, .faces = 5000});
  const double slope = 6.0 / 95, across = 3 / std::cos(std::atan(slope));
  int inner = 0;
  for (const Vec3& p : sample.mesh.positions) {
    if (p.z() < 12 || p.z() > 93) continue;  // clear of bottom and lip
    const double inside = 35 + slope * p.z() - across - p.head<2>().norm();
    EXPECT_LT(inside, 1e-9);
    inner += inside > -1e-9 ? 1 : 0;
  }
  EXPECT_GT(inner, 300);
}

TEST(Sample, PartsAreConnectedToTheirPlace) {
  const Sample sample = make({.kind = "cup", .faces = 5000});
  ASSERT_EQ(sample.face_part.size(), sample.mesh.triangles.size());
  std::size_t handle = 0;
  for (std::size_t t = 0; t < sample.face_part.size(); ++t) {
    const Triangle& face = sample.mesh.triangles[t];
    Vec3 center = Vec3::Zero();
    for (const Index v : face) center += sample.mesh.positions[v] / 3;
    const double beyond = center.head<2>().norm() - (35 + 6 * center.z() / 95);
    if (beyond > 4 || beyond < 0) {
      EXPECT_EQ(sample.face_part[t], beyond > 4 ? 1 : 0);
    }
    handle += sample.face_part[t];
  }
  EXPECT_GT(handle, 200U);
}

TEST(Sample, IsTheSameAtAnyThreadCount) {
  const SampleRequest request{.kind = "tee", .parameters = {}, .faces = 3000, .noise_rel = 0.001, .seed = 5};
  const Sample one = make(request, 1), two = make(request, 2);
  EXPECT_EQ(one.mesh.triangles, two.mesh.triangles);
  EXPECT_EQ(one.mesh.positions, two.mesh.positions);
  EXPECT_EQ(truth_json(one), truth_json(two));
}

TEST(Sample, ScalesWithItsLengths) {
  // A power of two scales every rounding with it: the meshes agree bit for bit unless some length is absolute.
  SampleRequest request{.kind = "cup", .parameters = {}, .faces = 3000};
  const Sample small = make(request);
  for (const OptionRow& row : cup_kind().parameters)
    if (row.unit == "length")
      for (const auto& [name, v] : small.parameters)
        if (name == row.name) request.parameters[name] = 1024 * v;
  const Sample large = make(request);
  ASSERT_EQ(small.mesh.triangles, large.mesh.triangles);
  for (std::size_t v = 0; v < small.mesh.positions.size(); ++v)
    EXPECT_EQ(Vec3(1024 * small.mesh.positions[v]), large.mesh.positions[v]);
}

TEST(Sample, NoiseHasTheAskedSizeAndFollowsTheSeed) {
  SampleRequest request{.kind = "cup", .parameters = {{"handle", 0}}, .faces = 20000, .noise_rel = 0.002};
  const Sample noisy = make(request);
  const Solid solid = make_solid("cup", noisy.parameters);
  const double sd = 0.002 * std::sqrt(82 * 82 + 82 * 82 + 95 * 95);
  double mean = 0, squares = 0;
  for (const Vec3& p : noisy.mesh.positions) {
    const double d = solid.surface(p).value;
    mean += d;
    squares += d * d;
  }
  const auto count = static_cast<double>(noisy.mesh.positions.size());
  EXPECT_NEAR(mean / count, 0, 4 * sd / std::sqrt(count));
  EXPECT_NEAR(std::sqrt(squares / count), sd, 4 * sd / std::sqrt(2 * count) + 0.005 * sd);
  request.seed = 2;
  EXPECT_NE(make(request).mesh.positions, noisy.mesh.positions);
}

std::string error_of(const SampleRequest& request) {
  try {
    make(request);
  } catch (const UsageError& e) {
    return e.what();
  }
  return "no error";
}

TEST(Sample, ErrorsNameParameterValueAndRemedy) {
  const auto expect = [](const SampleRequest& request, const std::vector<std::string>& words) {
    const std::string message = error_of(request);
    for (const std::string& word : words) EXPECT_NE(message.find(word), std::string::npos) << word << ": " << message;
  };
  expect({.kind = "cop"}, {"'cop'", "cup"});
  expect({.kind = "cup", .parameters = {{"hieght", 3}}}, {"'hieght'", "height"});
  expect({.kind = "cup", .parameters = {{"height", -3}}}, {"height is -3", "greater than 0", "95"});
  expect({.kind = "cup", .parameters = {{"height", NAN}}}, {"height is nan"});
  expect({.kind = "cup", .parameters = {{"handle", 0.5}}}, {"handle is 0.5", "true or false"});
  expect({.kind = "cup", .parameters = {{"wall", 0.1}}}, {"wall is 0.1", "2 %", "thicker"});
  expect({.kind = "cup", .parameters = {{"wall", 10}, {"bottom_radius", 10}, {"lip_radius", 3}, {"top_radius", 60}}},
         {"cup: ", " is "});
  expect({.kind = "cup", .parameters = {{"lip_radius", 2.5}}}, {"lip_radius is 2.5", "wall / 2"});
  expect({.kind = "cup", .parameters = {{"handle_center", 85}}}, {"handle_center is 85", "lower handle_height"});
  expect({.kind = "cup", .parameters = {{"handle_reach", 8}}}, {"handle_reach is 8", "hole"});
  expect({.kind = "tee", .parameters = {{"branch_length", 22}}}, {"branch_length is 22", "longer"});
  expect({.kind = "tee", .parameters = {{"edge_rounding", 2}}}, {"edge_rounding is 2", "0.45"});
  expect({.kind = "tee", .parameters = {}, .faces = 10}, {"faces is 10", "500"});
  expect({.kind = "tee", .parameters = {}, .faces = 2000, .noise_rel = -1}, {"noise is -1", "0.1"});
}

TEST(Sample, EveryKindDescribesItsParameters) {
  for (const SampleKind& kind : sample_kinds()) {
    EXPECT_FALSE(kind.summary.empty());
    EXPECT_NO_THROW(make_solid(kind.name, check_parameters(kind, {}))) << kind.name << " with its defaults";
    for (const OptionRow& row : kind.parameters) {
      EXPECT_FALSE(row.meaning.empty()) << row.name;
      EXPECT_FALSE(row.default_value.empty()) << row.name;
      EXPECT_EQ(row.unit.empty(), row.type != OptionType::real) << row.name;
      EXPECT_TRUE(std::any_of(kind.ranges.begin(), kind.ranges.end(),
                              [&](const RandomRange& range) { return range.name == row.name; }))
          << row.name << " has no random range";
    }
  }
}

/// Out of reach, whatever constraint fails, the message names the parameter that was given.
TEST(SampleParameters, OutOfReachAreNamed) {
  for (const SampleKind& kind : sample_kinds())
    for (const OptionRow& row : kind.parameters)
      for (const double value : {1e-9, 1e9, -1.0, 1e300}) {
        SampleRequest request;
        request.kind = kind.name;
        request.faces = 1000;
        request.parameters[row.name] = value;
        try {
          make(request);
        } catch (const UsageError& error) {
          EXPECT_THAT(error.what(), ::testing::HasSubstr(row.name)) << kind.name << " " << value;
        }
      }
  const SampleRequest thick{.kind = "cup", .parameters = {{"height", 90}, {"wall", 100}}};
  EXPECT_THAT([&] { make(thick); }, ::testing::ThrowsMessage<UsageError>(
                                        ::testing::HasSubstr("cup: with wall = 100: bottom_thickness is 5")));
}

}  // namespace
}  // namespace toposcope
