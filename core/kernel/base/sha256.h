// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace toposcope {

/// SHA-256 of what is added, piece by piece.
class Sha256 {
 public:
  Sha256();
  ~Sha256();
  void add(std::string_view bytes);
  template <class T>
  void add(std::span<const T> values) {
    add(std::string_view(reinterpret_cast<const char*>(values.data()), values.size_bytes()));
  }
  /// In hexadecimal; nothing may be added after it.
  std::string hex();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Of a text, in hexadecimal.
std::string sha256_of_text(std::string_view text);

/// Of a regular file, in hexadecimal. \throw UsageError  it cannot be read
std::string sha256_of(const std::filesystem::path& file);

}  // namespace toposcope
