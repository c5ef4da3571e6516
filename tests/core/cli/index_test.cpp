// SPDX-License-Identifier: BSD-3-Clause
// What evaluate and compare write to look at: an index that says what their other files say.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "scene/buffer.h"
#include "scene/scene.h"
#include "support/program.h"
#include "support/schemas.h"

namespace toposcope::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

const std::string page = "<script type=\"application/json\" id=\"toposcope-data\">null</script>";

class Index : public testing::Test {
 protected:
  void SetUp() override {
    fs::create_directories(folder_ / "data/web");
    write_text(folder_ / "data/web/report.html", page);
  }
  Outcome run(const std::string& arguments) const {
    return shell("cd " + folder_.path.string() + " && TOPOSCOPE_DATA_PATH=" + (folder_ / "data").string() + " " +
                 TOPOSCOPE_BUILD_DIR + "/bin/toposcope " + arguments);
  }
  json read(const std::string& name) const { return json::parse(read_text(folder_ / name)); }
  void write_dataset(const std::string& name, const std::string& rest) const {
    write_text(folder_ / (name + ".yaml"), "schema: toposcope.dataset/1\nname: " + name + "\nsummary: made\n" + rest);
  }
  TemporaryFolder folder_;
};

const json& table(const json& index, const std::string& id) {
  for (const json& each : index["tables"])
    if (each["id"] == id) return each;
  throw std::out_of_range(id);
}

std::size_t column(const json& table, const std::string& name) {
  for (std::size_t c = 0; c < table["columns"].size(); ++c)
    if (table["columns"][c]["name"] == name) return c;
  throw std::out_of_range(name);
}

TEST_F(Index, OfAnEvaluation) {
  write_dataset("cups", "model: cup\nmeshes:\n  - {kind: cup, faces: [2000, 3000]}\n");
  write_dataset("pipes", "model: pipe-fitting\njudge: class\nmeshes:\n  - {kind: [tee, elbow], faces: [3000]}\n");
  const Outcome outcome = run("evaluate cups.yaml pipes.yaml --out out --reports");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const std::string text = read_text(folder_ / "out/index.json");
  EXPECT_EQ(schema_faults("index", text), "");
  const json index = json::parse(text), evaluations = read("out/evaluation.json");
  EXPECT_NE(read_text(folder_ / "out/index.html").find("toposcope.index/1"), std::string::npos);

  ASSERT_EQ(index["meshes"].size(), 4U);
  for (const json& mesh : index["meshes"]) {
    const std::string start = "data:image/png;base64,", thumbnail = mesh["thumbnail"];
    ASSERT_EQ(thumbnail.substr(0, start.size()), start);
    EXPECT_EQ(from_base64(thumbnail.substr(start.size())).substr(1, 3), "PNG");
    const std::string report = mesh["report"];
    EXPECT_TRUE(fs::exists(folder_ / "out" / report)) << report;
    const fs::path beside = (folder_ / "out" / report).parent_path();
    EXPECT_EQ(schema_faults("result", read_text(beside / "result.json")), "") << report;
    EXPECT_EQ(schema_faults("scene", read_text(beside / "scene.json")), "") << report;
    EXPECT_FALSE(mesh["verdicts"].empty());
  }
  for (const json& each : index["tables"]) {
    for (const json& row : each["rows"]) EXPECT_EQ(row.size(), each["columns"].size()) << each["id"];
    EXPECT_TRUE(!each.contains("links") || each["links"].size() == each["rows"].size());
  }
  const json &sets = table(index, "datasets"), &meshes = table(index, "cups-meshes");
  EXPECT_EQ(sets["rows"].size(), 2U);
  EXPECT_EQ(meshes["rows"].size(), 2U);
  std::size_t right = 0;
  for (const json& row : table(index, "cups-features")["rows"])
    if (row[0] == "all") right = row[1];
  EXPECT_EQ(right, sets["rows"][0][column(sets, "features right")].get<std::size_t>());
  std::size_t counted = 0;
  for (const json& row : meshes["rows"])
    for (const char* feature : {"rim", "bottomEdge", "bottom", "handleCon"}) {
      const std::string verdict = row[column(meshes, feature)];
      counted += verdict == "right" || verdict == "absent";
    }
  EXPECT_EQ(counted, right);

  // Probabilities: eight features and two classes, in two data sets and in all.
  ASSERT_EQ(index["reliability"].size(), 3U);
  EXPECT_EQ(index["reliability"][2]["name"], "all");
  std::size_t probabilities = 0;
  for (const json& bin : index["reliability"][0]["bins"]) probabilities += bin["count"].get<std::size_t>();
  EXPECT_EQ(probabilities, 8U);
  const json& confusion = index["confusion"];
  EXPECT_EQ(confusion["classes"], json({"elbow", "tee"}));
  for (std::size_t row = 0; row < 2; ++row) {
    EXPECT_EQ(confusion["counts"][row].size(), confusion["answers"].size());
    std::size_t sum = 0;
    for (const json& count : confusion["counts"][row]) sum += count.get<std::size_t>();
    EXPECT_EQ(sum, 1U);
  }
  EXPECT_EQ(evaluations["datasets"].size(), 2U);
}

TEST_F(Index, OfAnEvaluationWithoutReports) {
  write_dataset("cups", "model: cup\nmeshes:\n  - {kind: cup, faces: [2000]}\n");
  ASSERT_EQ(run("evaluate cups.yaml --out out").exit_code, 0);
  EXPECT_TRUE(read("out/index.json")["meshes"][0]["report"].is_null());
  EXPECT_FALSE(fs::exists(folder_ / "out/cups"));
  EXPECT_EQ(run("evaluate cups.yaml --reports").exit_code, 2);  // where to?
}

TEST_F(Index, OfAComparison) {
  ASSERT_EQ(run("sample cup --faces 2000 -o a.ply").exit_code, 0);
  ASSERT_EQ(run("sample cup --faces 3000 --set handle=false -o b.ply").exit_code, 0);
  const Outcome outcome = run("compare a.ply b.ply --model cup --labelers least-error,backtracking --out out");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const std::string text = read_text(folder_ / "out/index.json");
  EXPECT_EQ(schema_faults("index", text), "");
  const json index = json::parse(text);
  EXPECT_TRUE(fs::exists(folder_ / "out/index.html"));
  EXPECT_TRUE(fs::exists(folder_ / "out/comparison.csv"));
  EXPECT_EQ(table(index, "labelers")["rows"].size(), 2U);
  EXPECT_EQ(table(index, "entries")["rows"].size(), 4U);
  ASSERT_EQ(index["views"].size(), 2U);
  for (const json& view : index["views"]) {
    EXPECT_EQ(schema_faults("scene", view["scene"].dump()), "");
    const Scene scene = read_scene(view["scene"].dump(), "view");
    EXPECT_TRUE(scene.candidates.empty() && scene.sets.empty());
    EXPECT_LE(scene.input.triangles.size(), 20000U);
  }
  EXPECT_EQ(index["views"][0]["name"], "least-error");
  EXPECT_TRUE(index["meshes"][0]["thumbnail"].get<std::string>().starts_with("data:image/png"));
}

}  // namespace
}  // namespace toposcope::test
