// SPDX-License-Identifier: BSD-3-Clause
// Lock files: the same run goes through, and one byte in a plugin, a model or a mesh is refused by its name.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validator.hpp>

#include "base/sha256.h"
#include "support/program.h"

namespace toposcope::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
namespace fs = std::filesystem;

/// A program with plugins, model and mesh of its own, to be spoiled.
class Lock : public ::testing::Test {
 protected:
  Lock() {
    const fs::path build = TOPOSCOPE_BUILD_DIR;
    fs::create_directories(folder / "bin");
    fs::copy_file(build / "bin/toposcope", folder / "bin/toposcope");
    for (const char* kind : {"models", "pipelines"}) fs::create_directory_symlink(build / kind, folder / kind);
    for (const auto& entry : fs::recursive_directory_iterator(build / "plugins"))
      if (entry.path().extension() == ".so" || entry.path().string().ends_with(".plugin.json")) {
        const fs::path to = folder.path / fs::relative(entry.path(), build);
        fs::create_directories(to.parent_path());
        fs::copy_file(entry.path(), to);
      }
    fs::copy_file(build / "models/cup.yaml", model());
    EXPECT_EQ(program("sample cup --faces 3000 -o " + mesh().string()).exit_code, 0);
    const Outcome locking = run("--lock " + lock().string());
    EXPECT_EQ(locking.exit_code, 0) << locking.err;
  }

  fs::path model() const { return folder / "my-cup.yaml"; }
  fs::path mesh() const { return folder / "cup.ply"; }
  fs::path lock() const { return folder / "run.lock"; }
  fs::path plugin(const std::string& name) const { return folder / ("plugins/" + name); }
  Outcome program(const std::string& arguments) const {
    return shell((folder / "bin/toposcope").string() + " " + arguments);
  }
  Outcome run(const std::string& arguments) const {
    return program("run " + mesh().string() + " --model " + model().string() + " -q --json " + arguments);
  }
  Outcome locked(const std::string& arguments = "") const {
    return run("--locked " + lock().string() + " " + arguments);
  }

  /// One byte in the middle, or at the end, is another.
  static void spoil(const fs::path& file, bool at_end = false) {
    std::fstream stream(file, std::ios::in | std::ios::out | std::ios::binary);
    const auto at = static_cast<std::streamoff>(at_end ? fs::file_size(file) - 1 : fs::file_size(file) / 2);
    stream.seekg(at);
    const char byte = static_cast<char>(stream.get() ^ 1);
    stream.seekp(at);
    stream.put(byte);
  }

  TemporaryFolder folder;
};

TEST_F(Lock, TheSameRunGoesThroughAndGivesTheSame) {
  const auto without_times = [](const Outcome& outcome) {
    nlohmann::json result = nlohmann::json::parse(outcome.out);
    result.erase("timings_ms");
    return result;
  };
  const Outcome first = run(""), again = locked();
  ASSERT_EQ(again.exit_code, 0) << again.err;
  EXPECT_EQ(without_times(first), without_times(again));
  EXPECT_EQ(locked("--threads 1").exit_code, 0) << "threads do not decide";
  fs::rename(mesh(), folder / "moved.ply");
  fs::create_symlink(folder / "moved.ply", mesh());
  EXPECT_EQ(locked().exit_code, 0) << "paths do not decide";
}

TEST_F(Lock, AByteInAPluginIsRefusedBeforeItIsLoaded) {
  spoil(plugin("shapes/circle.so"));
  const Outcome outcome = locked();
  EXPECT_EQ(outcome.exit_code, 4);
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("plugin 'circle': library"), HasSubstr("circle.so' is another: sha256"),
                                 Not(HasSubstr("'plane'")), Not(HasSubstr("mesh '"))));
  EXPECT_TRUE(outcome.out.empty());
}

TEST_F(Lock, AByteInTheModelIsRefused) {
  std::ofstream(model(), std::ios::app) << "\n";
  const Outcome outcome = locked();
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("model '" + model().string()), HasSubstr("is another"),
                                 Not(HasSubstr("plugin '")), Not(HasSubstr("mesh '"))));
}

TEST_F(Lock, AnotherProgramOfTheSameVersionIsRefused) {
  auto document = nlohmann::json::parse(read_text(lock()));
  document["program"]["file"]["sha256"] = std::string(64, '0');
  write_text(lock(), document.dump());
  const Outcome outcome = locked();
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("program '"), HasSubstr("is another"), Not(HasSubstr("plugin '"))));
}

