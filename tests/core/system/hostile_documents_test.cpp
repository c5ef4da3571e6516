// SPDX-License-Identifier: BSD-3-Clause
// Documents that no program wrote: every reader refuses them in one short line that names the file.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "base/errors.h"
#include "base/json_text.h"
#include "base/text_file.h"
#include "evaluation/dataset.h"
#include "formats/problem_formats.h"
#include "lock/run_lock.h"
#include "model/read_model.h"
#include "pipeline/pipeline_manifest.h"
#include "plugin/catalog.h"
#include "plugin/manifest.h"
#include "result/read_result.h"
#include "scene/scene.h"
#include "support/program.h"
#include "support/refusal.h"
#include "truth/truth.h"

namespace toposcope {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::SizeIs;
namespace fs = std::filesystem;

struct Reader {
  const char* file;
  std::function<void(const fs::path&)> read;
};

std::vector<Reader> readers_of_json() {
  return {{"a.truth.json", [](const fs::path& file) { read_truth(file); }},
          {"a.plugin.json", [](const fs::path& file) { read_manifest(file); }},
          {"result.json", [](const fs::path& file) { read_result(file); }},
          {"scene.json", [](const fs::path& file) { read_scene(read_text_file(file, "scene"), file.string()); }},
          {"run.lock", [](const fs::path& file) { read_lock(file); }},
          {"problem.json", [](const fs::path& file) { read_problem(file); }}};
}

std::vector<Reader> readers() {
  std::vector<Reader> all = readers_of_json();
  all.push_back({"problem.cfn", [](const fs::path& file) { read_problem(file); }});
  all.push_back({"problem.wcsp", [](const fs::path& file) { read_problem(file); }});
  all.push_back({"problem.uai", [](const fs::path& file) { read_problem(file); }});
  all.push_back({"model.yaml", [](const fs::path& file) { read_model(file, nullptr); }});
  all.push_back({"data.yaml", [](const fs::path& file) { read_dataset(file); }});
  all.push_back({"pipeline.yaml", [](const fs::path& file) { read_pipeline(file, PluginCatalog({})); }});
  return all;
}

std::string nested(std::size_t depth) {
  return "{\"features\":\n" + std::string(depth, '[') + std::string(depth, ']') + "}";
}

TEST(HostileDocuments, JsonNestedDeepIsRefusedByEveryReader) {
  const test::TemporaryFolder folder;
  for (const Reader& reader : readers_of_json()) {
    const fs::path file = folder / reader.file;
    test::write_text(file, nested(100'000));
    EXPECT_THAT(test::refusal([&] { reader.read(file); }),
                AllOf(HasSubstr(file.string() + ":2:500: "), HasSubstr("nested more than 500 deep")));
  }
}

TEST(HostileDocuments, OneDeepManifestLeavesTheCatalogBe) {
  const test::TemporaryFolder folder;
  test::write_text(folder / "deep.plugin.json", nested(100'000));
  const PluginCatalog catalog({{folder.path, true}});
  ASSERT_THAT(catalog.problems(), SizeIs(1));
  EXPECT_THAT(catalog.problems()[0].message, HasSubstr("nested more than 500 deep"));
}

TEST(HostileDocuments, NoMessageIsTheLibrarysOwn) {
  const test::TemporaryFolder folder;
  const std::string digits(300, '9');
  for (const Reader& reader : readers_of_json())
    for (const std::string& text :
         {std::string("{\"a\": ]}"), "[" + digits + digits + "]", "{\"a\": \"" + std::string(100'000, 'x') + "\n\"}",
          std::string("{}"), std::string("[1]"), std::string()}) {
      const fs::path file = folder / reader.file;
      test::write_text(file, text);
      const std::string message = test::refusal([&] { reader.read(file); });
      EXPECT_THAT(message, AllOf(HasSubstr(file.string()), Not(HasSubstr("json.exception")), Not(HasSubstr("\n"))));
      EXPECT_LT(message.size(), file.string().size() + 450) << message;
    }
}

TEST(HostileDocuments, JsonFaultsHaveAPlace) {
  const auto refusal = [](const char* text) {
    return test::refusal([&] { parse_json<nlohmann::json>(text, "a.json"); });
  };
  EXPECT_THAT(refusal("{\n \"a\": ]}"), AllOf(HasSubstr("a.json:2:7: is no JSON"), HasSubstr("expected")));
  EXPECT_THAT(refusal("[\"1e999\",\n  1e999]"), AllOf(HasSubstr("a.json:2:"), HasSubstr("1.8e308")));
  EXPECT_EQ(parse_json<nlohmann::json>(std::string(500, '[') + std::string(500, ']'), "a").size(), 1U);
  EXPECT_EQ(parse_json<nlohmann::json>("[\"" + std::string(600, '[') + "\"]", "a").size(), 1U) << "brackets in a text";
}

TEST(HostileDocuments, WhatIsNoRegularFileIsRefusedAtOnce) {
  const test::TemporaryFolder folder;
  for (const Reader& reader : readers()) {
    const fs::path file = folder / reader.file;
    const auto refused = [&] {
      EXPECT_NE(test::refusal([&] { reader.read(file); }).find(file.string()), std::string::npos) << reader.file;
      fs::remove(file);
    };
    ASSERT_EQ(mkfifo(file.c_str(), 0600), 0);
    refused();
    fs::create_symlink("/dev/zero", file);
    refused();
    fs::create_directory(file);
    refused();
    test::write_text(file, "{}");
    fs::resize_file(file, std::uintmax_t{1} << 40);  // a hole
    refused();
  }
}

TEST(HostileDocuments, AllTablesOfAProblemTogetherKeepToTheBudget) {
  const std::string shared = "p 3 100 3 10\n100 100 100\n-2 0 1 0 0\n2 1 2 0 -1\n2 0 2 0 -1\n";  // 80,000 bytes each
  EXPECT_EQ(read_wcsp("a.wcsp", shared, 400'000).problem.constraints.size(), 3U);
  EXPECT_THAT(test::refusal([&] { read_wcsp("a.wcsp", shared, 300'000); }),
              AllOf(HasSubstr("a.wcsp:5:1: "), HasSubstr("problem may take 300000")));
  const std::string cfn =
      "{problem: {name: p mustbe: <9}, variables: {a: 100, b: 100}, functions: {"
      "f: {scope: [a b] defaultcost: 0 costs: []}, g: {scope: [a b] costs: f}}}";
  EXPECT_THAT(test::refusal([&] { read_cfn("a.cfn", cfn, 100'000); }), HasSubstr("problem may take 100000"));
  EXPECT_THAT(test::refusal([] {
                read_problem_json("a.json",
                                  R"({"schema": "toposcope.problem/1", "variables": [], "candidate_count": 100000})",
                                  1'000'000);
              }),
              HasSubstr("exclusions of 100000 candidates"));
}

}  // namespace
}  // namespace toposcope
