// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "support/program.h"
#include "support/schemas.h"

namespace toposcope::test {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;
namespace fs = std::filesystem;

class EvaluateCommand : public ::testing::Test {
 protected:
  std::string dataset(const std::string& meshes, const std::string& name = "set.yaml") {
    write_text(folder_ / name, "schema: toposcope.dataset/1\nname: set\nsummary: A small set\n" + meshes);
    return (folder_ / name).string();
  }
  TemporaryFolder folder_;
};

TEST_F(EvaluateCommand, WritesTablesInFourForms) {
  const std::string set = dataset("model: cup\nmeshes: [{kind: cup, preset: mug, faces: [4000], scan: true}]\n");
  const std::string out = (folder_ / "out").string();
  const Outcome outcome = toposcope("evaluate " + set + " --out " + out);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("A small set"));
  EXPECT_THAT(outcome.out, HasSubstr("4 of 4 features right"));
  EXPECT_THAT(read_text(out + "/evaluation.txt"), HasSubstr("mug"));
  EXPECT_THAT(read_text(out + "/evaluation.md"), HasSubstr("| mug | rim |"));
  EXPECT_THAT(read_text(out + "/evaluation.csv"), StartsWith("dataset,mesh,object,variant,faces,feature,verdict"));
  const json result = json::parse(read_text(out + "/evaluation.json"));
  EXPECT_EQ(result["schema"], "toposcope.evaluation/1");
  EXPECT_EQ(result["datasets"][0]["features"]["all"]["right"], 4);

  const Outcome again = toposcope("evaluate " + set + " --baseline " + out + "/evaluation.json");
  EXPECT_THAT(again.out, HasSubstr("0 better, 0 worse"));
  EXPECT_THAT(again.out, Not(HasSubstr("not what")));
  EXPECT_EQ(schema_faults("evaluation", read_text(out + "/evaluation.json")), "");

  // Of another model and another mesh nothing can be said to have changed.
  json other = result;
  other["datasets"][0]["model_sha256"] = std::string(64, '0');
  other["datasets"][0]["meshes"][0]["sha256"] = std::string(64, '0');
  write_text(folder_ / "other.json", other.dump());
  const Outcome against = toposcope("evaluate " + set + " --baseline " + (folder_ / "other.json").string());
  EXPECT_THAT(against.out, HasSubstr("1 meshes are not what they were then; the model is not what it was then"));
  write_text(folder_ / "empty.json", "");
  EXPECT_EQ(toposcope("evaluate " + set + " --baseline " + (folder_ / "empty.json").string()).exit_code, 2);
}

TEST_F(EvaluateCommand, AbsentMeshesAreLeftOutLoudly) {
  const Outcome outcome =
      toposcope("evaluate " + dataset("model: cup\nmeshes: [{files: none/*.off, optional: true}]\n"));
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(outcome.err, HasSubstr("no file matches"));
  EXPECT_THAT(outcome.out, HasSubstr("no meshes"));
}

TEST_F(EvaluateCommand, BadUsageNamesThePlace) {
  for (const auto& [arguments, words] : std::vector<std::pair<std::string, std::string>>{
           {"absent.yaml", "absent.yaml"},
           {dataset("model: cupp\nmeshes: [{kind: cup, faces: [4000]}]\n", "cupp.yaml"), "cup"},
           {dataset("model: cup\nmeshes: [{kind: cup, faces: [4000]}]\n") + " --baseline absent.json", "absent.json"},
           {dataset("model: cup\nmeshes: [{kind: cup, faces: [4000], prest: mug}]\n", "prest.yaml"),
            "unknown key 'prest' in 'meshes.0'; did you mean 'preset'?"},
           {dataset("model: cup\nmeshes: [{files: '*.off', optionl: true}]\n", "optionl.yaml"),
            "did you mean 'optional'?"},
           {dataset("model: cup\nmeshes: [{kind: cup, faces: [4]}]\n", "few.yaml"), "meshes.0.faces.0' is 4"},
           {dataset("model: cup\nmeshes: [{kind: cup, faces: [4000]}]\n") + " --json --csv", "exclud"}}) {
    const Outcome outcome = toposcope("evaluate " + arguments);
    EXPECT_EQ(outcome.exit_code, 2) << arguments;
    EXPECT_THAT(outcome.err, HasSubstr(words)) << arguments;
  }
}

}  // namespace
}  // namespace toposcope::test
