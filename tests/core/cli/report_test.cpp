// SPDX-License-Identifier: BSD-3-Clause
// report.html: the page with the scene in it, written by run and again by report.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "base/errors.h"
#include "scene/page.h"
#include "scene/scene.h"
#include "support/program.h"
#include "support/schemas.h"

namespace toposcope::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

const std::string begin = "<script type=\"application/json\" id=\"toposcope-data\">";

const std::string program = std::string(TOPOSCOPE_BUILD_DIR) + "/bin/toposcope";

/// The document in a page.
std::string document_of(const std::string& page) {
  const std::size_t at = page.find(begin) + begin.size();
  return page.substr(at, page.find("</script>", at) - at);
}

/// A folder with a page of its own, which the program finds first only where the build has none; and a labelled cup.
class Report : public testing::Test {
 protected:
  void SetUp() override {
    fs::create_directories(folder_ / "data/web");
    write_text(folder_ / "data/web/report.html", "<html>" + begin + "null</script></html>");
    ASSERT_EQ(run("sample cup --faces 3000 -o cup.ply").exit_code, 0);
  }
  Outcome run(const std::string& arguments) const {
    return shell("cd " + folder_.path.string() + " && TOPOSCOPE_DATA_PATH=" + (folder_ / "data").string() + " " +
                 program + " " + arguments);
  }
  std::string text(const std::string& name) const { return read_text(folder_ / name); }
  TemporaryFolder folder_;
};

TEST(Page, TakesADocumentThatCannotBreakOut) {
  const std::string page = "<p>" + begin + "null</script></p>";
  EXPECT_EQ(page_with(page, "{\"a\":\"</script><!--\"}\n", "p"),
            "<p>" + begin + "{\"a\":\"\\u003c/script>\\u003c!--\"}</script></p>");
  EXPECT_THROW(page_with("<p></p>", "{}", "p"), UsageError);
  EXPECT_THROW(page_with("<p>" + begin + "{}</script>", "{}", "p"), UsageError);
}

TEST_F(Report, HoldsTheSceneThatRunWrites) {
  ASSERT_EQ(run("run cup.ply --model cup --out out").exit_code, 0);
  EXPECT_EQ(json::parse(document_of(text("out/cup/report.html"))), json::parse(text("out/cup/scene.json")));
}

TEST_F(Report, IsLeftOutOnRequest) {
  ASSERT_EQ(run("run cup.ply --model cup --out out --no-report").exit_code, 0);
  EXPECT_FALSE(fs::exists(folder_ / "out/cup/report.html"));
  EXPECT_TRUE(fs::exists(folder_ / "out/cup/scene.json"));
}

TEST_F(Report, IsMadeAgainWithoutARun) {
  ASSERT_EQ(run("run cup.ply --model cup --out out").exit_code, 0);
  const std::string first = text("out/cup/report.html");
  fs::remove(folder_ / "out/cup/report.html");
  fs::remove(folder_ / "cup.ply");  // the scene has all that it needs
  for (const char* given : {"out/cup", "out/cup/", "out/cup/result.json"}) {
    ASSERT_EQ(run(std::string("report ") + given).exit_code, 0);
    EXPECT_EQ(text("out/cup/report.html"), first);
  }
}

TEST_F(Report, WithoutASceneShowsWhatResultAndMeshTell) {
  ASSERT_EQ(run("run cup.ply --model cup --out out").exit_code, 0);
  const Scene whole = read_scene(text("out/cup/scene.json"), "scene.json");
  fs::remove(folder_ / "out/cup/scene.json");
  ASSERT_EQ(run("report out/cup").exit_code, 0);
  const std::string document = document_of(text("out/cup/report.html"));
  EXPECT_EQ(schema_faults("scene", document), "");
  const Scene scene = read_scene(document, "report.html");
  EXPECT_EQ(scene.title, whole.title);
  EXPECT_EQ(json::parse(scene.result), json::parse(whole.result));
  EXPECT_EQ(scene.input.labels, whole.input.labels);
  EXPECT_EQ(scene.input.triangles, whole.input.triangles);
  EXPECT_EQ(scene.marks.size(), whole.marks.size());
  ASSERT_EQ(scene.found.size(), whole.found.size());
  EXPECT_EQ(scene.found[0].drawing.lines, whole.found[0].drawing.lines);
  EXPECT_TRUE(scene.candidates.empty());

  fs::rename(folder_ / "cup.ply", folder_ / "moved.ply");
  const Outcome lost = run("report out/cup");
  EXPECT_EQ(lost.exit_code, 3);
  EXPECT_NE(lost.err.find("--mesh"), std::string::npos) << lost.err;
  EXPECT_EQ(run("report out/cup --mesh moved.ply").exit_code, 0);
}

