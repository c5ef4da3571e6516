// SPDX-License-Identifier: BSD-3-Clause

// What is wrong with a command line, an input or an output is told in words, with an exit code of those that --help
// names.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "support/program.h"
#include "support/schemas.h"

namespace toposcope::test {
namespace {

using ::testing::AnyOf;
using ::testing::HasSubstr;
using ::testing::Not;
namespace fs = std::filesystem;

constexpr const char* triangle = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";

TEST(CommandLine, WhatIsWrongIsTold) {
  const std::pair<const char*, const char*> cases[] = {
      {"rnu x.ply", "did you mean 'run'?"},
      {"plugins lst", "did you mean 'list'?"},
      {"run x.ply --modle cup", "did you mean '--model'?"},
      {"--versoin", "did you mean '--version'?"},
      {"", "name a command: run"},
      {"run x.ply --model cup --seed -1", "whole number from 0 to 18446744073709551615"},
      {"run x.ply --model cup --seed 18446744073709551616", "whole number from 0 to"},
      {"sample cup -o x.ply --faces 1e3", "whole number"},
      {"sample cup -o x.txt", "-o x.txt: write a mesh as .ply"},
      {"label x --time-limit nan", "expected a number of at least 0"},
      {"run x.ply --model cup --seed ''", "--seed is empty"},
      {"run x.ply --model cup --locked ''", "--locked is empty"},
      {"run x.ply --model cup --lock ''", "--lock is empty"},
      {"run x.ply --model cup --out=", "--out is empty"},
      {"prepare x.ply -o ''", "-o is empty"},
      {"run '' --model cup", "is empty"},
      {"evaluate x.yaml --baseline ''", "--baseline is empty"},
      {"render x --mesh ''", "--mesh is empty"},
      {"plugins list --plugin-dir ''", "--plugin-dir is empty"},
  };
  for (const auto& [arguments, words] : cases) {
    const Outcome outcome = toposcope(arguments);
    EXPECT_EQ(outcome.exit_code, 2) << arguments << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr(words)) << arguments;
  }
}

TEST(CommandLine, HelpNamesFormatsAndExitCodes) {
  for (const char* command : {"run", "classify"})
    EXPECT_THAT(toposcope(std::string(command) + " --help").out, HasSubstr("glTF")) << command;
  const std::string help = toposcope("--help").out;
  for (const char* code : {" 1 a fault", "130"}) EXPECT_THAT(help, HasSubstr(code));
}

TEST(CommandLine, PlacesThatCannotBeReadOrWrittenAreNamed) {
  const TemporaryFolder folder;
  const std::string mesh = (folder / "t.off").string();
  write_text(mesh, triangle);
  fs::create_symlink("loop.yaml", folder / "loop.yaml");
  fs::create_symlink("loop", folder / "loop");
  const std::string loop = (folder / "loop").string(), name = std::string(300, 'a');
  for (const std::string& command :
       {"model check " + loop + ".yaml", "model check " + name + ".yaml", "model check " + name,
        "run " + mesh + " --model cup --pipeline " + loop + ".yaml", "classify " + mesh + " --models " + loop + ".yaml",
        "classify " + mesh + " --models " + name, "prepare " + mesh + " -o " + loop, "prepare " + mesh + " -o " + name,
        "run " + mesh + " --model cup --out " + loop, "plugins check " + loop, "plugins check " + name,
        "evaluate " + loop + ".yaml", "label " + name, "render " + name, "report " + loop, "export " + loop}) {
    const Outcome outcome = toposcope(command);
    EXPECT_THAT(outcome.exit_code, AnyOf(2, 3)) << command << outcome.err;
    EXPECT_THAT(outcome.err, AnyOf(HasSubstr("loop"), HasSubstr("aaaaaaaa"))) << command;
    EXPECT_LT(outcome.err.size(), 2000U) << command;
  }
}

TEST(CommandLine, AnOutputThatCannotBeWrittenIsTold) {
  const TemporaryFolder folder;
  write_text(folder / "t.off", triangle);
  for (const std::string& command :
       {std::string("plugins list --json"), std::string("sample --list"), std::string("--version"),
        std::string("run --help"), "prepare --json " + (folder / "t.off").string()})
    for (const char* output : {" >/dev/full", " >&-"}) {
      const Outcome outcome = toposcope(command + output);
      EXPECT_EQ(outcome.exit_code, 2) << command << output;
      EXPECT_THAT(outcome.err, HasSubstr("standard output cannot be written")) << command << output;
    }
  // A mesh that is written must not become standard output.
  const std::string copy = (folder / "copy.off").string();
  toposcope("prepare " + (folder / "t.off").string() + " -o " + copy + " >&-");
  EXPECT_THAT(read_text(copy), Not(HasSubstr("vertices,")));
}

TEST(CommandLine, AFolderForTemporaryFilesThatIsNotThereIsNamed) {
  const Outcome outcome = shell("TMPDIR=/not/there " TOPOSCOPE_BUILD_DIR
                                "/bin/toposcope plugins check " TOPOSCOPE_BUILD_DIR "/plugins/relations/parallel.so");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("/not/there cannot be made; set TMPDIR"));
}

TEST(CommandLine, AFileBeyondItsLimitIsTold) {
  const TemporaryFolder folder;
  const std::string mesh = (folder / "big.ply").string();
  const Outcome outcome =
      shell("ulimit -f 8; " TOPOSCOPE_BUILD_DIR "/bin/toposcope sample cup --faces 5000 -o " + mesh);
  EXPECT_EQ(outcome.exit_code, 2) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("big.ply: cannot be written"));
  EXPECT_TRUE(fs::is_empty(folder.path));
}

