// SPDX-License-Identifier: BSD-3-Clause
#include <optional>

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

/// Coordinates of vertices: three, or two of every vertex, whose z is then 0.
class ObjVertices {
 public:
  Vec3 next(TextCursor& text, const std::string& file) {
    const MeshFilePlace place = text.place();
    Vec3 position = Vec3::Zero();
    int count = 0;
    for (std::string_view word = text.word(); count < 3 && !word.empty(); word = count < 3 ? text.word() : "")
      position[count++] = text.number(word, "a coordinate");
    if (count < 2) text.fail("a vertex needs three coordinates; complete the line");
    if (count == 3) has_three_ = true;
    if (count == 2 && !first_of_two_) first_of_two_ = place;
    if (has_three_ && first_of_two_)
      fail_at(file, *first_of_two_, "a vertex needs three coordinates, or two where all have two; complete the line");
    return position;
  }

 private:
  bool has_three_ = false;
  std::optional<MeshFilePlace> first_of_two_;
};

}  // namespace

TriangleSoup read_obj(const FileText& file) {
  TextCursor text(file.name, file.bytes, {.comments = true, .continuations = true});
  SoupBuilder builder(file.name);
  ObjVertices vertices;
  std::vector<std::int64_t> corners;
  while (text.find_word()) {
    const MeshFilePlace place = text.place();
    const std::string_view keyword = text.word();
    if (keyword == "v" || keyword == "V") {
      builder.add_position(vertices.next(text, file.name), place);
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
