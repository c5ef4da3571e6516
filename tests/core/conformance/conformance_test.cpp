// SPDX-License-Identifier: BSD-3-Clause
// The conformance kit: what is sound passes, each plugin that is broken in one way fails with exactly that verdict, and
// every plugin of this tree passes.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "examination.h"
#include "support/program.h"

namespace toposcope::test {
namespace {

using nlohmann::json;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;
namespace fs = std::filesystem;

fs::path broken(const std::string& id) {
  return fs::path(TOPOSCOPE_BUILD_DIR) / "broken_plugins" / id / (id + ".so");
}

/// The failed checks of one library, each as "check: detail".
std::vector<std::string> failures(const fs::path& library, const std::string& options = "") {
  const Outcome outcome = toposcope("plugins check --json " + options + " " + library.string());
  std::vector<std::string> failed;
  bool any = false;
  const json report = json::parse(outcome.out, nullptr, false);
  if (report.is_discarded()) return {"no report: " + outcome.out + outcome.err};
  for (const json& plugin : report["plugins"])
    for (const json& check : plugin["checks"]) {
      any = true;
      if (check["outcome"] == "FAIL")
        failed.push_back(check["check"].get<std::string>() + ": " + check["detail"].get<std::string>());
    }
  EXPECT_TRUE(any) << "nothing was checked";
  EXPECT_EQ(outcome.exit_code, failed.empty() ? 0 : 4);
  return failed;
}

TEST(Conformance, SoundPluginsOfEveryKindPass) {
  for (const char* id : {"sound-worksets", "sound-shape", "sound-relation", "sound-labeler", "sound-filter"})
    EXPECT_THAT(failures(broken(id)), ::testing::IsEmpty()) << id;
}

struct Case {
  const char* id;
  const char* verdict;
  friend void PrintTo(const Case& broken, std::ostream* stream) { *stream << broken.id; }
};

class BrokenPlugin : public ::testing::TestWithParam<Case> {};

TEST_P(BrokenPlugin, FailsWithExactlyItsVerdict) {
  EXPECT_THAT(failures(broken(GetParam().id)), ::testing::ElementsAre(StartsWith(GetParam().verdict)));
}

INSTANTIATE_TEST_SUITE_P(
    Conformance, BrokenPlugin,
    ::testing::Values(
        Case{"throws-always", "ordinary input: on a ring, threw: point 7 of 3"},
        Case{"unknown-measure", "contract: on a ring, gives a measure 'girth'"},
        Case{"unconnected-sets", "contract: on an uneven torus, gave a working set that is not connected"},
        Case{"loses-origins", "contract: on an uneven torus, gave a mesh whose faces do not say"},
        Case{"keeps-what-it-moved", "contract: on an uneven torus, says that vertex 0 is vertex 0 of its input"},
        Case{"claims-exactness", "contract: on random problem 1, says that its evidence is exact"},
        Case{"wrong-costs", "contract: on random problem 1, gave a labelling the cost"},
        Case{"no-tolerance", "contract: on two rings and a segment, gives the tolerance 0"},
        Case{"option-without-sense", "options: on a ring with part = 0, explains inf"},
        Case{"chokes-on-empty", "degenerate input: on no point, threw: no points"},
        Case{"crashes-on-one-point", "degenerate input: on one point, "},
        Case{"passes-nan-on", "NaN: on a ring with one point that is NaN, gives a usable fit the rms inf"},
        Case{"swallows-exceptions", "exceptions: when a call of its context throws, it swallows"},
        Case{"counts-its-calls", "repeat: on "},
        Case{"depends-on-threads", "threads: on a ring, the answer with 3 threads is another"},
        Case{"knows-up", "rotation: turned: of a ring, reach is"},
        Case{"knows-the-origin", "translation: shifted: of a ring, reach is"},
        Case{"knows-millimetres", "scale: scaled: of a ring, reach is"},
        Case{"knows-the-first-point", "order: in another order: of "},
        Case{"proves-too-much", "order: in another order: on random problem"},
        Case{"talks", "output: it writes 'a shape is made'"}),
    [](const auto& test) {
      std::string name = test.param.id;
      std::replace(name.begin(), name.end(), '-', '_');
      return name;
    });

class Failures final : public VerdictSink {
 public:
  void begin(const std::string&) override {}
  void on(const std::string&) override {}
  void end(const CheckVerdict& verdict) override {
    if (verdict.outcome == toposcope::Outcome::failed) failed.push_back(verdict.check + ": " + verdict.detail);
  }
  std::vector<std::string> failed;
};

TEST(Conformance, APluginThatNeverStopsFailsWhenPatienceEnds) {
  Failures sink;
  examine_plugin(broken("never-stops"), {.patience_s = 1}, sink);
  EXPECT_THAT(sink.failed, ::testing::ElementsAre(StartsWith(
                               "cancellation: on a torus of 100,000 faces, cancelled before it began, it went")));
}

/// The plugins that cannot be loaded have no manifest of their own, and say so; with one that lies, the loader's words
/// are the verdict.
TEST(Conformance, WhatCannotBeLoadedFailsInItsManifest) {
  EXPECT_THAT(failures(fs::path(TOPOSCOPE_BUILD_DIR) / "bad_plugins/good/good.so"),
              ::testing::ElementsAre(AllOf(StartsWith("manifest: its manifest"), HasSubstr("is not beside it"))));
  const struct {
    const char *name, *words;
  } cases[] = {{"wrong-major", "built for plugin ABI 4."},
               {"newer-minor", "newer plugin ABI"},
               {"wrong-fingerprint", "compiled differently"},
               {"missing-symbol", "does not export the symbol"},
               {"undefined-symbol", "cannot be loaded"},
               {"null-descriptor", "returned no descriptor"},
               {"short-descriptor", "64 bytes"}};
  const std::string manifest = read_text(broken("sound-shape").replace_extension() += ".plugin.json");
  for (const auto& [name, words] : cases) {
    const TemporaryFolder folder;
    fs::copy(fs::path(TOPOSCOPE_BUILD_DIR) / "bad_plugins" / name / (std::string(name) + ".so"), folder.path);
    std::string lie = manifest;
    lie.replace(lie.find("sound-shape"), std::string("sound-shape").size(), name);
    write_text(folder / (std::string(name) + ".plugin.json"), lie);
    EXPECT_THAT(failures(folder / (std::string(name) + ".so")),
                ::testing::ElementsAre(AllOf(StartsWith("manifest: "), HasSubstr(words))));
  }
}

/// A folder with a good plugin and one that crashes: the good one is examined all the same.
TEST(Conformance, ACrashTakesNothingElseWithIt) {
  const TemporaryFolder folder;
  for (const char* id : {"crashes-on-one-point", "sound-shape"})
    for (const auto& entry : fs::directory_iterator(broken(id).parent_path())) fs::copy(entry.path(), folder.path);
  const Outcome outcome = toposcope("plugins check " + folder.path.string());
  EXPECT_EQ(outcome.exit_code, 4);
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("FAIL  degenerate input"), HasSubstr("1 pass, 1 fail")));
}

