// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

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

/// Reads past the keyword, which may be left out, and returns the first count, which may be glued to it.
std::string_view first_count(TextCursor& text) {
  const std::string_view word = text.need_word("OFF");
  if (is_number(word)) return word;
  const std::size_t off = word.find("OFF");
  if (off == word.npos || word.substr(0, off).find_first_not_of("STCN4n") != word.npos)
    text.fail("expected OFF but found " + quoted(word) + "; is this an OFF file?");
  if (word.substr(0, off).find_first_of("4n") != word.npos)
    text.fail("positions in four or n dimensions (" + quoted(word) + ") are not supported; write them in three");
  if (word.size() > off + 3) return word.substr(off + 3);
  const std::string_view next = text.need_word("the number of vertices");
  if (next == "BINARY") text.fail("binary OFF is not supported; save the mesh as PLY");
  return next;
}

}  // namespace

TriangleSoup read_off(const FileText& file) {
  TextCursor text(file.name, file.bytes, {.comments = true, .continuations = false});
  const std::size_t vertices = count(text, first_count(text), "the number of vertices", 3);
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
