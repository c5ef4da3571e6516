// SPDX-License-Identifier: BSD-3-Clause
#include "support/program.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace toposcope::test {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
namespace fs = std::filesystem;

/// A generated cup and tee, made once.
class Program : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new TemporaryFolder;
    ASSERT_EQ(toposcope("sample cup --faces 6000 -o " + mesh("cup")).exit_code, 0);
    ASSERT_EQ(toposcope("sample tee --faces 6000 -o " + mesh("tee")).exit_code, 0);
  }
  static void TearDownTestSuite() { delete folder_; }
  static std::string mesh(const std::string& name) { return (*folder_ / (name + ".ply")).string(); }

 private:
  static TemporaryFolder* folder_;
};
TemporaryFolder* Program::folder_ = nullptr;

json result_of(const fs::path& file, bool timings = false) {
  json result = json::parse(read_text(file));
  if (!timings) result.erase("timings_ms");
  return result;
}

TEST_F(Program, LabelsACupAndSaysWhereTheMeshLies) {
  const TemporaryFolder out;
  const Outcome outcome = toposcope("run " + mesh("cup") + " --model cup --no-report --out " + out.path.string());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  for (const char* word : {"rim", "bottomEdge", "bottom", "handleCon", "concentric", "residual", "labels.ply"})
    EXPECT_THAT(outcome.out, HasSubstr(word));
  EXPECT_EQ(outcome.err, "") << "quiet in a pipe";
  const json result = result_of(out / "cup/result.json", true);
  EXPECT_EQ(result["status"], "labelled");
  for (const auto& [name, feature] : result["features"].items()) {
    EXPECT_TRUE(feature["present"]) << name;
    EXPECT_FALSE(feature["faces"].empty()) << name;
  }
  for (const char* station : {"read", "filter", "classify", "fit", "relate", "label"})
    EXPECT_TRUE(result["timings_ms"].contains(station)) << station;
  EXPECT_TRUE(fs::exists(out / "cup/labels.ply"));
}

TEST_F(Program, FindsTheFeaturesWhereTheTruthHasThem) {
  const TemporaryFolder out;
  ASSERT_EQ(toposcope("run " + mesh("cup") + " --model cup -q --out " + out.path.string()).exit_code, 0);
  const json result = result_of(out / "cup/result.json");
  const json truth = json::parse(read_text(fs::path(mesh("cup")).replace_extension(".truth.json")));
  const double edge = result["mesh"]["mean_edge"];
  for (const char* name : {"rim", "bottomEdge"}) {
    const json& circle = result["features"][name]["parameters"];
    double sum = 0;
    for (const json& p : truth["features"][name]["points"]) {
      double height = 0, squared = 0;
      for (int k = 0; k < 3; ++k) {
        const double d = p[k].get<double>() - circle["center"][k].get<double>();
        height += d * circle["normal"][k].get<double>();
        squared += d * d;
      }
      const double across = std::sqrt(std::max(0.0, squared - height * height)) - circle["radius"].get<double>();
      sum += std::hypot(height, across);
    }
    EXPECT_LT(sum / static_cast<double>(truth["features"][name]["points"].size()), edge) << name;
  }
}

TEST_F(Program, IsTheSameOnEveryRunAndAtAnyThreadCount) {
  const TemporaryFolder out;
  const auto run = [&](const std::string& threads) {
    const Outcome outcome =
        toposcope("run " + mesh("cup") + " --model cup -q --threads " + threads + " --out " + out.path.string());
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return result_of(out / "cup/result.json").dump();
  };
  const std::string first = run("1");
  EXPECT_EQ(run("1"), first);
  EXPECT_EQ(run("2"), first);
  EXPECT_EQ(run("5"), first);
}

TEST_F(Program, ClassifiesATee) {
  const Outcome outcome = toposcope("classify " + mesh("tee") + " --models pipe-fitting --json");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const json answer = json::parse(outcome.out);
  EXPECT_EQ(answer["class"], "tee");
  EXPECT_GT(answer["probabilities"]["tee"].get<double>(), 0.5);
  for (const json& relation : answer["relations"]) EXPECT_TRUE(relation["satisfied"]) << relation.dump();
  EXPECT_THAT(toposcope("classify " + mesh("tee") + " --models pipe-fitting").out, HasSubstr("=> tee"));
}

TEST_F(Program, TellsCupsFromTees) {
  const Outcome outcome =
      toposcope("classify " + mesh("cup") + " " + mesh("tee") + " --models cup,pipe-fitting --json");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const std::size_t line = outcome.out.find('\n');
  EXPECT_EQ(json::parse(outcome.out.substr(0, line))["class"], "cup");
  EXPECT_EQ(json::parse(outcome.out.substr(line + 1))["class"], "tee");
}

