// SPDX-License-Identifier: BSD-3-Clause
#include "sample/sample.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <numeric>
#include <set>

#include "base/errors.h"
#include "base/run_context.h"
#include "sample/isosurface.h"
#include "sample/solid.h"

namespace toposcope {
namespace {

using Parameters = std::map<std::string, double>;

Sample make(const SampleRequest& request, unsigned threads = 2) {
  RunContext context({.threads = threads});
  return make_sample(request, context);
}

Vec3 vec(const std::vector<double>& v) {
  return {v.at(0), v.at(1), v.at(2)};
}

const SampleFeature& feature(const Sample& sample, const std::string& name) {
  for (const SampleFeature& f : sample.features)
    if (f.name == name) return f;
  throw std::out_of_range(name);
}

const std::vector<double>& value(const SampleFeature& f, const std::string& name) {
  for (const auto& [key, v] : f.parameters)
    if (key == name) return v;
  throw std::out_of_range(name);
}

double volume(const TriangleSoup& mesh) {
  double six = 0;
  for (const Triangle& t : mesh.triangles)
    six += mesh.positions[t[0]].dot(mesh.positions[t[1]].cross(mesh.positions[t[2]]));
  return six / 6;
}

struct Edges {
  double mean = 0, variation = 0;  ///< mean length; standard deviation / mean
};
Edges edges(const TriangleSoup& mesh) {
  double sum = 0, squares = 0, count = 0;
  for (const Triangle& t : mesh.triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      const double length = (mesh.positions[t[i]] - mesh.positions[t[(i + 1) % 3]]).norm();
      sum += length;
      squares += length * length;
      ++count;
    }
  const double mean = sum / count;
  return {mean, std::sqrt(squares / count - mean * mean) / mean};
}

struct Case {
  const char* name;
  const char* kind;
  Index faces;
  Parameters parameters;
  long euler;
};
std::ostream& operator<<(std::ostream& out, const Case& c) {
  return out << c.name;
}

void expect_good_mesh(const Sample& sample, const Solid& solid, const Case& c) {
  const TriangleSoup& mesh = sample.mesh;

  EXPECT_NEAR(static_cast<double>(mesh.triangles.size()), c.faces, 0.03 * c.faces);
  std::set<std::pair<Index, Index>> directed;
  for (const Triangle& t : mesh.triangles)
    for (std::size_t i = 0; i < 3; ++i) EXPECT_TRUE(directed.emplace(t[i], t[(i + 1) % 3]).second);
  for (const auto& [a, b] : directed) EXPECT_TRUE(directed.count({b, a}));
  EXPECT_TRUE(is_closed_manifold(mesh));
  EXPECT_EQ(static_cast<long>(mesh.positions.size()) - static_cast<long>(directed.size() / 2) +
                static_cast<long>(mesh.triangles.size()),
            c.euler);
  EXPECT_GT(volume(mesh), 0);

  const Edges e = edges(mesh);
  testing::Test::RecordProperty("edge_length_variation", std::to_string(e.variation));
  EXPECT_LT(e.variation, 0.45);
  for (const Vec3& p : mesh.positions) EXPECT_LT(std::abs(solid.surface(p).value), 1e-3 * e.mean);

  double quality = 0;
  for (const Triangle& t : mesh.triangles) {
    const Vec3 &p = mesh.positions[t[0]], &q = mesh.positions[t[1]], &r = mesh.positions[t[2]];
    const Vec3 area = (q - p).cross(r - p);
    const double shape =
        2 * std::sqrt(3.0) * area.norm() / ((q - p).squaredNorm() + (r - q).squaredNorm() + (p - r).squaredNorm());
    EXPECT_GT(shape, 0.2) << "1 for an equilateral triangle";
    quality += shape;
    const Vec3 normal = solid.surface(p).gradient + solid.surface(q).gradient + solid.surface(r).gradient;
    EXPECT_GT(area.dot(normal), 0) << "a face that looks inwards";
  }
  EXPECT_GT(quality / static_cast<double>(mesh.triangles.size()), 0.88);
}

void expect_truth_on_surface(const Sample& sample, const Solid& solid) {
  const double mean_edge = edges(sample.mesh).mean;
  for (const SampleFeature& f : sample.features) {
    SCOPED_TRACE(f.name);
    ASSERT_EQ(f.points.size(), f.vertices.size());
    for (std::size_t i = 0; i < f.points.size(); ++i) {
      EXPECT_LT(std::abs(solid.surface(f.points[i]).value), 1e-9 * mean_edge);
      EXPECT_LT((sample.mesh.positions[f.vertices[i]] - f.points[i]).norm(), 1.5 * mean_edge);
    }
    EXPECT_EQ(std::set<Index>(f.vertices.begin(), f.vertices.end()).size(), f.vertices.size());
    if (f.shape == "circle" && !f.points.empty()) {
      const Vec3 center = vec(value(f, "center")), normal = vec(value(f, "normal"));
      const double radius = value(f, "radius").front();
      EXPECT_GE(f.points.size(), 20U);
      for (const Vec3& p : f.points) {
        EXPECT_NEAR((p - center).norm(), radius, 1e-9 * radius);
        EXPECT_NEAR((p - center).dot(normal), 0, 1e-9 * radius);
      }
    }
  }
}

class SampleMesh : public testing::TestWithParam<Case> {};

TEST_P(SampleMesh, IsGoodAndLiesWithItsTruthOnTheExactSurface) {
  const Case& c = GetParam();
  const Sample sample = make({.kind = c.kind, .parameters = c.parameters, .faces = c.faces});
  const Solid solid = make_solid(c.kind, sample.parameters);
  expect_good_mesh(sample, solid, c);
  expect_truth_on_surface(sample, solid);
}

INSTANTIATE_TEST_SUITE_P(
    Kinds, SampleMesh,
    testing::Values(
        Case{"cup_2k", "cup", 2000, {}, 0}, Case{"cup_5k", "cup", 5000, {}, 0}, Case{"cup_20k", "cup", 20000, {}, 0},
        Case{"glass_5k", "cup", 5000, {{"handle", 0}}, 2},
        Case{"leaning_cup_5k", "cup", 5000, {{"top_radius", 50}, {"lip_radius", 1.2}}, 0},
        Case{"tee_2k", "tee", 2000, {}, -2}, Case{"tee_5k", "tee", 5000, {}, -2}, Case{"tee_20k", "tee", 20000, {}, -2},
        Case{"wye_5k", "wye", 5000, {}, -2}, Case{"cross_5k", "cross", 5000, {}, -4},
        Case{"elbow_5k", "elbow", 5000, {}, 0}, Case{"mitred_elbow_3k", "elbow", 3000, {{"mitred", 1}}, 0},
        Case{"tricorner_5k", "tricorner", 5000, {}, -2},
        Case{"socket_wye_5k",
             "wye",
             5000,
             {{"socket", 1}, {"run_length", 180}, {"branch_length", 120}, {"branch_angle", 60}},
             -2},
        Case{"socket_elbow_5k", "elbow", 5000, {{"socket", 1}, {"leg1_length", 60}, {"leg2_length", 55}}, 0},
        Case{"airplane_5k", "airplane", 5000, {}, 2}, Case{"airplane_10k", "airplane", 10000, {}, 2},
        Case{"t_tail_8k", "airplane", 8000, {{"t_tail", 1}, {"wing_height", 4}, {"wing_sweep", 30}}, 2},
        Case{"two_engines_8k", "airplane", 8000, {{"engines", 2}}, 2},
        Case{"four_engines_8k", "airplane", 8000, {{"engines", 4}, {"engine_drop", 1}}, 2},
        Case{"rear_engines_8k",
             "airplane",
             8000,
             {{"engines", 2}, {"engines_at_rear", 1}, {"engine_drop", 6}, {"wing_position", 28}},
             2},
        Case{"socket_tee_5k", "tee", 5000, {{"socket", 1}, {"run_length", 140}, {"branch_length", 70}}, -2}),
    [](const auto& parameter) { return std::string(parameter.param.name); });

TEST(Sample, EveryPresetIsAGoodMeshAndLiesWithItsTruthOnTheExactSurface) {
  for (const SampleKind& kind : sample_kinds())
    for (const SamplePreset& preset : kind.presets) {
      SCOPED_TRACE(kind.name + " " + preset.name);
      const Index faces = kind.name == "airplane" ? 10000 : 6000;
      const Sample sample = make({.kind = kind.name, .faces = faces, .preset = preset.name});
      const std::map<std::string, long> euler = {{"cup", 0},   {"tee", -2},       {"wye", -2},    {"cross", -4},
                                                 {"elbow", 0}, {"tricorner", -2}, {"airplane", 2}};
      const Solid solid = make_solid(kind.name, sample.parameters);
      expect_good_mesh(sample, solid, {"", kind.name.c_str(), faces, {}, euler.at(kind.name)});
      expect_truth_on_surface(sample, solid);
      EXPECT_EQ(sample.face_part.size(), sample.mesh.triangles.size());
    }
}

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
  EXPECT_NEAR(value(feature(sample, "rim"), "center")[2], 95, 1e-9);
  EXPECT_LE(highest, 95 + 1e-9);
  EXPECT_GT(highest, 95 - 0.1 * edge);
  EXPECT_NEAR(lowest, 0, 1e-9);
  const double slope = 6.0 / 95;
  EXPECT_NEAR(value(feature(sample, "rim"), "radius").front(), 41 - 2 * slope - 2 / std::cos(std::atan(slope)), 1e-9)
      << "the crest of a half-round lip stands over the wall's middle at the height of the arc's centre";
  for (const Vec3& p : feature(sample, "bottom").points) EXPECT_EQ(p.z(), 0);
}

TEST(Sample, HandleEndsLieOnTheWallAndTheirRingsAroundThem) {
  const Sample sample = make({.kind = "cup", .faces = 20000});
  const SampleFeature& f = feature(sample, "handleCon");
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

TEST(TruthJson, HasFeaturesGroupsAndParts) {
  const Sample sample = make({.kind = "cup", .faces = 2000});
  const auto json = nlohmann::json::parse(truth_json(sample, "cup.ply"));
  EXPECT_EQ(json.at("mesh"), "cup.ply");
  EXPECT_EQ(json.at("class"), "cup");
  const auto& rim = json.at("features").at("rim");
  EXPECT_EQ(rim.at("shape"), "circle");
  EXPECT_EQ(rim.at("points").size(), rim.at("vertices").size());
  EXPECT_EQ(rim.at("parameters").at("normal"), (std::vector<double>{0, 0, 1}));
  EXPECT_TRUE(rim.at("parameters").at("radius").is_number());
  const auto& handle = json.at("features").at("handleCon");
  EXPECT_EQ(handle.at("groups").size(), 2U);
  EXPECT_EQ(handle.at("groups")[0].at("name"), "upper");
  EXPECT_EQ(handle.at("groups")[0].at("points").size(), handle.at("groups")[0].at("vertices").size());
  EXPECT_EQ(handle.at("parameters").at("endpoints").size(), 2U);
  EXPECT_EQ(handle.at("parameters").at("closed"), false);
  std::set<std::size_t> faces;
  for (const auto& [name, list] : json.at("parts").items())
    for (const std::size_t f : list) EXPECT_TRUE(faces.insert(f).second) << "a face in two parts";
  EXPECT_EQ(faces.size(), sample.mesh.triangles.size());
}

TEST(TruthJson, MissingHandleHasNoPoints) {
  const Sample sample = make({.kind = "cup", .parameters = {{"handle", 0}}, .faces = 2000});
  const auto json = nlohmann::json::parse(truth_json(sample));
  EXPECT_TRUE(json.at("features").at("handleCon").at("points").empty());
  EXPECT_TRUE(json.at("features").at("handleCon").at("groups").empty());
}

TEST(IsClosedManifold, TellsTheFaultsApart) {
  TriangleSoup mesh;
  mesh.positions.resize(7, Vec3::Zero());
  mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  EXPECT_TRUE(is_closed_manifold(mesh));
  TriangleSoup open = mesh;
  open.triangles.pop_back();
  EXPECT_FALSE(is_closed_manifold(open));
  TriangleSoup turned = mesh;
  std::swap(turned.triangles[0][0], turned.triangles[0][1]);
  EXPECT_FALSE(is_closed_manifold(turned));
  TriangleSoup pinched = mesh;  // a second tetrahedron that shares vertex 3 alone
  for (const Triangle& t : {Triangle{4, 6, 5}, Triangle{4, 5, 3}, Triangle{5, 6, 3}, Triangle{6, 4, 3}})
    pinched.triangles.push_back(t);
  EXPECT_FALSE(is_closed_manifold(pinched));
}

}  // namespace
}  // namespace toposcope
