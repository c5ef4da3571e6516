// SPDX-License-Identifier: BSD-3-Clause

// The shipped models and pipeline on real meshes with marked features. The meshes are not part of the project: without
// them the tests skip.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>

#include "io/mesh_io.h"
#include "model/read_model.h"
#include "pipeline/pipeline_manifest.h"
#include "result/result.h"
#include "support/plugins.h"
#include "support/program.h"

namespace toposcope {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

const fs::path data = fs::path(TOPOSCOPE_SOURCE_DIR) / "../shared/data/psb";

struct Marked {
  Result result;
  json truth;
  fs::path mesh;

  const FeatureReport& feature(const std::string& name) const {
    for (const FeatureReport& report : result.features)
      if (report.name == name) return report;
    throw std::out_of_range(name);
  }
  std::vector<Vec3> points(const std::string& name) const {
    std::vector<Vec3> points;
    for (const json& p : truth["features"][name].value("points", json::array()))
      points.emplace_back(p[0].get<double>(), p[1].get<double>(), p[2].get<double>());
    return points;
  }
  /// Mean distance from the marked points to the labelled shape, mesh unit.
  double distance(const std::string& name) const {
    const FeatureReport& report = feature(name);
    const auto fitter = test::shape(report.shape_plugin);
    double sum = 0;
    const std::vector<Vec3> marks = points(name);
    for (const Vec3& p : marks) sum += fitter->distance(report.shape, p);
    return sum / static_cast<double>(marks.size());
  }
};

std::vector<Marked> label_all(const std::string& model_name) {
  const PluginCatalog& catalog = test::host().catalog();
  const fs::path source = TOPOSCOPE_SOURCE_DIR;
  const Model model = read_model(source / "models" / (model_name + ".yaml"), &catalog);
  const Stations stations =
      make_stations(test::host(), read_pipeline(source / "pipelines/default.yaml", catalog), model);
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(data / model_name))
    if (entry.path().extension() == ".off") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  std::vector<Marked> all;
  for (const fs::path& file : files) {
    const Mesh mesh = read_mesh(file);
    all.push_back({explain(analyze(mesh, model, stations, {}, test::context(2)), model, file.string(), stations,
                           test::context(2)),
                   json::parse(test::read_text(fs::path(file).replace_extension(".truth.json"))), file});
  }
  return all;
}

TEST(RealMeshes, RimAndBottomEdgeOfEveryCupAndNoHandleWhereThereIsNone) {
  if (!fs::exists(data)) GTEST_SKIP() << data << " is not here: real meshes are not part of the project";
  for (const Marked& cup : label_all("cup")) {
    const double edge = cup.truth["frame"]["mean_edge"];
    for (const char* name : {"rim", "bottomEdge"}) {
      ASSERT_TRUE(cup.feature(name).present) << cup.mesh << " " << name;
      EXPECT_LT(cup.distance(name), 2 * edge) << cup.mesh << " " << name;
    }
    const FeatureReport& handle = cup.feature("handleCon");
    const json groups = cup.truth["features"]["handleCon"].value("groups", json::array());
    EXPECT_EQ(handle.present, !groups.empty()) << cup.mesh;
    if (!handle.present) {
      EXPECT_FALSE(handle.missing.reason.empty());
      continue;
    }
    // Each end within 5 % of the diagonal of the centroid of its ring of marks.
    const TriangleSoup soup = read_soup(cup.mesh);
    std::vector<Vec3> centres;
    for (const json& group : groups) {
      Vec3 sum = Vec3::Zero();
      for (const json& v : group["vertices"]) sum += soup.positions[v.get<Index>()];
      centres.push_back(sum / static_cast<double>(group["vertices"].size()));
    }
    const std::vector<double>& ends = handle.shape.parameter("endpoints")->values;
    const Vec3 first(ends.data()), last(&ends[3]);
    const auto worse = [&](const Vec3& a, const Vec3& b) { return std::max((first - a).norm(), (last - b).norm()); };
    EXPECT_LT(std::min(worse(centres[0], centres[1]), worse(centres[1], centres[0])),
              0.05 * cup.truth["frame"]["bbox_diagonal"].get<double>())
        << cup.mesh;
  }
}

TEST(RealMeshes, WingsOfMostAirplanes) {
  if (!fs::exists(data)) GTEST_SKIP() << data << " is not here: real meshes are not part of the project";
  int right = 0;
  for (const Marked& airplane : label_all("airplane")) {
    const double limit = 0.03 * airplane.truth["frame"]["bbox_diagonal"].get<double>();
    const FeatureReport &port = airplane.feature("pWingE"), &starboard = airplane.feature("sWingE");
    if (!port.present || !starboard.present) continue;
    const auto fitter = test::shape("line-group");
    // Both ways: marks to shape, and points along the shape to the marks.
    const auto apart = [&](const FeatureReport& report, const std::string& name) {
      const std::vector<Vec3> marks = airplane.points(name);
      double there = 0, back = 0;
      for (const Vec3& p : marks) there += fitter->distance(report.shape, p) / static_cast<double>(marks.size());
      for (const Vec3& q : report.shape.outline) {
        double least = std::numeric_limits<double>::infinity();
        for (const Vec3& p : marks) least = std::min(least, (p - q).norm());
        back += least / static_cast<double>(report.shape.outline.size());
      }
      return std::max(there, back);
    };
    // The model does not know port from starboard.
    right += std::min(std::max(apart(port, "pWingE"), apart(starboard, "sWingE")),
                      std::max(apart(port, "sWingE"), apart(starboard, "pWingE"))) <= limit;
  }
  EXPECT_GE(right, 8);
}

}  // namespace
}  // namespace toposcope