TEST_F(Program, AModelNamesItsPipelineAndTheCommandLineWins) {
  const TemporaryFolder folder;
  const std::string model = (folder / "own.yaml").string();
  const auto write_model = [&](const std::string& pipeline) {
    write_text(model, "schema: toposcope.model/1\nname: own\npipeline: " + pipeline +
                          "\nfeatures:\n  rim: {worksets: [convex], shape: circle}\n");
  };
  const auto classifiers = [&](const std::string& arguments) {
    const Outcome outcome = toposcope("run " + mesh("cup") + " --model " + model + " --json " + arguments);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    std::string ids;
    const json result = outcome.exit_code == 0 ? json::parse(outcome.out) : json{{"plugins", json::array()}};
    for (const json& plugin : result["plugins"])
      if (plugin["kind"] == "worksets") ids += plugin["id"].get<std::string>() + " ";
    return ids;
  };
  write_model("neal-1999");
  EXPECT_EQ(classifiers(""), "curvature ");
  EXPECT_EQ(classifiers("--pipeline default"), "curvature-tree ");
  EXPECT_EQ(toposcope("model check " + model).exit_code, 0);
  // A file stands beside the model, wherever the program is started.
  write_model("both.yaml");
  write_text(folder / "both.yaml",
             "schema: toposcope.pipeline/1\nname: both\nworksets: [{plugin: curvature-tree}, {plugin: curvature}]\n"
             "labeler: {plugin: least-error}\n");
  EXPECT_EQ(classifiers(""), "curvature-tree curvature ");
  EXPECT_EQ(classifiers("--set worksets.curvature.high_threshold=10"), "curvature-tree curvature ");
  // Three models and two pipelines: the mesh is classified twice.
  const Outcome classified =
      toposcope("classify " + mesh("cup") + " --models cup,pipe-fitting," + model + " --json -v");
  EXPECT_EQ(classified.exit_code, 0) << classified.err;
  EXPECT_EQ(json::parse(classified.out)["class"], "cup");
  EXPECT_THAT(classified.err, AllOf(HasSubstr("pipeline 'default': "), HasSubstr(" working sets for 2 models"),
                                    HasSubstr("pipeline 'both': "), HasSubstr(" working sets for 1 models")));
  write_model("neal-1998");
  for (const std::string& command : {"model check " + model, "run " + mesh("cup") + " --model " + model}) {
    const Outcome outcome = toposcope(command);
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_THAT(outcome.err, AllOf(HasSubstr(model + ":3:11: "), HasSubstr("'neal-1998'"), HasSubstr("'neal-1999'?")));
  }
}

TEST_F(Program, RunsTheDissertationsPipelineAndModel) {
  const Outcome outcome = toposcope("run " + mesh("cup") + " --model neal-1999/cup --pipeline neal-1999 --json");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const json result = json::parse(outcome.out);
  EXPECT_TRUE(result["features"]["rim"]["present"]);
  EXPECT_EQ(result["plugins"][0]["id"], "curvature");
}

// ---- bad input: one clear message, the right exit code, nothing half-written ----

TEST_F(Program, BadMeshesAreRefusedAndTheOthersStillDone) {
  const TemporaryFolder in, out;
  const std::pair<const char*, const char*> bad[] = {
      {"empty.ply", ""},
      {"truncated.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n"},
      {"nan.off", "OFF\n3 1 0\n0 0 nan\n1 0 0\n0 1 0\n3 0 1 2\n"},
      {"index.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 7\n"},
      {"faceless.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n"},
      {"format.xyz", "0 0 0\n"},
  };
  for (const auto& [name, text] : bad) {
    write_text(in / name, text);
    const Outcome outcome =
        toposcope("run " + (in / name).string() + " --model cup --no-report --out " + out.path.string());
    EXPECT_EQ(outcome.exit_code, 3) << name << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr(name));
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_FALSE(fs::exists(out / fs::path(name).stem().string())) << name;
  }
  const Outcome both = toposcope("run " + (in / "nan.off").string() + " " + mesh("cup") +
                                 " absent.ply --model cup -q --out " + out.path.string());
  EXPECT_EQ(both.exit_code, 3);
  EXPECT_THAT(both.err, HasSubstr("nan.off"));
  EXPECT_THAT(both.err, HasSubstr("absent.ply"));
  EXPECT_TRUE(fs::exists(out / "cup/result.json"));
}

TEST_F(Program, BadUsageIsExplained) {
  const std::pair<std::string, const char*> bad[] = {
      {"frobnicate", "command 'frobnicate'"},
      {"run " + mesh("cup"), "--model"},
      {"run " + mesh("cup") + " --model cpu", "cup"},
      {"run " + mesh("cup") + " --model cup --pipeline defautl", "default"},
      {"run " + mesh("cup") + " --model cup --labeler least-eror", "least-error"},
      {"run " + mesh("cup") + " --model cup --set worksets.growht=2", "growth"},
      {"run " + mesh("cup") + " --model cup --set worksets.growth=99", "4"},
      {"run " + mesh("cup") + " --model cup --set nonsense", "station.option=value"},
      {"plugins describe circl", "circle"},
      {"sample cup --preset teacpu -o x.ply", "teacup"},
      {"sample cup --preset mug --random -o x.ply", "exclude"},
      {"sample cup --set handle_shape=dee -o x.ply", "ear"},
      {"sample cupp -o x.ply", "cup"},
      {"run --threads 5000 --model cup " + mesh("cup"), "threads"},
  };
  for (const auto& [arguments, remedy] : bad) {
    const Outcome outcome = toposcope(arguments);
    EXPECT_EQ(outcome.exit_code, 2) << arguments;
    EXPECT_THAT(outcome.err, HasSubstr(remedy)) << arguments;
    EXPECT_EQ(outcome.out, "") << arguments;
  }
}

