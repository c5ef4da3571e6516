// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/catalog.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "base/errors.h"
#include "core/kernel/plugin/plugin_folder.h"

namespace toposcope {
namespace {

using test::PluginFolderFixture;
using ::testing::AllOf;
using ::testing::HasSubstr;

/// A manifest and a library that need not be one: the catalog loads nothing.
void add(const PluginFolderFixture& folder, const std::string& id, const std::string& subfolder = "") {
  const std::string stem = subfolder.empty() ? id : subfolder + "/" + id;
  folder.write(stem + ".plugin.json", manifest_to_json(PluginFolderFixture::manifest(id)));
  folder.write(stem + library_suffix(), "");
}

template <class Call>
std::string usage_error(const Call& call) {
  try {
    call();
    return "";
  } catch (const UsageError& error) {
    return error.what();
  }
}

TEST(PluginCatalog, ScansTheFolderAndItsKinds) {
  const PluginFolderFixture folder;
  add(folder, "b");
  add(folder, "a", "shapes");
  add(folder, "c", "labelers");
  add(folder, "hidden", "elsewhere");
  const PluginCatalog catalog({{folder.path, true}});
  std::vector<std::string> ids;
  for (const PluginManifest* plugin : catalog.all(PluginKind::shapes)) ids.push_back(plugin->id);
  EXPECT_THAT(ids, ::testing::ElementsAre("a", "b", "c"));
  EXPECT_TRUE(catalog.all(PluginKind::filters).empty());
  EXPECT_EQ(catalog.find(PluginKind::shapes, "b")->id, "b");
  EXPECT_EQ(catalog.find(PluginKind::relations, "b"), nullptr);
  EXPECT_EQ(catalog.find(PluginKind::shapes, "hidden"), nullptr);
}

TEST(PluginCatalog, AFolderReachedTwiceHoldsNoDuplicates) {
  const PluginFolderFixture folder;
  add(folder, "a", "shapes");
  std::filesystem::create_directory_symlink(folder.path, folder.path / "link");
  const PluginCatalog catalog(
      {{folder.path, true}, {folder.path, true}, {folder.path / "shapes", true}, {folder.path / "link", true}});
  EXPECT_TRUE(catalog.problems().empty());
  EXPECT_NE(catalog.find(PluginKind::shapes, "a"), nullptr);
}

TEST(PluginCatalog, RequireSaysWhatIsWrong) {
  const PluginFolderFixture folder;
  add(folder, "circle");
  add(folder, "line-group");
  folder.write("broken.plugin.json", "{");
  const PluginCatalog catalog({{folder.path, true}});
  EXPECT_EQ(catalog.require(PluginKind::shapes, "circle").id, "circle");
  EXPECT_THAT(usage_error([&] { catalog.require(PluginKind::shapes, "cirlce", "cup.yaml:3:4"); }),
              AllOf(::testing::StartsWith("cup.yaml:3:4: there is no shape 'cirlce'"), HasSubstr("'circle'?")));
  EXPECT_THAT(usage_error([&] { catalog.require(PluginKind::relations, "circle"); }),
              AllOf(HasSubstr("no relation 'circle'"), HasSubstr("is a shape")));
  EXPECT_THAT(usage_error([&] { catalog.require(PluginKind::filters, "refine"); }), HasSubstr(folder.path.string()));
  EXPECT_THROW(catalog.require(PluginKind::shapes, "broken"), PluginError);
}

TEST(PluginCatalog, AbsentFoldersAreProblemsWhenTheUserNamedThem) {
  const PluginCatalog catalog({{"/no/such/folder", false}, {"/no/such/folder/either", true}});
  ASSERT_EQ(catalog.problems().size(), 1);
  EXPECT_THAT(catalog.problems()[0].message, HasSubstr("'/no/such/folder/either' does not exist"));
}

TEST(PluginCatalog, RelativeFoldersAreRefused) {
  const PluginCatalog catalog({{".", true}});
  ASSERT_EQ(catalog.problems().size(), 1);
  EXPECT_THAT(catalog.problems()[0].message, HasSubstr("relative"));
}

/// Sets a variable for one test.
class Variable {
 public:
  explicit Variable(const char* value) {
    const char* before = std::getenv(name);
    if (before != nullptr) before_ = before;
    setenv(name, value, 1);
  }
  Variable(const Variable&) = delete;
  Variable& operator=(const Variable&) = delete;
  ~Variable() { before_.empty() ? unsetenv(name) : setenv(name, before_.c_str(), 1); }

 private:
  static constexpr const char* name = "TOPOSCOPE_PLUGIN_PATH";
  std::string before_;
};

TEST(PluginSearchPath, OrderIsExecutablePrefixVariableOption) {
  const Variable variable("/first::/second");
  const auto folders = plugin_search_path({"/third"});
  ASSERT_EQ(folders.size(), 5);
  const auto prefix = std::filesystem::canonical("/proc/self/exe").parent_path().parent_path();
  EXPECT_EQ(folders[0].path, prefix / "plugins");
  EXPECT_EQ(folders[1].path, prefix / "lib/toposcope/plugins");
  EXPECT_EQ(folders[2].path, "/first");
  EXPECT_EQ(folders[3].path, "/second") << "the empty entry between them is not the working directory";
  EXPECT_EQ(folders[4].path, "/third");
  EXPECT_FALSE(folders[0].required);
  EXPECT_TRUE(folders[2].required);
}

TEST(PluginSearchPath, TheWorkingDirectoryIsNeverSearched) {
  const PluginFolderFixture folder;
  add(folder, "stray");
  const auto before = std::filesystem::current_path();
  std::filesystem::current_path(folder.path);
  const Variable variable(":.:./:shapes");
  const PluginCatalog catalog(plugin_search_path());
  std::filesystem::current_path(before);
  EXPECT_EQ(catalog.find(PluginKind::shapes, "stray"), nullptr);
  EXPECT_THAT(catalog.problems(), ::testing::SizeIs(::testing::Ge(3)));
}

}  // namespace
}  // namespace toposcope
