// SPDX-License-Identifier: BSD-3-Clause
// The house rules for plugins: one folder, one source of the plugin's name, one CMake file, one page, one test; each
// library exports one symbol.

#include <elf.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <iterator>
#include <vector>

#include "base/errors.h"
#include "plugin/plugin_page.h"
#include "support/plugins.h"
#include "toposcope/plugin.h"

namespace toposcope {
namespace {

namespace fs = std::filesystem;

struct SourceFolder {
  PluginKind kind;
  std::string id;
  fs::path path;
};

std::vector<SourceFolder> source_folders() {
  std::vector<SourceFolder> folders;
  for (const PluginKind kind : plugin_kinds)
    for (const auto& entry : fs::directory_iterator(fs::path(TOPOSCOPE_SOURCE_DIR) / "plugins" / to_string(kind)))
      if (entry.is_directory()) folders.push_back({kind, entry.path().filename().string(), entry.path()});
  return folders;
}

template <class T>
T at(const std::vector<char>& bytes, std::size_t offset) {
  T value;
  std::memcpy(&value, bytes.data() + offset, sizeof value);
  return value;
}

/// Names that a 64-bit ELF library defines for others (Boost's library_info lists the undefined ones too).
std::vector<std::string> exported_symbols(const fs::path& library) {
  std::ifstream stream(library, std::ios::binary);
  const std::vector<char> bytes(std::istreambuf_iterator<char>(stream), {});
  const auto header = at<Elf64_Ehdr>(bytes, 0);
  const auto section = [&](std::size_t i) { return at<Elf64_Shdr>(bytes, header.e_shoff + i * sizeof(Elf64_Shdr)); };
  std::vector<std::string> names;
  for (std::size_t i = 0; i < header.e_shnum; ++i) {
    if (section(i).sh_type != SHT_DYNSYM) continue;
    const auto text = section(section(i).sh_link);
    for (std::size_t j = 0; j < section(i).sh_size / sizeof(Elf64_Sym); ++j) {
      const auto symbol = at<Elf64_Sym>(bytes, section(i).sh_offset + j * sizeof(Elf64_Sym));
      if (symbol.st_shndx != SHN_UNDEF && ELF64_ST_BIND(symbol.st_info) != STB_LOCAL)
        names.emplace_back(bytes.data() + text.sh_offset + symbol.st_name);
    }
  }
  return names;
}

TEST(PluginHouse, EveryPluginHasSourcePageAndTest) {
  const auto folders = source_folders();
  ASSERT_FALSE(folders.empty());
  for (const auto& [kind, id, path] : folders) {
    const fs::path test = fs::path(TOPOSCOPE_SOURCE_DIR) / "tests" / "plugins" / to_string(kind) / (id + "_test.cpp");
    for (const fs::path& file : {path / (id + ".cpp"), path / "CMakeLists.txt", path / (id + ".md"), test})
      EXPECT_TRUE(fs::is_regular_file(file)) << file << " is missing";
  }
}

TEST(PluginHouse, EveryPluginIsBuiltAndLoads) {
  for (const auto& [kind, id, path] : source_folders())
    EXPECT_NO_THROW(test::host().load(kind, id)) << path << " is not in the build, or cannot be loaded";
  for (const PluginProblem& problem : test::host().catalog().problems())
    ADD_FAILURE() << problem.file << ": " << problem.message;
}

TEST(PluginHouse, PagesTellWhatTheDescriptorsSay) {
  int tables = 0;
  for (const auto& [kind, id, path] : source_folders()) {
    const fs::path file = path / (id + ".md");
    std::ifstream stream(file);
    const std::string page(std::istreambuf_iterator<char>(stream), {});
    try {
      EXPECT_EQ(page, with_tables(page, test::host().catalog().require(kind, id)))
          << file << ": `make pages` renews it";
      tables += page.find("<!-- table: options -->") != page.npos;
    } catch (const UsageError& error) {
      ADD_FAILURE() << file << ": " << error.what();
    }
  }
  EXPECT_GT(tables, 0);
}

TEST(PluginHouse, EveryLibraryExportsOneSymbol) {
  int libraries = 0;
  for (const PluginKind kind : plugin_kinds) {
    for (const PluginManifest* plugin : test::host().catalog().all(kind)) {
      ++libraries;
      EXPECT_THAT(exported_symbols(plugin->library), ::testing::ElementsAre(TOPOSCOPE_PLUGIN_SYMBOL))
          << plugin->library;
    }
  }
  EXPECT_GT(libraries, 0);
}

}  // namespace
}  // namespace toposcope