TEST(CommandLine, TextFromFilesDoesNotCommandTheTerminal) {
  const TemporaryFolder folder;
  const std::string model = (folder / "m.yaml").string();
  write_text(
      model,
      "schema: toposcope.model/1\nname: cup\nsummary: \"\\e]0;owned\\a\"\nfeatures:\n  rim: {worksets: [convex], "
      "shape: circle, detectability: 1}\n");
  const Outcome shown = toposcope("model show " + model);
  EXPECT_EQ(shown.exit_code, 0) << shown.err;
  EXPECT_THAT(shown.out, HasSubstr("\\u001b]0;owned\\u0007"));
  write_text(folder / "l.yaml", "schema: toposcope.model/1\nname: caf\xe9\n");
  write_text(folder / "e.yaml", "schema: \"\\e[2J\"\n");
  for (const auto& [file, code] : {std::pair("l.yaml", "line"), std::pair("e.yaml", "e.yaml")}) {
    const Outcome refused = toposcope("model check " + (folder / file).string());
    EXPECT_EQ(refused.exit_code, 2) << refused.err;
    EXPECT_THAT(refused.err, HasSubstr(file));
    EXPECT_EQ(std::count(refused.err.begin(), refused.err.end(), '\x1b'), 0) << code;
  }
}

/// The model asks for thickness: that a mesh has none is no fault of the model's.
TEST(CommandLine, AFlatMeshIsToldByItsName) {
  const TemporaryFolder folder;
  const std::string flat = (folder / "flat.off").string();
  write_text(flat, "OFF\n4 2 0\n0 0 0\n3 0 0\n3 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n");
  const Outcome outcome = toposcope("run " + flat + " --model cup");
  EXPECT_EQ(outcome.exit_code, 3) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr(flat + ": the mesh is flat: its box is 3 x 1 x 0"));
}

TEST(CommandLine, TheEndSaysWhatWasNotDone) {
  const TemporaryFolder folder;
  write_text(folder / "good.off", triangle);
  write_text(folder / "bad.off", "OFF\n3 1 0\n0 0 nan\n1 0 0\n0 1 0\n3 0 1 2\n");
  const Outcome prepared =
      toposcope("prepare -q " + (folder / "bad.off").string() + " " + (folder / "good.off").string());
  EXPECT_EQ(prepared.exit_code, 3);
  EXPECT_THAT(prepared.err, HasSubstr("1 of 2 meshes was not done: " + (folder / "bad.off").string()));
  write_text(folder / "set.yaml", "schema: toposcope.dataset/1\nname: s\nmodel: cup\nmeshes: [{files: bad.off}]\n");
  const Outcome evaluated = toposcope("evaluate " + (folder / "set.yaml").string());
  EXPECT_EQ(evaluated.exit_code, 3) << evaluated.err;
  EXPECT_THAT(evaluated.err, HasSubstr("1 of 1 meshes was not done: bad"));
}

/// A solver that gives no answer leaves the other labelers to be compared.
TEST(CommandLine, ALabelerThatFailsIsNotPassedOver) {
  const TemporaryFolder folder;
  const std::string cup = (folder / "cup.ply").string();
  ASSERT_EQ(toposcope("sample cup --faces 2000 -o " + cup).exit_code, 0);
  write_text(folder / "toulbar2", "#!/bin/sh\necho no\n");
  fs::permissions(folder / "toulbar2", fs::perms::owner_all);
  const Outcome outcome =
      shell("PATH=" + folder.path.string() + ":$PATH " TOPOSCOPE_BUILD_DIR "/bin/toposcope compare " + cup +
            " --model cup --labelers toulbar2,least-error --json --out " + (folder / "out").string());
  EXPECT_EQ(outcome.exit_code, 4) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("1 of 2 labelers was not done: toulbar2 (plugin 'toulbar2'"));
  EXPECT_THAT(outcome.out, HasSubstr("\"labeler\":\"least-error\""));
  EXPECT_EQ(schema_faults("comparison", outcome.out), "");
  EXPECT_TRUE(fs::exists(folder / "out/index.json"));
}

TEST(CommandLine, APluginThatIsNotThereLeavesTheOthersToBeChecked) {
  const Outcome outcome = toposcope("plugins check nowhere.so " TOPOSCOPE_BUILD_DIR "/plugins/relations/parallel.so");
  EXPECT_EQ(outcome.exit_code, 2) << outcome.out;
  EXPECT_THAT(outcome.err, HasSubstr("nowhere.so: no such file"));
  EXPECT_THAT(outcome.out, HasSubstr("1 pass, 0 fail"));
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
TEST(CommandLine, AMeshThatMemoryDoesNotHoldLeavesTheOthersToBeDone) {
  const TemporaryFolder folder;
  write_text(folder / "good.off", triangle);
  write_text(folder / "huge.off", triangle);
  fs::resize_file(folder / "huge.off", std::uintmax_t{1} << 36);  // takes no room on the disk
  const Outcome outcome = shell("ulimit -v 4000000; " TOPOSCOPE_BUILD_DIR "/bin/toposcope prepare --threads 1 " +
                                (folder / "huge.off").string() + " " + (folder / "good.off").string());
  EXPECT_EQ(outcome.exit_code, 3) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("huge.off: out of memory"));
  EXPECT_THAT(outcome.out, HasSubstr("good.off"));
}
#endif

TEST(CommandLine, NamesFromFilesStayInTheirFolder) {
  const TemporaryFolder folder;
  fs::create_directories(folder / "out");
  write_text(folder / "...off", triangle);
  const Outcome outcome = toposcope("prepare " + (folder / "...off").string() + " -o " + (folder / "out/").string());
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_TRUE(fs::exists(folder / "out/_..ply") || fs::exists(folder / "out/_.ply"));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path), fs::directory_iterator()), 2);
}

}  // namespace
}  // namespace toposcope::test
