// SPDX-License-Identifier: BSD-3-Clause

// Ctrl-C and SIGTERM leave nothing behind: no half-written file, no temporary folder, no running program.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/program.h"

namespace toposcope::test {
namespace {

namespace fs = std::filesystem;

class Interrupted : public ::testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder_ / "tmp"); }
  /// Sends a signal after `seconds`.
  Outcome after(const std::string& seconds, const std::string& signal, const std::string& arguments) const {
    return shell("cd " + folder_.path.string() + " && TMPDIR=" + (folder_ / "tmp").string() +
                 " timeout --preserve-status -s " + signal + " " + seconds + " " TOPOSCOPE_BUILD_DIR "/bin/toposcope " +
                 arguments);
  }
  std::size_t files(const std::string& name) const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_ / name), fs::directory_iterator()));
  }
  TemporaryFolder folder_;
};

TEST_F(Interrupted, AScanIsNotWritten) {
  for (const char* signal : {"INT", "TERM"}) {
    const Outcome outcome = after("1", signal, "sample cup --scan --views 400 --faces 200000 -o scan.ply");
    EXPECT_EQ(outcome.exit_code, 130) << outcome.err;
    EXPECT_THAT(outcome.err, ::testing::HasSubstr("scan.ply was not written"));
    EXPECT_EQ(files("."), 1U) << "only tmp";
  }
}

TEST_F(Interrupted, ACheckOfPluginsTakesItsChildrenAlong) {
  for (const char* signal : {"INT", "TERM"}) {
    const Outcome outcome = after("2", signal, "plugins check " TOPOSCOPE_BUILD_DIR "/plugins/labelers");
    EXPECT_EQ(outcome.exit_code, 130) << outcome.err;
    EXPECT_EQ(files("tmp"), 0U);
    EXPECT_NE(shell("pgrep -f -- '[-]-child " TOPOSCOPE_BUILD_DIR "/plugins/labelers'").exit_code, 0);
  }
}

}  // namespace
}  // namespace toposcope::test
