// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// What the fuzzers of documents share.

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <string>
#include <string_view>

#include "base/errors.h"
#include "toposcope/system/temporary_folder.h"

namespace toposcope::fuzz {

/// Anything but a document or an error in the program's own words is a finding.
/// \param use  what the program does with a text
template <class Use>
int read_document(const std::uint8_t* data, std::size_t size, const Use& use) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  try {
    use(text);
  } catch (const Error& error) {
    // The fuzzer learns the words that are looked for, and gives them to names.
    constexpr std::string_view words = "json.exception";
    if (std::string_view(error.what()).find(words) == std::string_view::npos || text.find(words) != text.npos) return 0;
    std::cerr << "a library's own words: " << error.what() << '\n';
    std::abort();
  }
  return 0;
}

/// A file of that name that holds the text, in a folder of this process.
inline std::filesystem::path file_of(const char* name, const std::string& text) {
  static const struct Folder {
    std::filesystem::path path = temporary_folder("fuzz");
    ~Folder() { std::filesystem::remove_all(path); }
  } folder;
  std::filesystem::path file = folder.path / name;
  std::ofstream(file, std::ios::binary | std::ios::trunc) << text;
  return file;
}

}  // namespace toposcope::fuzz
