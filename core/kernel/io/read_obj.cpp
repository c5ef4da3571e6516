// SPDX-License-Identifier: BSD-3-Clause
#include "io/readers.h"
#include "io/text_cursor.h"

namespace toposcope {
namespace {

/// `v`, `v/vt`, `v//vn` or `v/vt/vn`, counted from 1 or, negative, back from the last position read.
std::int64_t corner(const TextCursor& text, std::string_view word, std::size_t positions) {
  const std::int64_t index = text.integer(word.substr(0, word.find('/')), "a vertex index");
  if (index > 0) return index - 1;
  const auto count = static_cast<std::int64_t>(positions);
  if (index < 0 && -index <= count) return count + index;
  text.fail("vertex index " + std::to_string(index) + " does not exist after " + std::to_string(positions) +
            " vertices; OBJ counts from 1, or back from -1");
}

}  // namespace

TriangleSoup read_obj(const FileText& file) {
  TextCursor text(file.name, file.bytes, {.comments = true, .continuations = true});
  SoupBuilder builder(file.name);
  std::vector<std::int64_t> corners;
  while (text.find_word()) {
    const MeshFilePlace place = text.place();
    const std::string_view keyword = text.word();
    if (keyword == "v" || keyword == "V") {
      Vec3 position;
      for (double& coordinate : position) {
        const std::string_view word = text.word();
        if (word.empty()) text.fail("a vertex needs three coordinates; complete the line");
        coordinate = text.number(word, "a coordinate");
      }
      builder.add_position(position, place);
    } else if (keyword == "f" || keyword == "F" || keyword == "fo") {
      corners.clear();
      for (std::string_view word = text.word(); !word.empty(); word = text.word())
        corners.push_back(corner(text, word, builder.position_count()));
      builder.add_face(corners, place);
    }
    text.skip_line();
  }
  return builder.finish();
}

}  // namespace toposcope
