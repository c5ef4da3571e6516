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

/// A place in a mesh file, for messages: a line (from 1) of text, a byte (from 0) of binary data.
struct MeshFilePlace {
  enum class Unit { line, byte };
  std::size_t number = 0;
  Unit unit = Unit::line;
};

/// \throw MeshError  "file:line: message" or "file: byte n: message"
[[noreturn]] void fail_at(const std::string& file, MeshFilePlace place, const std::string& message);

/// A piece of a file in quotes, shortened and with unprintable bytes as '?', for messages.
std::string quoted(std::string_view text);

/// Collects what a mesh file says and checks it, so that every reader refuses the same things with the same words.
class SoupBuilder {
 public:
  explicit SoupBuilder(std::string file) : file_(std::move(file)) {}

  void reserve(std::size_t positions, std::size_t triangles);
  std::size_t position_count() const { return soup_.positions.size(); }

  /// \throw MeshError  not finite
  void add_position(const Vec3& position, MeshFilePlace place);
  /// A polygon, cut into a fan of triangles. Fewer than three corners make no triangle, but count as a face.
  /// Corners may lie ahead of the positions read so far.
  /// \throw MeshError  negative corner
  void add_face(std::span<const std::int64_t> corners, MeshFilePlace place);

  /// \throw MeshError  nothing read, a corner beyond the last position
  TriangleSoup finish();

 private:
  std::string file_;
  TriangleSoup soup_;
  std::int64_t greatest_corner_ = -1;
  MeshFilePlace greatest_place_;
};

}  // namespace toposcope
