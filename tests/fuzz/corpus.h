// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <fstream>
#include <string>

namespace toposcope::fuzz {

/// The seeds of one fuzzer: the files of a folder.
class Corpus {
 public:
  explicit Corpus(std::filesystem::path folder) : folder_(std::move(folder)) {
    std::filesystem::create_directories(folder_);
  }
  /// The file, and the same cut short and with CR LF: most readers have a branch of their own for them.
  void add(const std::string& content) {
    write(content);
    write(content.substr(0, content.size() * 3 / 4));
    std::string other = content;
    for (std::size_t i = other.find('\n'); i != other.npos; i = other.find('\n', i + 2)) other.insert(i, 1, '\r');
    write(other);
  }

 private:
  void write(const std::string& content) {
    std::ofstream(folder_ / ("seed" + std::to_string(count_++)), std::ios::binary) << content;
  }

  std::filesystem::path folder_;
  int count_ = 0;
};

/// Documents of every kind: those of the project at `source`, and made ones. Beside the seeds of a kind KIND, KIND.dict
/// has the words that its schema knows.
void add_documents(const std::filesystem::path& folder, const std::filesystem::path& source);

}  // namespace toposcope::fuzz