/// Of as many vertices and faces, but another: a noise that is hardly seen.
TEST_F(Report, AMeshThatWasChangedIsRefused) {
  ASSERT_EQ(run("run cup.ply --model cup --out out --no-report").exit_code, 0);
  ASSERT_EQ(run("sample cup --faces 3000 --noise 1e-7 -o other.ply").exit_code, 0);
  ASSERT_EQ(run("prepare cup.ply -q -o copy.obj").exit_code, 0);
  for (const char* command : {"report", "render --size 64x48"}) {  // also where the scene has all that it needs
    const Outcome other = run(std::string(command) + " out/cup --mesh other.ply");
    EXPECT_EQ(other.exit_code, 3) << command;
    EXPECT_NE(other.err.find("other.ply: is not the mesh"), std::string::npos) << other.err;
  }
  EXPECT_EQ(run("export out/cup --mesh other.ply").exit_code, 3);
  EXPECT_EQ(run("report out/cup --mesh copy.obj").exit_code, 0) << "the same in another format";
  fs::rename(folder_ / "other.ply", folder_ / "cup.ply");
  EXPECT_EQ(run("export out/cup").exit_code, 3);
}

TEST_F(Report, ASceneOfAnotherRunIsRefused) {
  ASSERT_EQ(run("run cup.ply --model cup --out a --no-report").exit_code, 0);
  ASSERT_EQ(run("run cup.ply --model neal-1999/cup --pipeline neal-1999 --out b --no-report").exit_code, 0);
  fs::copy_file(folder_ / "b/cup/scene.json", folder_ / "a/cup/scene.json", fs::copy_options::overwrite_existing);
  for (const char* command : {"report", "render --size 64x48"}) {
    const Outcome mixed = run(std::string(command) + " a/cup");
    EXPECT_EQ(mixed.exit_code, 2) << command;
    EXPECT_NE(mixed.err.find("scene.json: is of another run than a/cup/result.json"), std::string::npos) << mixed.err;
  }
  EXPECT_FALSE(fs::exists(folder_ / "a/cup/report.html"));
  EXPECT_EQ(run("report b/cup").exit_code, 0);
}

TEST_F(Report, ASceneThatCannotBeReadIsNotPassedOver) {
  ASSERT_EQ(run("run cup.ply --model cup --out out --no-report").exit_code, 0);
  fs::remove(folder_ / "out/cup/scene.json");
  fs::create_symlink("gone.json", folder_ / "out/cup/scene.json");
  const Outcome outcome = run("report out/cup");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.err.find("scene.json' cannot be read"), std::string::npos) << outcome.err;
}

TEST_F(Report, SaysWhereThereIsNoResult) {
  const Outcome outcome = run("report nowhere cup.ply");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.err.find("nowhere: no result.json"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("cup.ply: no result.json"), std::string::npos) << outcome.err;
  EXPECT_EQ(run("report").exit_code, 2);
}

/// A copy of the program that has no page beside it.
TEST_F(Report, WithoutThePageAllElseIsWritten) {
  fs::create_directories(folder_ / "alone/bin");
  fs::copy_file(program, folder_ / "alone/bin/toposcope");
  for (const char* kind : {"models", "pipelines", "plugins"})
    fs::create_directory_symlink(fs::path(TOPOSCOPE_BUILD_DIR) / kind, folder_ / "alone" / kind);
  const std::string alone = "cd " + folder_.path.string() + " && alone/bin/toposcope ";
  const Outcome outcome = shell(alone + "run cup.ply --model cup --out out");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("no report.html is written"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("TOPOSCOPE_DATA_PATH"), std::string::npos);
  EXPECT_TRUE(fs::exists(folder_ / "out/cup/scene.json"));
  EXPECT_FALSE(fs::exists(folder_ / "out/cup/report.html"));
  EXPECT_EQ(shell(alone + "run cup.ply --model cup --out out --no-report").err, "");
  EXPECT_EQ(shell(alone + "report out/cup").exit_code, 2);
}

}  // namespace
}  // namespace toposcope::test
