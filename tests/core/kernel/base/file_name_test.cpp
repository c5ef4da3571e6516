// SPDX-License-Identifier: BSD-3-Clause
#include "base/file_name.h"

#include <gtest/gtest.h>

#include <filesystem>

namespace toposcope {
namespace {

TEST(FileName, StaysInItsFolderWhateverTheTextSays) {
  const std::pair<std::string, const char*> cases[] = {{"cup", "cup"},
                                                       {"my cup 2.5", "my cup 2.5"},
                                                       {"Tüte", "Tüte"},
                                                       {"", "_"},
                                                       {".", "_"},
                                                       {"..", "_."},
                                                       {"../../etc/x", "_._.._etc_x"},
                                                       {"/abs", "_abs"},
                                                       {".hidden", "_hidden"},
                                                       {"a\\b:c", "a_b_c"},
                                                       {"a#b?c%d", "a_b_c_d"},
                                                       {"a\nb\x1b[2J", "a_b_[2J"},
                                                       {"caf\xe9", "caf_"},
                                                       {std::string("a\0b", 3), "a_b"}};
  for (const auto& [text, name] : cases) {
    EXPECT_EQ(file_name(text), name) << text;
    EXPECT_EQ(std::filesystem::path(file_name(text)).filename(), file_name(text)) << text;
  }
  EXPECT_EQ(file_name(std::string(300, 'x')).size(), 200U);
  EXPECT_EQ(file_name(std::string(199, 'x') + "ü"), std::string(199, 'x')) << "no half characters";
}

}  // namespace
}  // namespace toposcope
