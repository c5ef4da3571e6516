// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <bit>

#include "io/readers.h"
#include "io/text_cursor.h"

namespace toposcope {
namespace {

bool is_number(std::string_view word) {
  return !word.empty() && word.find_first_not_of("+-.0123456789eE") == word.npos;
}

/// A count that the rest of the file could hold, at two bytes a number.
std::size_t count(const TextCursor& text, std::string_view word, std::string_view what, std::size_t numbers_each) {
  const std::int64_t value = text.integer(word, what);
  if (value < 0 || static_cast<std::size_t>(value) > text.bytes_left() / (2 * numbers_each) + 1)
    text.fail("the header announces " + std::to_string(value) + " as " + std::string(what) + " but only " +
              std::to_string(text.bytes_left()) + " bytes follow; the header is wrong or the file cut short");
  return static_cast<std::size_t>(value);
}

/// What stands before the counts.
struct Keyword {
  std::string_view first_count;  ///< which may be glued to the keyword
  std::string_view prefix;       ///< "CN" of CNOFF: what follows each position
  bool binary = false;
};

/// Reads past the keyword, which may be left out.
Keyword keyword(TextCursor& text) {
  const std::string_view word = text.need_word("OFF");
  if (is_number(word)) return {word, {}};
  const std::size_t off = word.find("OFF");
  if (off == word.npos || word.substr(0, off).find_first_not_of("STCN4n") != word.npos)
    text.fail("expected OFF but found " + quoted(word) + "; is this an OFF file?");
  if (word.substr(0, off).find_first_of("4n") != word.npos)
    text.fail("positions in four or n dimensions (" + quoted(word) + ") are not supported; write them in three");
  const std::string_view prefix = word.substr(0, off);
  if (word.size() > off + 3) return {word.substr(off + 3), prefix};
  const std::string_view next = text.need_word("the number of vertices");
  return {next, prefix, next == "BINARY"};
}

/// Numbers of 32 bits.
class BinaryNumbers {
 public:
  BinaryNumbers(const FileText& file, std::size_t begin, std::endian order) : file_(file), at_(begin), order_(order) {}
  MeshFilePlace place() const { return {at_, MeshFilePlace::Unit::byte}; }
  float real() { return std::bit_cast<float>(word()); }
  std::int32_t integer() { return std::bit_cast<std::int32_t>(word()); }
  void skip(std::size_t numbers) { at_ += std::min(4 * numbers, file_.bytes.size() - at_); }
  /// A count of things of so many numbers each, that the rest of the file could hold.
  std::size_t count(const std::string& what, std::size_t numbers_each) {
    const MeshFilePlace here = place();
    const std::int32_t value = integer();
    const std::size_t rest = file_.bytes.size() - at_;
    if (value < 0 || static_cast<std::size_t>(value) > rest / (4 * numbers_each))
      fail_at(file_.name, here,
              std::to_string(value) + " as " + what + ", but only " + std::to_string(rest) +
                  " bytes follow; the file is damaged or cut short");
    return static_cast<std::size_t>(value);
  }

 private:
  std::uint32_t word() {
    if (file_.bytes.size() - at_ < 4) fail_at(file_.name, place(), "the file ends within its data; it is cut short");
    const char* bytes = file_.bytes.data() + at_;
    at_ += 4;
    std::uint32_t value = 0;
    for (int i = 0; i < 4; ++i)
      value = value << 8 | static_cast<unsigned char>(bytes[order_ == std::endian::big ? i : 3 - i]);
    return value;
  }

  const FileText& file_;
  std::size_t at_;
  std::endian order_;
};

/// Whether the counts of vertices and faces, in this order of bytes, are such as the file could hold.
bool counts_fit(const FileText& file, std::size_t begin, std::endian order) {
  BinaryNumbers numbers(file, begin, order);
  const double vertices = numbers.integer(), faces = numbers.integer();
  return vertices >= 0 && faces >= 0 && 12 * vertices + 4 * faces <= static_cast<double>(file.bytes.size());
}

/// Big-endian, as Geomview defines it; or little-endian and without colours, as pmp-library writes it.
TriangleSoup read_binary(const FileText& file, std::size_t begin, std::string_view prefix) {
  const auto has = [&](char c) { return prefix.find(c) != prefix.npos; };
  const std::size_t more = (has('N') ? 3U : 0U) + (has('C') ? 4U : 0U) + (has('S') ? 2U : 0U);
  const bool little = file.bytes.size() - begin >= 8 && !counts_fit(file, begin, std::endian::big) &&
                      counts_fit(file, begin, std::endian::little);
  BinaryNumbers numbers(file, begin, little ? std::endian::little : std::endian::big);
  const std::size_t vertices = numbers.count("the number of vertices", 3 + more);
  const std::size_t faces = numbers.count("the number of faces", 1);
  numbers.skip(1);  // edges
  SoupBuilder builder(file.name);
  builder.reserve(vertices, faces);
  for (std::size_t v = 0; v < vertices; ++v) {
    const MeshFilePlace place = numbers.place();
    Vec3 position;
    for (double& coordinate : position) coordinate = numbers.real();
    builder.add_position(position, place);
    numbers.skip(more);
  }
  std::vector<std::int64_t> corners;
  for (std::size_t f = 0; f < faces; ++f) {
    const MeshFilePlace place = numbers.place();
    corners.resize(numbers.count("the number of corners of a face", 1));
    for (std::int64_t& corner : corners) corner = numbers.integer();
    builder.add_face(corners, place);
    if (!little) numbers.skip(numbers.count("the number of colour components", 1));
  }
  return builder.finish();
}

}  // namespace

TriangleSoup read_off(const FileText& file) {
  TextCursor text(file.name, file.bytes, {.comments = true, .continuations = false});
  const Keyword header = keyword(text);
  if (header.binary) {
    text.skip_line();
    return read_binary(file, file.bytes.size() - text.bytes_left(), header.prefix);
  }
  const std::size_t vertices = count(text, header.first_count, "the number of vertices", 3);
  const std::string_view second = text.need_word("the number of faces");
  const std::size_t faces = count(text, second, "the number of faces", 1);
  text.skip_line();  // the number of edges, which may be left out and means nothing

  SoupBuilder builder(file.name);
  builder.reserve(vertices, faces);
  for (std::size_t v = 0; v < vertices; ++v) {
    Vec3 position;
    for (double& coordinate : position) coordinate = text.need_number("a coordinate");
    builder.add_position(position, text.place());
    text.skip_line();  // normal, colour, texture coordinates
  }
  std::vector<std::int64_t> corners;
  for (std::size_t f = 0; f < faces; ++f) {
    const std::int64_t size = text.need_integer("the number of corners of a face");
    if (size < 0 || static_cast<std::size_t>(size) > text.bytes_left() / 2 + 1)
      text.fail("a face of " + std::to_string(size) + " corners, more than the rest of the file could hold");
    corners.resize(static_cast<std::size_t>(size));
    const MeshFilePlace place = text.place();
    for (std::int64_t& corner : corners) corner = text.need_integer("a vertex index");
    builder.add_face(corners, place);
    text.skip_line();  // colour
  }
  return builder.finish();
}

}  // namespace toposcope
