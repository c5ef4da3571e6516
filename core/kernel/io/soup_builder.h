// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/mesh.h"

namespace toposcope {

/// A place in a mesh file, for messages: a line (from 1) of text, a byte (from 0) of binary data; none where the
/// message names it.
struct MeshFilePlace {
  enum class Unit { line, byte, none };
  std::size_t number = 0;
  Unit unit = Unit::none;
};

/// \throw MeshError  "file:line: message", "file: byte n: message" or "file: message"
[[noreturn]] void fail_at(const std::string& file, MeshFilePlace place, const std::string& message);

/// A piece of a file in quotes, shortened and with unprintable bytes as '?', for messages.
std::string quoted(std::string_view text);

/// Collects what a mesh file says and checks it, so that every reader refuses the same things with the same words.
class SoupBuilder {
 public:
  explicit SoupBuilder(std::string file) : file_(std::move(file)) {}

  void reserve(std::size_t positions, std::size_t triangles);
  std::size_t position_count() const { return soup_.positions.size(); }

  const Vec3& position(std::size_t vertex) const { return soup_.positions[vertex]; }

  /// \throw MeshError  not finite
  void add_position(const Vec3& position, MeshFilePlace place) {
    if (!position.allFinite()) fail_not_finite(soup_.positions.size(), place);
    soup_.positions.push_back(position);
  }
  /// Many at once: `position(i)` and, where it is refused, `place(i)` for i from 0. \throw MeshError  not finite
  template <class Position, class Place>
  void add_positions(std::size_t count, Position position, Place place) {
    const std::size_t first = soup_.positions.size();
    soup_.positions.resize(first + count);
    double probe = 0;  // NaN as soon as a coordinate is not finite
    for (std::size_t i = 0; i < count; ++i) {
      const Vec3 p = position(i);
      soup_.positions[first + i] = p;
      probe += 0 * p[0] + 0 * p[1] + 0 * p[2];
    }
    if (probe == 0) return;
    for (std::size_t i = 0; i < count; ++i)
      if (!soup_.positions[first + i].allFinite()) fail_not_finite(first + i, place(i));
  }

  /// A polygon, cut into triangles. Fewer than three corners make no triangle, but count as a face.
  /// Corners may lie ahead of the positions read so far.
  /// \throw MeshError  negative corner
  void add_face(std::span<const std::int64_t> corners, MeshFilePlace place);

  /// Faces of three corners at once: rows of a byte 3 and three 32-bit indices, `stride` bytes apart.
  /// \param first_byte  of the rows in the file, for messages
  /// \return the number of rows taken; the next one is no such row, has an index too large, or is beyond `rows`
  std::size_t add_triangle_rows(std::string_view rows, std::size_t stride, std::size_t count, std::size_t first_byte);

  /// \throw MeshError  nothing read, a corner beyond the last position
  TriangleSoup finish();

 private:
  [[noreturn]] void fail_not_finite(std::size_t vertex, MeshFilePlace place) const;

  std::string file_;
  TriangleSoup soup_;
  std::int64_t greatest_corner_ = -1;
  MeshFilePlace greatest_place_;
  bool has_polygons_ = false;
};

}  // namespace toposcope