TEST_F(Program, BadModelsNameThePlace) {
  const TemporaryFolder in;
  const std::string head = "schema: toposcope.model/1\nname: bad\n";
  const std::string feature = "features:\n  rim:\n    worksets: [convex]\n    shape: circle\n    detectability: 1\n";
  const std::pair<std::string, const char*> bad[] = {
      {head + "features:\n  rim:\n    worksets: [convex]\n    shape: cirle\n    detectability: 1\n", "bad.yaml:6:12"},
      {head + feature + "    ranges:\n      radius: 0 < r < bb(O).a*bb(O).b\n", "bad.yaml:9:"},
      {head + "objects: {a: volume, b: volume}\nparts: {a: [b], b: [a]}\n" + feature, "cycle"},
  };
  for (const auto& [text, place] : bad) {
    write_text(in / "bad.yaml", text);
    for (const std::string& command :
         {"model check " + (in / "bad.yaml").string(), "run absent.ply --model " + (in / "bad.yaml").string()}) {
      const Outcome outcome = toposcope(command);
      EXPECT_EQ(outcome.exit_code, 2) << command;
      EXPECT_THAT(outcome.err, HasSubstr(place));
    }
  }
}

TEST_F(Program, ShowsModelsAndPlugins) {
  EXPECT_THAT(toposcope("model show cup").out, HasSubstr("handleCon"));
  EXPECT_THAT(toposcope("model show airplane --format dot").out, HasSubstr("digraph"));
  EXPECT_EQ(toposcope("model check neal-1999/pipe-fitting").exit_code, 0);
  EXPECT_THAT(toposcope("plugins list").out, HasSubstr("curvature-tree"));
  EXPECT_THAT(toposcope("plugins describe line-group").out, HasSubstr("segments"));
  EXPECT_EQ(json::parse(toposcope("plugins describe circle --json").out)["id"], "circle");
}

// ---- the kernel and its plugins ----

TEST_F(Program, LinksNoPlugin) {
  const Outcome ldd = shell("ldd " TOPOSCOPE_BUILD_DIR "/bin/toposcope");
  ASSERT_EQ(ldd.exit_code, 0);
  for (const auto& entry : fs::recursive_directory_iterator(TOPOSCOPE_BUILD_DIR "/plugins")) {
    if (entry.path().extension() != ".so") continue;
    EXPECT_EQ(ldd.out.find("/" + entry.path().filename().string() + " "), std::string::npos) << entry.path();
    const Outcome symbols = shell("nm -D --defined-only " + entry.path().string());
    EXPECT_EQ(std::count(symbols.out.begin(), symbols.out.end(), '\n'), 1) << entry.path() << "\n" << symbols.out;
    EXPECT_THAT(symbols.out, HasSubstr("toposcope_plugin"));
  }
}

TEST_F(Program, WorksOnWithoutADeletedPlugin) {
  const TemporaryFolder prefix;
  const fs::path build = TOPOSCOPE_BUILD_DIR;
  fs::create_directories(prefix / "bin");
  fs::copy_file(build / "bin/toposcope", prefix / "bin/toposcope");
  fs::create_directory_symlink(build / "models", prefix / "models");
  fs::create_directory_symlink(build / "pipelines", prefix / "pipelines");
  for (const auto& entry : fs::recursive_directory_iterator(build / "plugins"))
    if (entry.path().extension() == ".so" || entry.path().string().ends_with(".plugin.json")) {
      const fs::path to = prefix.path / fs::relative(entry.path(), build);
      fs::create_directories(to.parent_path());
      fs::copy_file(entry.path(), to);
    }
  fs::remove(prefix / "plugins/shapes/plane.so");
  const std::string program = (prefix / "bin/toposcope").string();
  const Outcome cup = shell(program + " run " + mesh("cup") + " --model cup");
  EXPECT_EQ(cup.exit_code, 4) << cup.err;
  EXPECT_THAT(cup.err, HasSubstr("plane"));
  const Outcome tee = shell(program + " classify " + mesh("tee") + " --models pipe-fitting -q");
  EXPECT_EQ(tee.exit_code, 0) << tee.err;
  EXPECT_THAT(tee.out, HasSubstr("=> tee"));
  EXPECT_THAT(shell(program + " plugins list").out, HasSubstr("cannot be used"));
}

}  // namespace
}  // namespace toposcope::test
