// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/dataset.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/errors.h"
#include "support/program.h"
#include "support/refusal.h"

namespace toposcope {
namespace {

using ::testing::HasSubstr;

const MeshFile& file(const DatasetMesh& mesh) {
  return std::get<MeshFile>(mesh.source);
}

const MadeMesh& made(const DatasetMesh& mesh) {
  return std::get<MadeMesh>(mesh.source);
}

class DatasetFile : public ::testing::Test {
 protected:
  Dataset read(const std::string& meshes) {
    test::write_text(folder_ / "set.yaml", "schema: toposcope.dataset/1\nname: set\nmodel: cup\n" + meshes);
    return read_dataset(folder_ / "set.yaml");
  }
  std::string refusal(const std::string& meshes) {
    return test::refusal([&] { read(meshes); });
  }
  test::TemporaryFolder folder_;
};

TEST_F(DatasetFile, FilesByPatternWithTheTruthBesideThem) {
  std::filesystem::create_directory(folder_ / "cups");
  for (const char* name : {"cups/b.off", "cups/a.off", "cups/a.truth.json", "cups/notes.txt"})
    test::write_text(folder_ / name, "x");
  const Dataset dataset = read("meshes: [{files: cups/*.off, class: mug}]\n");
  ASSERT_EQ(dataset.meshes.size(), 2U);
  EXPECT_EQ(file(dataset.meshes[0]).path, folder_ / "cups/a.off") << "in the order of their names";
  EXPECT_EQ(file(dataset.meshes[0]).truth, folder_ / "cups/a.truth.json");
  EXPECT_EQ(file(dataset.meshes[0]).class_name, "mug");
  EXPECT_EQ(file(dataset.meshes[1]).truth, "");
  EXPECT_FALSE(dataset.by_class);
}

TEST_F(DatasetFile, NamedWithoutItsFolderItFindsFilesBesideItself) {
  test::write_text(folder_ / "a.off", "x");
  read("meshes: [{files: a.off}]\n");
  const std::filesystem::path before = std::filesystem::current_path();
  std::filesystem::current_path(folder_ / ".");
  Dataset dataset;
  EXPECT_NO_THROW(dataset = read_dataset("set.yaml"));
  std::filesystem::current_path(before);
  ASSERT_EQ(dataset.meshes.size(), 1U);
  EXPECT_EQ(file(dataset.meshes[0]).path.filename(), "a.off");
}

TEST_F(DatasetFile, OptionalFilesThatAreAbsentAreTold) {
  const Dataset dataset = read("meshes: [{files: nowhere/*.off, optional: true}]\n");
  EXPECT_TRUE(dataset.meshes.empty());
  ASSERT_EQ(dataset.absent.size(), 1U);
  EXPECT_THAT(dataset.absent[0], HasSubstr("nowhere/*.off"));
  EXPECT_THAT(refusal("meshes: [{files: nowhere/*.off}]\n"), HasSubstr("set.yaml:4:18: no file matches"));
}

TEST_F(DatasetFile, ObjectsForEachKindDrawAndNumberOfFaces) {
  const Dataset dataset = read(
      "seed: 7\njudge: class\nmeshes:\n"
      "  - {kind: [tee, wye], random: 3, faces: [5000, 700], scan: true, view: 2, noise: 0.01}\n"
      "  - {kind: cup, preset: mug, faces: [10000], set: {wall: 3, handle: false}}\n");
  ASSERT_EQ(dataset.meshes.size(), 7U);
  EXPECT_TRUE(dataset.by_class);
  EXPECT_EQ(dataset.meshes[0].name, "tee 7 5K");
  EXPECT_EQ(dataset.meshes[1].name, "tee 7 700");
  EXPECT_EQ(dataset.meshes[2].name, "wye 8 5K") << "kinds take turns, seeds count up";
  EXPECT_EQ(made(dataset.meshes[4]).object.kind, "tee");
  EXPECT_EQ(made(dataset.meshes[4]).object.seed, 9U);
  for (std::size_t i = 0; i < 6; ++i) {
    const MadeMesh& each = made(dataset.meshes[i]);
    EXPECT_TRUE(each.object.random);
    EXPECT_EQ(each.object.noise_rel, 0) << "the noise is the scan's";
    ASSERT_TRUE(each.scan);
    EXPECT_EQ(each.scan->faces, i % 2 == 0 ? 5000U : 700U);
    EXPECT_EQ(each.scan->seed, each.object.seed);
    EXPECT_EQ(each.scan->seen_from, 2U);
    EXPECT_EQ(each.scan->noise_rel, 0.01);
  }
  EXPECT_EQ(dataset.meshes[6].object, "mug");
  EXPECT_EQ(dataset.meshes[6].variant, "10K");
  const MadeMesh& mug = made(dataset.meshes[6]);
  EXPECT_FALSE(mug.object.random);
  EXPECT_FALSE(mug.scan);
  EXPECT_EQ(mug.object.parameters, (std::map<std::string, double>{{"handle", 0}, {"wall", 3}}));
}

TEST_F(DatasetFile, DecimatedObjectsAreMadeFineFirst) {
  const Dataset dataset = read("meshes: [{kind: tee, faces: [700, 30000], decimated: true, noise: 0.001}]\n");
  ASSERT_EQ(dataset.meshes.size(), 2U);
  EXPECT_EQ(made(dataset.meshes[0]).object.faces, 20000U);
  EXPECT_EQ(made(dataset.meshes[0]).decimate_to, 700U);
  EXPECT_EQ(dataset.meshes[0].variant, "700");
  EXPECT_EQ(made(dataset.meshes[1]).object.faces, 30000U);
  EXPECT_EQ(made(dataset.meshes[1]).object.noise_rel, 0.001);
}

TEST_F(DatasetFile, RefusalsNameThePlaceAndTheRemedy) {
  for (const auto& [meshes, words] : std::vector<std::pair<std::string, std::string>>{
           {"", "'meshes'"},
           {"meshes: []\n", "set.yaml:4:"},
           {"meshes: [{kind: cup}]\n", "set.yaml:4:"},
           {"meshes: [{kind: cup, faces: [10]}]\n", "set.yaml:4:"},
           {"meshes: [{kind: cup, faces: [5000], colour: red}]\n", "set.yaml:4:"},
           {"judge: taste\nmeshes: [{kind: cup, faces: [5000]}]\n", "known are: features, class"},
           {"meshes: [{kind: cup, faces: [5000], scan: true, decimated: true}]\n", "exclude each other"}})
    EXPECT_THAT(refusal(meshes), HasSubstr(words)) << meshes;
  EXPECT_THROW(read_dataset(folder_ / "absent.yaml"), UsageError);
  test::write_text(folder_ / "list.yaml", "- {kind: cup, faces: [5000]}\n");
  EXPECT_THAT(test::refusal([&] { read_dataset(folder_ / "list.yaml"); }), HasSubstr("list.yaml:1:1: the document is"));
}

}  // namespace
}  // namespace toposcope
