// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>
#include <regex>

#include "support/program.h"

namespace toposcope::test {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

/// Corners of a cube moved by (x, y, 0), and its 12 faces, from vertex `base` on.
std::string cube_corners(int x, int y) {
  std::string text;
  for (int i = 0; i < 8; ++i)
    text += "v " + std::to_string(x + (i & 1)) + " " + std::to_string(y + (i >> 1 & 1)) + " " +
            std::to_string(i >> 2 & 1) + "\n";
  return text;
}

std::string cube_faces(int base, bool first_turned = false) {
  static constexpr int faces[12][3] = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                                       {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  std::string text;
  for (int f = 0; f < 12; ++f) {
    int b = faces[f][1], c = faces[f][2];
    if (f == 0 && first_turned) std::swap(b, c);
    text += "f " + std::to_string(base + faces[f][0] + 1) + " " + std::to_string(base + b + 1) + " " +
            std::to_string(base + c + 1) + "\n";
  }
  return text;
}

class Prepare : public ::testing::Test {
 protected:
  std::string put(const std::string& name, const std::string& text) {
    write_text(folder / name, text);
    return (folder / name).string();
  }
  static json report(const std::string& arguments) {
    const Outcome outcome = toposcope("prepare --json " + arguments);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return outcome.exit_code == 0 ? json::parse(outcome.out) : json();
  }
  /// The last property of each face of a binary PLY that prepare or run wrote. \param row  bytes of a face
  static std::vector<std::int32_t> input_faces(const std::filesystem::path& ply, std::size_t faces, std::size_t row) {
    const std::string bytes = read_text(ply);
    EXPECT_THAT(bytes, HasSubstr("property int input_face\nend_header"));
    std::vector<std::int32_t> values(faces);
    for (std::size_t f = 0; f < faces; ++f)
      std::memcpy(&values[f], bytes.data() + bytes.size() - (faces - f - 1) * row - 4, 4);
    return values;
  }
  const TemporaryFolder folder;
};

TEST_F(Prepare, LeavesACleanMeshAlone) {
  const json found = report(put("cube.obj", cube_corners(0, 0) + cube_faces(0)));
  for (const auto& [name, count] : found["repair"].items()) EXPECT_EQ(count, 0) << name;
  EXPECT_EQ(found["repaired"]["vertices"], 8);
  EXPECT_EQ(found["repaired"]["euler"], 2);
  EXPECT_EQ(found["repaired"]["closed"], true);
  EXPECT_NEAR(found["repaired"]["mean_edge"], (12 + 6 * std::sqrt(2.0)) / 18, 1e-12);
  EXPECT_TRUE(found["prepared"].is_null());
  EXPECT_TRUE(found["written"].is_null());
}

TEST_F(Prepare, TakesTwoCubesAtOneEdgeApart) {
  // The second cube's edge is the first one's: by its numbers, not only by its place.
  const std::string second =
      std::regex_replace(std::regex_replace(cube_faces(8), std::regex(" 9\\b"), " 4"), std::regex(" 13\\b"), " 8");
  const std::string cubes = put("cubes.obj", cube_corners(0, 0) + cube_corners(1, 1) + cube_faces(0) + second);
  const json found = report(cubes);
  EXPECT_EQ(found["repair"]["split_edges"], 1);
  EXPECT_EQ(found["repaired"]["components"], 2);
  EXPECT_EQ(found["repaired"]["closed_components"], 2);
  EXPECT_EQ(found["repaired"]["euler"], 4);
  const Outcome run = toposcope("run " + cubes + " --model cup");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.err, HasSubstr("edges split"));
  EXPECT_THAT(run.out, HasSubstr("repaired: "));
  EXPECT_EQ(toposcope("run " + cubes + " --model cup -q").err, "");
}

TEST_F(Prepare, TurnsAndMergesAndDrops) {
  const std::string corners = cube_corners(0, 0);
  EXPECT_EQ(report(put("turned.obj", corners + cube_faces(0, true)))["repair"]["turned_faces"], 1);
  // The second corners lie where the first do; one face of twelve uses them.
  const json merged = report(put("merged.obj", corners + corners + cube_faces(0) + "f 9 11 12\n"));
  EXPECT_EQ(merged["repair"]["duplicate_faces"], 1);
  EXPECT_EQ(merged["repaired"]["vertices"], 8);
  const Outcome lost = toposcope("prepare " + put("nan.obj", corners + "v nan 0 0\n" + cube_faces(0) + "f 1 2 9\n"));
  EXPECT_EQ(lost.exit_code, 3) << "refused by the reader";
  EXPECT_THAT(lost.err, HasSubstr("nan.obj:9: vertex 8"));
}

/// Duplicate and degenerate faces before good ones: faces keep the number that they have in the file.
TEST_F(Prepare, SpeaksOfTheFacesOfTheFile) {
  const std::string rubbish = "f 1 1 2\nf 1 3 4\nf 2 3 2\n";  // 1 3 4 is the first face of the cube
  const std::string mesh = put("bad.obj", cube_corners(0, 0) + rubbish + cube_faces(0));
  ASSERT_EQ(toposcope("prepare -q " + mesh + " -o " + (folder / "good.ply").string()).exit_code, 0);
  const std::vector<std::int32_t> expected = {1, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14};
  EXPECT_EQ(input_faces(folder / "good.ply", 12, 17), expected);
  ASSERT_EQ(toposcope("run -q " + mesh + " --model cup --out " + folder.path.string()).exit_code, 0);
  EXPECT_EQ(input_faces(folder / "bad/labels.ply", 12, 24), expected);
}

/// Faces put in front that the repair drops move every number by as many.
TEST_F(Prepare, ResultsSpeakOfTheFacesOfTheFile) {
  const std::filesystem::path cup = folder / "cup.obj";
  ASSERT_EQ(toposcope("sample cup --faces 5000 -o " + cup.string()).exit_code, 0);
  std::string text = read_text(cup);
  text.insert(text.find("f "), "f 1 1 2\nf 3 3 3\n");
  const std::string padded = put("padded.obj", text);
  const json before = json::parse(toposcope("run --json --model cup " + cup.string()).out);
  const json after = json::parse(toposcope("run --json --model cup " + padded).out);
  EXPECT_EQ(after["mesh"]["repair"]["degenerate_faces"], 2);
  for (const auto& [name, feature] : before["features"].items()) {
    std::vector<int> faces = feature["faces"];
    ASSERT_FALSE(faces.empty());
    for (int& f : faces) f += 2;
    EXPECT_EQ(after["features"][name]["faces"], json(faces)) << name;
  }
}

TEST_F(Prepare, ChangesTheResolution) {
  const std::string cube = put("cube.obj", cube_corners(0, 0) + cube_faces(0));
  const json faces = report(cube + " --faces 2000");
  EXPECT_NEAR(faces["prepared"]["faces"], 2000, 200);
  EXPECT_LT(faces["prepared"]["edge_variation"], 0.25);
  EXPECT_EQ(faces["prepared"]["euler"], 2);
  EXPECT_NEAR(report(cube + " --edge 0.1")["prepared"]["mean_edge"], 0.1, 0.02) << "in the mesh's own unit";
  const std::string out = (folder / "out.ply").string();
  const json both = report(cube + " --smooth 3 --faces 500 --set filters.taubin.lambda=0.5 -o " + out);
  EXPECT_EQ(both["filters"][0]["id"], "taubin");
  EXPECT_EQ(both["filters"][0]["options"]["passes"], "3");
  EXPECT_EQ(both["filters"][0]["options"]["lambda"], "0.5");
  EXPECT_EQ(both["filters"][1]["id"], "normalise");
  const std::size_t count = both["prepared"]["faces"];
  for (std::int32_t f : input_faces(out, count, 17)) EXPECT_TRUE(f >= 0 && f < 12) << f;
  EXPECT_EQ(report("--smooth " + cube)["filters"][0]["options"]["passes"], "10") << "a mesh is no number of passes";
}

TEST_F(Prepare, DoesTheOthersWhenOneCannotBeUsed) {
  const std::string good = put("good.obj", cube_corners(0, 0) + cube_faces(0));
  const std::string bad = put("bad.obj", "v 0 0 0\n");
  const Outcome outcome = toposcope("prepare " + bad + " " + good + " -o " + (folder / "out").string());
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_THAT(outcome.err, HasSubstr("bad.obj"));
  EXPECT_THAT(outcome.out, HasSubstr("good.ply"));
  EXPECT_TRUE(std::filesystem::exists(folder / "out/good.ply"));
  EXPECT_FALSE(std::filesystem::exists(folder / "out/bad.ply"));
}

TEST_F(Prepare, WritesOverAnInputOnlyWhenItIsNamed) {
  const std::string a = (folder / "a.ply").string(), b = (folder / "b.ply").string();
  const std::string cube = put("cube.obj", cube_corners(0, 0) + cube_faces(0));
  ASSERT_EQ(toposcope("prepare -q " + cube + " -o " + a).exit_code, 0);
  ASSERT_EQ(toposcope("prepare -q " + cube + " -o " + b).exit_code, 0);
  const std::string before = read_text(a);
  for (const std::string& meshes : {a + " " + b, a}) {
    const Outcome refused = toposcope("prepare --faces 100 " + meshes + " -o " + folder.path.string());
    EXPECT_EQ(refused.exit_code, 2) << refused.out;
    EXPECT_THAT(refused.err, HasSubstr("write over"));
    EXPECT_EQ(read_text(a), before);
  }
  EXPECT_EQ(toposcope("prepare -q --faces 100 " + a + " -o " + a).exit_code, 0);
  EXPECT_NE(read_text(a), before);
}

TEST_F(Prepare, BadUsageIsExplained) {
  const std::string cube = put("cube.obj", cube_corners(0, 0) + cube_faces(0));
  const std::pair<std::string, const char*> bad[] = {
      {"", "mesh"},
      {cube + " --faces 10 --edge 1", "excludes"},
      {cube + " --faces 0", "1"},
      {cube + " --faces many", "faces"},
      {cube + " --edge -1", "above 0"},
      {cube + " --edge nan", "above 0"},
      {cube + " --edge 50", "1.732"},
      {cube + " --decimate 2.5", "decimate"},
      {cube + " --smooth -3", "passes"},
      {cube + " --set filters.taubin.passes=3", "--smooth"},
      {cube + " --smooth --set taubin=3", "filters.ID"},
      {cube + " -o cube.xyz", ".ply"},
      {cube + " " + cube + " -o out", "named 'cube'"},
  };
  for (const auto& [arguments, remedy] : bad) {
    const Outcome outcome = toposcope("prepare " + arguments);
    EXPECT_EQ(outcome.exit_code, 2) << arguments << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr(remedy)) << arguments;
  }
}

TEST_F(Prepare, NeedsFiltersOnlyForWhatTheyDo) {
  const std::string cube = put("cube.obj", cube_corners(0, 0) + cube_faces(0));
  std::filesystem::create_directories(folder / "bin");
  std::filesystem::copy_file(TOPOSCOPE_BUILD_DIR "/bin/toposcope", folder / "bin/toposcope");
  const std::string program = (folder / "bin/toposcope").string() + " prepare " + cube;
  EXPECT_EQ(shell(program).exit_code, 0);
  for (const auto& [flag, id] :
       {std::pair{"--smooth", "taubin"}, {"--decimate 4", "decimate"}, {"--edge 1", "normalise"}}) {
    const Outcome outcome = shell(program + " " + flag);
    EXPECT_EQ(outcome.exit_code, 4) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr(id));
    EXPECT_THAT(outcome.err, HasSubstr("--plugin-dir"));
  }
}

}  // namespace
}  // namespace toposcope::test
