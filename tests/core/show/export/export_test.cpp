// SPDX-License-Identifier: BSD-3-Clause
// Exports, read by readers that are not ours: the Khronos validator for glTF, VTK for VTP. Where such a reader is not
// installed its test is skipped; what can be checked without it is checked always.

#include "export/export.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <nlohmann/json.hpp>
#include <set>

#include "scene/buffer.h"
#include "support/program.h"
#include "support/schemas.h"

namespace toposcope {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// A cup and an airplane, labelled and exported; made once.
const fs::path& results() {
  static const test::TemporaryFolder folder;
  static const bool made = [] {
    for (const std::string kind : {"cup", "airplane"}) {
      const std::string mesh = (folder / (kind + ".ply")).string();
      EXPECT_EQ(test::toposcope("sample " + kind + " --faces 8000 -o " + mesh).exit_code, 0);
      EXPECT_EQ(
          test::toposcope("run " + mesh + " --model " + kind + " --no-report --out " + folder.path.string()).exit_code,
          0);
      const test::Outcome outcome = test::toposcope("export " + (folder / kind).string());
      EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    }
    return true;
  }();
  EXPECT_TRUE(made);
  return folder.path;
}

LabelledMesh labelled(const std::string& kind) {
  return read_labelled_mesh(results() / kind / "result.json");
}

/// The JSON of a .glb.
json gltf_of(const fs::path& file) {
  const std::string bytes = test::read_text(file);
  std::uint32_t length = 0;
  std::memcpy(&length, bytes.data() + 12, 4);
  return json::parse(bytes.substr(20, length));
}

TEST(Gltf, HasANodeForEachFeature) {
  for (const std::string kind : {"cup", "airplane"}) {
    const json document = gltf_of(results() / kind / "features.glb");
    const LabelledMesh mesh = labelled(kind);
    std::set<std::string> names;
    std::size_t triangles = 0;
    for (const json& node : document["nodes"]) {
      names.insert(node["name"]);
      const std::string name = node["name"];
      if (name == "unlabelled" || name.ends_with(".surface"))
        triangles +=
            document["accessors"][document["meshes"][node["mesh"].get<int>()]["primitives"][0]["indices"].get<int>()]
                    ["count"]
                        .get<std::size_t>() /
            3;
    }
    EXPECT_EQ(triangles, mesh.mesh.view().face_count());
    EXPECT_TRUE(names.contains(kind));
    for (const FoundFeature& found : mesh.found)
      for (const char* part : {"", ".surface", ".shape"}) EXPECT_TRUE(names.contains(found.feature + part)) << part;
  }
}

TEST(Gltf, PassesTheKhronosValidator) {
  const fs::path modules = fs::path(TOPOSCOPE_BUILD_DIR) / "web/node_modules";
  if (!fs::exists(modules / "gltf-validator"))
    GTEST_SKIP() << "gltf-validator is not in " << modules << ": build the report's page, whose packages it is one of";
  const test::TemporaryFolder folder;
  test::write_text(folder / "validate.js", R"(
    const validator = require('gltf-validator'), fs = require('fs');
    validator.validateBytes(new Uint8Array(fs.readFileSync(process.argv[2])))
      .then((report) => console.log(JSON.stringify(report)));)");
  const std::string node = "NODE_PATH=" + modules.string() + " node " + (folder / "validate.js").string() + " ";
  for (const std::string kind : {"cup", "airplane"}) {
    const test::Outcome outcome = test::shell(node + (results() / kind / "features.glb").string());
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const json report = json::parse(outcome.out);
    EXPECT_EQ(report["issues"]["numErrors"], 0) << report["issues"];
    EXPECT_EQ(report["issues"]["numWarnings"], 0) << report["issues"];
    EXPECT_EQ(report["info"]["totalTriangleCount"].get<std::size_t>() >= labelled(kind).mesh.view().face_count(), true);
  }
  // The validator finds faults where there are some.
  std::string broken = test::read_text(results() / "cup/features.glb");
  broken.replace(broken.find("\"VEC3\""), 6, "\"VEC2\"");
  test::write_text(folder / "broken.glb", broken);
  EXPECT_GT(json::parse(test::shell(node + (folder / "broken.glb").string()).out)["issues"]["numErrors"], 0);
}

TEST(Vtp, IsReadByVtk) {
  if (test::shell("/usr/bin/python3 -c 'import vtkmodules.vtkIOXML'").exit_code != 0)
    GTEST_SKIP() << "VTK for Python is not installed: apt-get install python3-vtk9";
  const test::TemporaryFolder folder;
  test::write_text(folder / "read.py", R"(
import json, sys
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader
reader = vtkXMLPolyDataReader()
reader.SetFileName(sys.argv[1])
reader.Update()
data = reader.GetOutput()
labels, shape, face = (data.GetCellData().GetArray(name) for name in ('label', 'shape', 'face'))
names = data.GetFieldData().GetAbstractArray('features')
counts = {}
for cell in range(data.GetNumberOfCells()):
    if shape.GetValue(cell) == 0:
        counts[int(labels.GetValue(cell))] = counts.get(int(labels.GetValue(cell)), 0) + 1
print(json.dumps({'error': reader.GetErrorCode(), 'bounds': data.GetBounds(), 'lines': data.GetNumberOfLines(),
                  'names': [names.GetValue(i) for i in range(names.GetNumberOfValues())],
                  'probability': data.GetFieldData().GetArray('probability').GetValue(1),
                  'last_face': max(int(face.GetValue(cell)) for cell in range(data.GetNumberOfCells())),
                  'counts': [counts.get(i, 0) for i in range(names.GetNumberOfValues())]})))");
  for (const std::string kind : {"cup", "airplane"}) {
    const test::Outcome outcome = test::shell("/usr/bin/python3 " + (folder / "read.py").string() + " " +
                                              (results() / kind / "features.vtp").string());
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const json read = json::parse(outcome.out);
    const LabelledMesh mesh = labelled(kind);
    EXPECT_EQ(read["error"], 0);
    std::vector<std::string> names = {"unlabelled"};
    for (const StoredFeature& feature : mesh.result.features) names.push_back(feature.name);
    EXPECT_EQ(read["names"], json(names));
    EXPECT_EQ(read["probability"], mesh.result.features[0].probability);
    EXPECT_EQ(read["last_face"], mesh.mesh.input_faces() - 1);
    std::vector<std::size_t> counts(names.size(), 0);
    for (const std::uint8_t label : mesh.labels) ++counts[label];
    EXPECT_EQ(read["counts"], json(counts));
    EXPECT_GE(read["lines"], mesh.found.size());
    double low = 1e300;
    for (const Vec3& p : mesh.mesh.view().positions) low = std::min(low, p.x());
    EXPECT_NEAR(read["bounds"][0].get<double>(), low, 0.01 * mesh.mesh.view().box.diagonal());  // shapes reach further
  }
}

/// A cup's result with the mesh moved and scaled, and what was found moved with it.
LabelledMesh moved(const Vec3& place, double size) {
  LabelledMesh cup = labelled("cup");
  TriangleSoup soup;
  const MeshView& view = cup.mesh.view();
  for (const Vec3& p : view.positions) soup.positions.push_back(place + size * p);
  soup.triangles.assign(view.triangles.begin(), view.triangles.end());
  soup.face_origin.assign(cup.mesh.face_origin().begin(), cup.mesh.face_origin().end());
  soup.input_faces = cup.mesh.input_faces();
  return {cup.result, Mesh(std::move(soup), "moved"), std::vector<std::uint8_t>(cup.labels.size(), 0), {}};
}

std::set<std::array<double, 3>> places_of(std::span<const Vec3> positions) {
  std::set<std::array<double, 3>> places;
  for (const Vec3& p : positions) places.insert({p.x(), p.y(), p.z()});
  return places;
}

TEST(Export, GltfAndVtpKeepPositionsWhereverTheMeshLies) {
  const std::pair<Vec3, double> cases[] = {
      {{500000, 5400000, 300}, 0.001}, {{0, 0, 0}, 1e39}, {{0, 0, 0}, 1e-70}, {{0, 0, 0}, 1}};
  for (const auto& [place, size] : cases) {
    SCOPED_TRACE(size);
    const LabelledMesh mesh = moved(place, size);
    const std::span<const Vec3> expected = mesh.mesh.view().positions;
    const TriangleSoup read = read_soup(to_gltf(mesh, "test"), "features.glb");
    EXPECT_EQ(places_of(read.positions).size(), places_of(expected).size());
    Vec3 low = expected[0], high = low, low_read = read.positions[0], high_read = low_read;
    for (const Vec3& p : expected) low = low.cwiseMin(p), high = high.cwiseMax(p);
    for (const Vec3& p : read.positions) low_read = low_read.cwiseMin(p), high_read = high_read.cwiseMax(p);
    const double near = 1e-6 * (high - low).norm() + 1e-9 * place.norm();
    EXPECT_LT((low - low_read).norm(), near);
    EXPECT_LT((high - high_read).norm(), near);
    EXPECT_EQ(to_gltf(mesh, "test").find("null"), std::string::npos);

    const std::string vtp = to_vtp(mesh), head = "<DataArray type=\"Float64\" Name=\"Points\"";
    const std::size_t begin = vtp.find('>', vtp.find(head)) + 1;
    ASSERT_NE(vtp.find(head), std::string::npos);
    const std::string bytes = from_base64(std::string_view(vtp).substr(begin, vtp.find('<', begin) - begin));
    ASSERT_EQ(bytes.size(), 8 + 24 * expected.size());
    EXPECT_EQ(std::memcmp(bytes.data() + 8, expected.data(), 24 * expected.size()), 0);
  }
}

TEST(SlicerMarkups, KeepToTheirSchema) {
  const fs::path schema = fs::path(TOPOSCOPE_SOURCE_DIR) / "tests/core/show/export/slicer-markups.schema.json";
  for (const std::string kind : {"cup", "airplane"}) {
    const std::string text = test::read_text(results() / kind / "features.mrk.json");
    EXPECT_EQ(test::schema_file_faults(schema, text), "");
    if (const char* published = std::getenv("TOPOSCOPE_SLICER_SCHEMA")) {
      EXPECT_EQ(test::schema_file_faults(fs::path(published), text), "");
    }
    json broken = json::parse(text);
    broken["markups"][0]["controlPoints"][0]["position"].push_back(0);
    EXPECT_NE(test::schema_file_faults(schema, broken.dump()), "");
  }
}

TEST(SlicerMarkups, LieOnTheShapes) {
  const json document = json::parse(test::read_text(results() / "cup/features.mrk.json"));
  std::map<std::string, json> markups;
  for (const json& each : document["markups"]) markups[each["name"]] = each;
  const json features = json::parse(test::read_text(results() / "cup/result.json"))["features"];
  const json& circle = features["rim"]["parameters"];
  EXPECT_EQ(markups["rim"]["type"], "ClosedCurve");
  for (const json& point : markups["rim"]["controlPoints"]) {
    double squared = 0;
    for (int k = 0; k < 3; ++k)
      squared += std::pow(point["position"][k].get<double>() - circle["center"][k].get<double>(), 2);
    EXPECT_NEAR(std::sqrt(squared), circle["radius"].get<double>(), 0.002 * circle["radius"].get<double>());
  }
  EXPECT_EQ(markups["handleCon"]["type"], "Line");
  EXPECT_EQ(markups["handleCon"]["controlPoints"][0]["position"], features["handleCon"]["parameters"]["endpoints"][0]);
  EXPECT_EQ(markups["cup"]["controlPoints"].size(), 4U);  // a name at each feature
}

TEST(Export, OneFormatOnRequestAndNoOther) {
  const fs::path folder = results() / "cup";
  for (const char* name : {"features.glb", "features.vtp", "features.mrk.json"}) fs::remove(folder / name);
  EXPECT_EQ(test::toposcope("export --format vtp,slicer " + folder.string()).exit_code, 0);
  EXPECT_FALSE(fs::exists(folder / "features.glb"));
  EXPECT_TRUE(fs::exists(folder / "features.vtp") && fs::exists(folder / "features.mrk.json"));
  EXPECT_EQ(test::toposcope("export --format ply " + folder.string()).exit_code, 2);
  EXPECT_EQ(test::toposcope("export " + folder.string()).exit_code, 0);
}

}  // namespace
}  // namespace toposcope