TEST_F(Lock, AByteInAMeshIsRefused) {
  spoil(mesh(), true);
  const Outcome outcome = locked();
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("mesh '" + mesh().string()), Not(HasSubstr("plugin '"))));
}

TEST_F(Lock, OptionsSeedAndPluginsAreNamed) {
  const Outcome option = locked("--set shapes.circle.scale=2");
  EXPECT_EQ(option.exit_code, 2);
  EXPECT_THAT(option.err, HasSubstr("plugin 'circle': option 'scale': '1' in the lock, '2' now"));
  const Outcome probability = locked("--set probability.max_candidates=7");
  EXPECT_EQ(probability.exit_code, 2);
  EXPECT_THAT(probability.err, HasSubstr("probability option 'max_candidates'"));
  const Outcome seed = locked("--seed 5");
  EXPECT_EQ(seed.exit_code, 2);
  EXPECT_THAT(seed.err, HasSubstr("seed: '1' in the lock, '5' now"));
  const Outcome labeler = locked("--labeler annealing");
  EXPECT_EQ(labeler.exit_code, 4);
  EXPECT_THAT(labeler.err, AllOf(HasSubstr("least-error"), HasSubstr("annealing")));
  const Outcome meshes = locked(mesh().string());
  EXPECT_EQ(meshes.exit_code, 2);
  EXPECT_THAT(meshes.err, HasSubstr("meshes: 1 in the lock, 2 given"));
}

TEST_F(Lock, PartsOfAGltfMeshAreLocked) {
  // A tetrahedron whose positions stand in a file of their own, three for each face.
  const float corners[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  std::ofstream part(folder / "part.bin", std::ios::binary);
  for (const int corner : {0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3})
    part.write(reinterpret_cast<const char*>(corners[corner]), sizeof corners[corner]);
  part.close();
  const fs::path gltf = folder / "one.gltf";
  write_text(gltf, R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
    "meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"buffers":[{"uri":"part.bin","byteLength":144}],
    "bufferViews":[{"buffer":0,"byteLength":144}],
    "accessors":[{"bufferView":0,"componentType":5126,"count":12,"type":"VEC3","min":[0,0,0],"max":[1,1,1]}]})");
  const std::string arguments = "run " + gltf.string() + " --model cup -q --json ";
  ASSERT_EQ(program(arguments + "--lock " + lock().string()).exit_code, 0);
  EXPECT_EQ(program(arguments + "--locked " + lock().string()).exit_code, 0);
  spoil(folder / "part.bin");
  const Outcome outcome = program(arguments + "--locked " + lock().string());
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_THAT(outcome.err, HasSubstr("part of mesh '" + (folder / "part.bin").string()));
}

TEST_F(Lock, KeepsToItsSchemaAndToNothingElse) {
  const nlohmann::json schema_json = nlohmann::json::parse(read_text(TOPOSCOPE_SOURCE_DIR "/schemas/lock.schema.json"));
  valijson::Schema schema;
  valijson::SchemaParser().populateSchema(valijson::adapters::NlohmannJsonAdapter(schema_json), schema);
  nlohmann::json document = nlohmann::json::parse(read_text(lock()));
  const auto valid = [&] {
    return valijson::Validator().validate(schema, valijson::adapters::NlohmannJsonAdapter(document), nullptr);
  };
  EXPECT_TRUE(valid());
  document["model"]["sha256"] = "short";
  EXPECT_FALSE(valid()) << "the test has teeth";
  write_text(lock(), "{}");
  EXPECT_EQ(locked().exit_code, 2);
  EXPECT_THAT(locked().err, HasSubstr("is no lock file"));
  EXPECT_EQ(run("--locked " + (folder / "none.lock").string()).exit_code, 2);
  EXPECT_EQ(run("--lock a --locked b").exit_code, 2);
}

/// The test vectors of FIPS 180-4.
TEST(Sha256, KnownAnswers) {
  const TemporaryFolder folder;
  write_text(folder / "abc", "abc");
  EXPECT_EQ(sha256_of(folder / "abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  write_text(folder / "empty", "");
  EXPECT_EQ(sha256_of(folder / "empty"), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
}

}  // namespace
}  // namespace toposcope::test
