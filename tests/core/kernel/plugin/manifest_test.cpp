// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/manifest.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "base/errors.h"
#include "base/schemas.h"
#include "core/kernel/plugin/plugin_folder.h"
#include "model/yaml_schema.h"

namespace toposcope {
namespace {

using test::PluginFolderFixture;
using ::testing::AllOf;
using ::testing::HasSubstr;

PluginManifest example() {
  PluginManifest manifest;
  manifest.kind = PluginKind::shapes;
  manifest.id = "line-group";
  manifest.version = "1.20.3";
  manifest.summary = "A group of \"line\" segments, \xce\xba";
  manifest.citation = "Neal 1999, 4.4";
  manifest.fingerprint = "cxxabi=1";
  manifest.abi_major = abi_major;
  manifest.min_arity = 1;
  manifest.dimension = 1;
  manifest.max_arity = 0;
  manifest.options = {{"tolerance", OptionType::real, "deg", "5", "0", "90", "largest angle"},
                      {"method", OptionType::text, "", "robust", "", "", "how to fit", "robust|powell"},
                      {"smooth", OptionType::boolean, "", "true", "", "", "whether to smooth"}};
  manifest.arguments = {{"segments", OptionType::integer, "", "", "1", "", "number of segments"}};
  manifest.programs = {"solver", "viewer"};
  manifest.provides = {{"length", 1, "whole length"}, {"length_#", 1, "of one segment"}};
  return manifest;
}

TEST(PluginManifest, ReadsBackWhatItWrites) {
  const PluginFolderFixture folder;
  folder.write("line-group.plugin.json", manifest_to_json(example()));
  const PluginManifest read = read_manifest(folder.path / "line-group.plugin.json");
  EXPECT_THAT(differences(read, example()), ::testing::IsEmpty());
  EXPECT_EQ(read.options[1].choices, "robust|powell");
  EXPECT_EQ(read.library, folder.path / ("line-group" + library_suffix()));
  EXPECT_EQ(manifest_to_json(read), manifest_to_json(example()));
}

TEST(PluginManifest, SaysNothingOfItsPlace) {
  EXPECT_THAT(manifest_to_json(PluginFolderFixture::manifest("good")), ::testing::Not(HasSubstr("/bad_plugins")));
}

TEST(PluginManifest, KeepsItsSchema) {
  ErrorList errors;
  check_schema(parse_yaml(manifest_to_json(example()), "manifest"), plugin_schema(), "manifest", errors);
  EXPECT_NO_THROW(errors.throw_if_any());
}

TEST(PluginManifest, EveryDifferenceIsNamed) {
  using Change = void (*)(PluginManifest&);
  const std::vector<std::pair<const char*, Change>> changes = {
      {"id", [](PluginManifest& m) { m.id = "x"; }},
      {"kind", [](PluginManifest& m) { m.kind = PluginKind::labelers; }},
      {"version", [](PluginManifest& m) { m.version = "2.0.0"; }},
      {"abi", [](PluginManifest& m) { m.abi_minor = 7; }},
      {"fingerprint", [](PluginManifest& m) { m.fingerprint = "x"; }},
      {"summary", [](PluginManifest& m) { m.summary = "x"; }},
      {"citation", [](PluginManifest& m) { m.citation = "x"; }},
      {"unit", [](PluginManifest& m) { m.unit = "deg"; }},
      {"minimum arity", [](PluginManifest& m) { m.min_arity = 2; }},
      {"maximum arity", [](PluginManifest& m) { m.max_arity = 2; }},
      {"ordered", [](PluginManifest& m) { m.ordered = true; }},
      {"dimension", [](PluginManifest& m) { m.dimension = 2; }},
      {"options", [](PluginManifest& m) { m.options[0].maximum = "91"; }},
      {"options", [](PluginManifest& m) { m.options[1].choices = "robust"; }},
      {"options", [](PluginManifest& m) { m.options.pop_back(); }},
      {"arguments", [](PluginManifest& m) { m.arguments[0].type = OptionType::real; }},
      {"provides", [](PluginManifest& m) { m.provides[1].dimension = 2; }},
      {"programs", [](PluginManifest& m) { m.programs.pop_back(); }},
  };
  for (const auto& [field, change] : changes) {
    PluginManifest other = example();
    change(other);
    EXPECT_THAT(differences(other, example()), ::testing::ElementsAre(::testing::StartsWith(field)));
  }
}

/// What reading says of the example after `change` was made to its JSON.
template <class Change>
std::string error_after(const Change& change) {
  const PluginFolderFixture folder;
  auto json = nlohmann::json::parse(manifest_to_json(example()));
  change(json);
  folder.write("line-group.plugin.json", json.dump());
  try {
    read_manifest(folder.path / "line-group.plugin.json");
    return "";
  } catch (const UsageError& error) {
    EXPECT_THAT(error.what(), HasSubstr((folder.path / "line-group.plugin.json").string()));
    return error.what();
  }
}

TEST(PluginManifest, EveryFieldIsNeededAndTyped) {
  const auto whole = nlohmann::json::parse(manifest_to_json(example()));
  for (const auto& field : whole.items()) {
    const std::string name = field.key();
    EXPECT_THAT(error_after([&](auto& json) { json.erase(name); }), HasSubstr(": " + name + ": is missing"));
    EXPECT_THAT(error_after([&](auto& json) { json[name] = nullptr; }), HasSubstr(": " + name + ": must be"));
  }
}

/// What else differs follows from it.
TEST(PluginManifest, OfAnotherAbiIsToldByThatAlone) {
  EXPECT_THAT(error_after([](auto& json) {
                json["abi"] = {{"major", 2}, {"minor", 1}};
                json.erase("dimension");
                json["needs"] = "x";
              }),
              HasSubstr("it was built for plugin ABI 2.1, this program has ABI " + std::to_string(abi_major) + "."));
}

TEST(PluginManifest, WrongFieldsAreNamed) {
  EXPECT_THAT(error_after([](auto& json) { json["schema"] = "toposcope.plugin/2"; }), HasSubstr("schema: must be"));
  EXPECT_THAT(error_after([](auto& json) { json["kind"] = "shape"; }), HasSubstr("kind: 'shape' is none of"));
  EXPECT_THAT(error_after([](auto& json) { json["version"] = "1.0"; }), HasSubstr("version '1.0'"));
  EXPECT_THAT(error_after([](auto& json) { json["id"] = "Line Group"; }), HasSubstr("id 'Line Group'"));
  EXPECT_THAT(error_after([](auto& json) { json["id"] = "circle"; }), HasSubstr("does not agree with the file's name"));
  EXPECT_THAT(error_after([](auto& json) { json["abi"]["major"] = -1; }), HasSubstr("abi.major: must be a whole"));
  EXPECT_THAT(error_after([](auto& json) { json["abi"]["major"] = 4294967296; }), HasSubstr("abi.major: must be"));
  EXPECT_THAT(error_after([](auto& json) { json["arity"]["maximum"] = 1.5; }), HasSubstr("arity.maximum: must be"));
  EXPECT_THAT(error_after([](auto& json) { json["options"][1]["type"] = "word"; }), HasSubstr("options[1].type"));
  EXPECT_THAT(error_after([](auto& json) { json["options"][0]["default"] = "91"; }), HasSubstr("cannot be '91'"));
  EXPECT_THAT(error_after([](auto& json) { json["options"][0]["defualt"] = "9"; }), HasSubstr("options[0].defualt"));
  EXPECT_THAT(error_after([](auto& json) { json["provides"][0]["dimension"] = "1"; }),
              HasSubstr("provides[0].dimension: must be a whole number"));
  EXPECT_THAT(error_after([](auto& json) { json["options"][0]["name"] = "plugin"; }), HasSubstr("'plugin'"));
  EXPECT_THAT(error_after([](auto& json) { json = nlohmann::json::array(); }), HasSubstr("must be an object"));
}

TEST(PluginManifest, ProvidedNamesCountWithAMark) {
  const PluginManifest manifest = example();
  EXPECT_EQ(manifest.find_provided("length"), &manifest.provides[0]);
  EXPECT_EQ(manifest.find_provided("length_1"), &manifest.provides[1]);
  EXPECT_EQ(manifest.find_provided("length_20"), &manifest.provides[1]);
  for (const char* none : {"", "length_", "length_0", "length_01", "length_x", "length_1x", "length_#", "radius"})
    EXPECT_EQ(manifest.find_provided(none), nullptr) << none;
}

TEST(PluginManifest, KindsHaveNames) {
  for (const PluginKind kind : plugin_kinds) EXPECT_EQ(plugin_kind(to_string(kind)), kind);
  EXPECT_EQ(plugin_kind("shape"), std::nullopt);
}

TEST(PluginManifest, IncompleteDescriptorsAreRefused) {
  const PluginDescriptor& good = load_plugin_library(PluginFolderFixture::built("good"), "good");
  const auto error_of = [&](auto&& spoil) -> std::string {
    PluginDescriptor descriptor = good;
    spoil(descriptor);
    try {
      manifest_from_descriptor(descriptor);
    } catch (const PluginError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(error_of([](PluginDescriptor&) {}), "");
  EXPECT_THAT(error_of([](PluginDescriptor& d) { d.id = nullptr; }), HasSubstr("null 'id'"));
  EXPECT_THAT(error_of([](PluginDescriptor& d) { d.summary = nullptr; }), HasSubstr("null 'summary'"));
  EXPECT_THAT(error_of([](PluginDescriptor& d) { d.kind = "shape"; }), HasSubstr("kind 'shape'"));
  EXPECT_THAT(error_of([](PluginDescriptor& d) { d.create = nullptr; }), HasSubstr("no create"));
  EXPECT_THAT(error_of([](PluginDescriptor& d) { d.destroy = nullptr; }), HasSubstr("no destroy"));
  EXPECT_THAT(error_of([](PluginDescriptor& d) { d.option_count = 1; }), HasSubstr("null table"));
  EXPECT_THAT(error_of([](PluginDescriptor& d) { d.provided_count = 1; }), HasSubstr("null table"));
  EXPECT_THAT(error_of([](PluginDescriptor& d) { d.min_arity = 0; }), HasSubstr("arity"));
  EXPECT_THAT(error_of([](PluginDescriptor& d) { d.dimension = -1; }), HasSubstr("a shape says its own"));
  EXPECT_THAT(error_of([](PluginDescriptor& d) { d.dimension = 4; }), HasSubstr("dimension 4"));
  EXPECT_THAT(error_of([](PluginDescriptor& d) { d.kind = "filters"; }), HasSubstr("only shapes"));
  EXPECT_THAT(error_of([](PluginDescriptor& d) { d.version = "one"; }), HasSubstr("version 'one'"));
  EXPECT_THAT(
      error_of([](PluginDescriptor& d) { d.kind = "relations", d.min_arity = d.max_arity = 2, d.dimension = -1; }),
      HasSubstr("unit"));
}

}  // namespace
}  // namespace toposcope