TEST(Conformance, WhatIsNotThereIsAUsageError) {
  EXPECT_EQ(toposcope("plugins check /no/such/folder").exit_code, 2);
  const TemporaryFolder empty;
  EXPECT_EQ(toposcope("plugins check " + empty.path.string()).exit_code, 2);
}

/// Why memory cannot be checked here; empty where it can.
std::string no_valgrind() {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  return "NOT CHECKED: valgrind and a sanitizer do not go together";
#else
  if (shell("valgrind --version").exit_code == 0) return "";
  return "NOT CHECKED: valgrind is not installed (apt-get install valgrind)";
#endif
}

/// Of several plugins only the one that leaks fails.
TEST(Conformance, LeaksAreFoundUnderValgrind) {
  if (const std::string why = no_valgrind(); !why.empty()) GTEST_SKIP() << why;
  EXPECT_THAT(failures(broken("leaks"), "--valgrind " + broken("sound-shape").string()),
              ::testing::ElementsAre(AllOf(StartsWith("memory: valgrind: "), HasSubstr("definitely lost"))));
}

class ShippedPlugins : public ::testing::TestWithParam<const char*> {};

/// The memory too, where it can be checked.
TEST_P(ShippedPlugins, Pass) {
  const std::string why_not = no_valgrind();
  EXPECT_THAT(failures(fs::path(TOPOSCOPE_BUILD_DIR) / "plugins" / GetParam(), why_not.empty() ? "--valgrind" : ""),
              ::testing::IsEmpty());
  if (!why_not.empty()) GTEST_SKIP() << why_not;
}

INSTANTIATE_TEST_SUITE_P(Conformance, ShippedPlugins,
                         ::testing::Values("worksets", "shapes", "relations", "labelers", "filters"),
                         [](const auto& test) { return std::string(test.param); });

}  // namespace
}  // namespace toposcope::test
