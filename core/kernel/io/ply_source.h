// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>

#include "io/ply_header.h"
#include "io/text_cursor.h"

namespace toposcope {

template <class T, bool swapped>
T ply_load(const char* bytes) {
  std::array<char, sizeof(T)> copy;
  std::memcpy(copy.data(), bytes, sizeof(T));
  if constexpr (swapped) std::reverse(copy.begin(), copy.end());
  return std::bit_cast<T>(copy);
}

/// Gives the data of a PLY file number by number. Both sources have the same functions.
class PlyAsciiSource {
 public:
  static constexpr bool is_binary = false;
  PlyAsciiSource(const std::string& file, std::string_view body, std::size_t line) : text_(file, body, {}, line) {}
  /// Of what comes next, which may be on a later line.
  MeshFilePlace place() {
    text_.find_word();
    return text_.place();
  }
  double real(PlyScalar) { return text_.need_number("a number"); }
  std::int64_t integer(PlyScalar, std::string_view what) { return text_.need_integer(what); }
  void skip(PlyScalar, std::size_t count) {
    while (count-- > 0) text_.need_word("a number");
  }
  /// Room is counted in numbers: a digit and a space each, the last one without.
  static std::size_t size(PlyScalar) { return 1; }
  std::size_t room() const { return text_.bytes_left() / 2 + 1; }

 private:
  TextCursor text_;
};

/// \tparam swapped  the file's bytes are in the other order than the machine's
template <bool swapped>
class PlyBinarySource {
 public:
  static constexpr bool is_binary = true, is_swapped = swapped;
  PlyBinarySource(const std::string& file, std::string_view bytes, std::size_t begin)
      : file_(file), bytes_(bytes), at_(begin) {}
  MeshFilePlace place() const { return {at_, MeshFilePlace::Unit::byte}; }
  static std::size_t size(PlyScalar type) { return ply_scalar_size(type); }
  std::size_t room() const { return bytes_.size() - at_; }

  /// What is left, for those who take many rows at once.
  std::string_view rest() const { return bytes_.substr(at_); }
  void advance(std::size_t bytes) { at_ += bytes; }

  double real(PlyScalar type) {
    switch (type) {
      case PlyScalar::int8:
        return load<std::int8_t>();
      case PlyScalar::uint8:
        return load<std::uint8_t>();
      case PlyScalar::int16:
        return load<std::int16_t>();
      case PlyScalar::uint16:
        return load<std::uint16_t>();
      case PlyScalar::int32:
        return load<std::int32_t>();
      case PlyScalar::uint32:
        return load<std::uint32_t>();
      case PlyScalar::float32:
        return load<float>();
      case PlyScalar::float64:
        break;
    }
    return load<double>();
  }
  std::int64_t integer(PlyScalar type, std::string_view what) {
    const double value = real(type);
    if (!(std::abs(value) < 9e15) || value != std::floor(value))
      fail_at(file_, place(), "expected " + std::string(what) + ", a whole number, but found " + std::to_string(value));
    return static_cast<std::int64_t>(value);
  }
  void skip(PlyScalar type, std::size_t count) {
    if (count > room() / size(type)) cut_short();
    at_ += count * size(type);
  }

 private:
  template <class T>
  T load() {
    if (room() < sizeof(T)) cut_short();
    const T value = ply_load<T, swapped>(bytes_.data() + at_);
    at_ += sizeof(T);
    return value;
  }
  [[noreturn]] void cut_short() const { fail_at(file_, place(), "the file ends within its data; it is cut short"); }

  const std::string& file_;
  std::string_view bytes_;
  std::size_t at_;
};

}  // namespace toposcope
