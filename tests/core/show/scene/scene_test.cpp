// SPDX-License-Identifier: BSD-3-Clause
// The scene of a run: keeps to its schema, and says of mesh, labels, candidates and marks what the other files say.

#include "scene/scene.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>

#include "base/errors.h"
#include "io/mesh_io.h"
#include "scene/buffer.h"
#include "scene/local_frame.h"
#include "support/program.h"
#include "support/schemas.h"

namespace toposcope {
namespace {

using nlohmann::json;

/// A run of the program on a sampled object.
struct SceneOfRun {
  test::TemporaryFolder folder;
  std::string text;
  json result;
  Scene scene;
  SceneOfRun(const std::string& sample, const std::string& model) {
    const std::string mesh = (folder / "object.ply").string();
    EXPECT_EQ(test::toposcope("sample " + sample + " -o " + mesh).exit_code, 0);
    const test::Outcome outcome =
        test::toposcope("run " + mesh + " --model " + model + " --out " + folder.path.string());
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    text = test::read_text(folder / "object/scene.json");
    result = json::parse(test::read_text(folder / "object/result.json"));
    scene = read_scene(text, "scene.json");
  }
};

TEST(Scene, OfACupKeepsToItsSchemaAndAgreesWithTheResult) {
  const SceneOfRun cup("cup --faces 8000", "cup");
  EXPECT_EQ(test::schema_faults("scene", cup.text), "");
  const json document = json::parse(cup.text);
  EXPECT_EQ(document["result"], cup.result);
  EXPECT_EQ(document["title"], "object.ply · cup");
  EXPECT_EQ(document["model"]["features"].size(), 4U);

  const Mesh mesh = read_mesh(cup.folder / "object.ply");
  const MeshView& view = mesh.view();
  ASSERT_EQ(cup.scene.input.triangles.size(), view.face_count());
  for (Index t = 0; t < view.face_count(); ++t) EXPECT_EQ(cup.scene.input.triangles[t], view.triangles[t]);
  for (Index v = 0; v < view.vertex_count(); ++v)
    EXPECT_LT((cup.scene.input.positions[v] - view.positions[v]).norm(), 2e-5 * view.box.diagonal());

  // A triangle carries the label of the feature whose faces the result lists.
  for (std::size_t f = 0; f < cup.scene.features.size(); ++f) {
    std::vector<Index> faces;
    for (Index t = 0; t < view.face_count(); ++t)
      if (cup.scene.input.labels[t] == f + 1) faces.push_back(cup.scene.input_faces[t]);
    EXPECT_EQ(json(faces), cup.result["features"][cup.scene.features[f]]["faces"]) << cup.scene.features[f];
    EXPECT_FALSE(faces.empty());
  }
}

TEST(Scene, CandidatesAreThoseThatTheResultCountsAndNames) {
  const SceneOfRun cup("cup --faces 8000", "cup");
  for (const std::string& feature : cup.scene.features) {
    std::set<Index> ranks;
    for (const ShownCandidate& each : cup.scene.candidates)
      if (each.feature == feature) {
        ranks.insert(each.rank);
        EXPECT_FALSE(each.drawing.empty()) << feature << " " << each.rank;
        EXPECT_FALSE(each.working_sets.empty());
      }
    EXPECT_GE(ranks.size(), std::min<std::size_t>(40, cup.result["candidates"][feature]["kept"])) << feature;
    for (const json& alternative : cup.result["alternatives"]) {
      const Index named = alternative["candidates"][feature];
      EXPECT_TRUE(named == 0 || ranks.contains(named)) << feature << " " << named;
    }
  }
  for (const FoundFeature& found : cup.scene.found) {
    const json& expected = cup.result["features"][found.feature];
    for (const ShownCandidate& each : cup.scene.candidates)
      if (each.feature == found.feature && each.rank == found.rank) {
        EXPECT_EQ(each.fit_error, expected["fit_error"].get<double>());
        std::size_t vertices = 0;
        for (const Index set : each.working_sets) vertices += cup.scene.sets[set].size;
        EXPECT_GT(vertices, 0U);
      }
    EXPECT_FALSE(found.drawing.empty());
  }
  EXPECT_EQ(cup.scene.found.size(), 4U);
}

TEST(Scene, MarksAreThoseOfTheTruth) {
  const SceneOfRun cup("cup --faces 3000", "cup");
  const Truth truth = read_truth(cup.folder / "object.truth.json");
  ASSERT_TRUE(cup.scene.has_truth);
  ASSERT_EQ(cup.scene.marks.size(), truth.features.size());
  for (std::size_t f = 0; f < truth.features.size(); ++f) {
    EXPECT_EQ(cup.scene.marks[f].first, truth.features[f].name);
    EXPECT_EQ(cup.scene.marks[f].second.size(), truth.features[f].points.size());
  }
  EXPECT_EQ(json::parse(cup.text)["truth"]["class"], "cup");
}

TEST(Scene, WritesAgainWhatItReads) {
  const SceneOfRun tee("tee --faces 3000", "pipe-fitting");
  EXPECT_EQ(test::schema_faults("scene", tee.text), "");
  const std::string program = json::parse(tee.text)["program"];
  EXPECT_EQ(to_json(tee.scene, program), tee.text);
}

TEST(Scene, OfAFilteredMeshHasItsWorkingSetsOnTheFilteredMesh) {
  const test::TemporaryFolder folder;
  const std::string tee = (folder / "tee.ply").string(), raw = (folder / "raw.ply").string();
  ASSERT_EQ(test::toposcope("sample tee --faces 10000 -o " + tee).exit_code, 0);
  ASSERT_EQ(test::toposcope("prepare " + tee + " --decimate 1500 -o " + raw).exit_code, 0);
  ASSERT_EQ(test::toposcope("run " + raw + " --model pipe-fitting --out " + folder.path.string()).exit_code, 0);
  const std::string text = test::read_text(folder / "raw/scene.json");
  EXPECT_EQ(test::schema_faults("scene", text), "");
  const Scene scene = read_scene(text, "scene.json");
  ASSERT_TRUE(scene.normalised);
  EXPECT_GT(scene.normalised->positions.size(), scene.input.positions.size());
  Index greatest = 0;
  for (const ShownWorkingSet& set : scene.all_sets)
    for (const Index v : set.vertices) greatest = std::max(greatest, v);
  EXPECT_GE(greatest, scene.input.positions.size());
  EXPECT_FALSE(scene.has_truth);
}

TEST(Scene, KeepsDistinctPointsFarFromTheOrigin) {
  SceneOfRun cup("cup --faces 2000", "cup");
  for (const LocalFrame& frame : {LocalFrame{{500000, 5400000, 300}, 0.001}, LocalFrame{Vec3::Zero(), 1e39}}) {
    const Scene there = in_world(cup.scene, frame);
    const std::string text = to_json(there, "test");
    EXPECT_EQ(test::schema_faults("scene", text), "");
    const Scene read = read_scene(text, "scene.json");
    const double near = 1e-5 * 200 * frame.scale + 1e-9 * frame.origin.norm();
    for (std::size_t v = 0; v < there.input.positions.size(); ++v)
      EXPECT_LT((read.input.positions[v] - there.input.positions[v]).norm(), near);
    const auto &line = there.found[0].drawing.lines[0], &again = read.found[0].drawing.lines[0];
    ASSERT_EQ(line.size(), again.size());
    for (std::size_t i = 0; i < line.size(); ++i) EXPECT_LT((line[i] - again[i]).norm(), near);
  }
}

TEST(Scene, RefusesPointsOutOfReach) {
  SceneJson buffer = point_buffer(std::vector<Vec3>{{1, 2, 3}, {0, std::numeric_limits<double>::infinity(), 0}});
  EXPECT_THROW(read_points(buffer), std::invalid_argument);
  buffer = quantised_buffer(std::vector<Vec3>{{0, 0, 0}, {1, 1, 1}});
  buffer["min"][0] = 1e200;
  EXPECT_THROW(read_points(buffer), std::invalid_argument);
}

TEST(Scene, RefusesWhatIsNone) {
  EXPECT_THROW(read_scene("{", "x.json"), UsageError);
  EXPECT_THROW(read_scene("{\"schema\": \"toposcope.result/1\"}", "x.json"), UsageError);
  const SceneOfRun tee("tee --faces 3000", "pipe-fitting");
  json broken = json::parse(tee.text);
  broken["surfaces"]["input"]["mesh_triangles"] = "many";
  EXPECT_THROW(read_scene(broken.dump(), "x.json"), UsageError);
  broken = json::parse(tee.text);
  broken["all_working_sets"][0]["vertices"] = {{"type", "u16"}, {"count", 1}, {"data", "//8="}};  // vertex 65535
  EXPECT_THROW(read_scene(broken.dump(), "x.json"), UsageError);
  broken = json::parse(tee.text);
  broken.erase("found");
  EXPECT_NE(test::schema_faults("scene", broken.dump()), "");
  broken = json::parse(tee.text);
  broken["result"]["status"] = "perhaps";
  EXPECT_NE(test::schema_faults("scene", broken.dump()), "");
  broken = json::parse(tee.text);
  broken["working_sets"][0].erase("saliency");
  EXPECT_NE(test::schema_faults("scene", broken.dump()), "");
  EXPECT_THROW(read_scene(broken.dump(), "x.json"), UsageError);
}

}  // namespace
}  // namespace toposcope
