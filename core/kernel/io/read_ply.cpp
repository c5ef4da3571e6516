// SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <bit>
#include <optional>

#include "io/ply_header.h"
#include "io/ply_source.h"
#include "io/readers.h"

namespace toposcope {
namespace {

/// The number of entries of a list, at most as many as the rest of the file could hold.
template <class Source>
std::size_t list_size(const FileText& file, Source& source, const PlyProperty& list) {
  const MeshFilePlace place = source.place();
  const std::int64_t size = source.integer(list.count_type, "the length of a list");
  if (size < 0 || static_cast<std::size_t>(size) > source.room() / Source::size(list.type))
    fail_at(file.name, place,
            "a list '" + list.name + "' of " + std::to_string(size) +
                " entries, more than the rest of the file could hold; it is damaged or cut short");
  return static_cast<std::size_t>(size);
}

template <class Source>
void skip_property(const FileText& file, Source& source, const PlyProperty& property) {
  source.skip(property.type, property.is_list ? list_size(file, source, property) : 1);
}

/// Takes all vertices at once where their rows have a fixed size and the coordinates one floating type, as nearly all
/// programs write them.
template <class Source>
bool take_vertices(Source& source, const PlyElement& element, SoupBuilder& builder) {
  if constexpr (!Source::is_binary) {
    return false;
  } else {
    std::size_t stride = 0;
    std::array<std::size_t, 3> offsets{};
    std::optional<PlyScalar> type;
    for (const PlyProperty& property : element.properties) {
      if (property.is_list) return false;
      if (property.axis >= 0) {
        if (type.value_or(property.type) != property.type) return false;
        type = property.type;
        offsets[static_cast<std::size_t>(property.axis)] = stride;
      }
      stride += Source::size(property.type);
    }
    const char* rows = source.rest().data();
    const std::size_t first_byte = source.place().number;
    const auto take = [&]<class T>(T) {
      const auto coordinate = [&](const char* row, std::size_t axis) -> double {
        return ply_load<T, Source::is_swapped>(row + offsets[axis]);
      };
      builder.add_positions(
          element.count,
          [&](std::size_t i) {
            const char* row = rows + i * stride;
            return Vec3(coordinate(row, 0), coordinate(row, 1), coordinate(row, 2));
          },
          [&](std::size_t i) {
            return MeshFilePlace{first_byte + i * stride, MeshFilePlace::Unit::byte};
          });
    };
    if (type == PlyScalar::float32)
      take(float{});
    else if (type == PlyScalar::float64)
      take(double{});
    else
      return false;
    source.advance(element.count * stride);
    return true;
  }
}

template <class Source>
void read_vertices(const FileText& file, Source& source, const PlyElement& element, SoupBuilder& builder) {
  if (take_vertices(source, element, builder)) return;
  for (std::size_t i = 0; i < element.count; ++i) {
    const MeshFilePlace place = source.place();
    Vec3 position = Vec3::Zero();
    for (const PlyProperty& property : element.properties) {
      if (property.axis >= 0)
        position[property.axis] = source.real(property.type);
      else
        skip_property(file, source, property);
    }
    builder.add_position(position, place);
  }
}

/// Takes as many of the next faces as are triangles of a byte and three 32-bit indices, with a fixed size behind.
template <class Source>
std::size_t take_triangles(Source& source, const PlyElement& element, std::size_t count, SoupBuilder& builder) {
  if constexpr (!Source::is_binary) {
    return 0;
  } else {
    const PlyProperty& list = element.properties.front();
    if (Source::is_swapped || !list.is_corners || Source::size(list.count_type) != 1 ||
        (list.type != PlyScalar::int32 && list.type != PlyScalar::uint32))
      return 0;
    std::size_t stride = 1 + sizeof(Triangle);
    for (const PlyProperty& property : std::span(element.properties).subspan(1)) {
      if (property.is_list) return 0;
      stride += Source::size(property.type);
    }
    if (count > source.room() / stride) return 0;  // the file is cut short: row by row, to the place where it ends
    const std::size_t taken = builder.add_triangle_rows(source.rest(), stride, count, source.place().number);
    source.advance(taken * stride);
    return taken;
  }
}

/// The triangles of strips, of alternating sense; a negative corner begins a new strip. Those that repeat a corner only
/// join strips.
void add_strips(std::span<const std::int64_t> corners, MeshFilePlace place, SoupBuilder& builder) {
  std::size_t begin = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (corners[i] < 0) begin = i + 1;
    if (i < begin + 2) continue;
    std::array<std::int64_t, 3> t = {corners[i - 2], corners[i - 1], corners[i]};
    if ((i - begin) % 2 == 1) std::swap(t[0], t[1]);
    if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) builder.add_face(t, place);
  }
}

template <class Source>
void read_faces(const FileText& file, Source& source, const PlyElement& element, SoupBuilder& builder) {
  std::vector<std::int64_t> corners;
  const bool strips = element.name == "tristrips";
  for (std::size_t i = 0; i < element.count; ++i) {
    if (!strips) i += take_triangles(source, element, element.count - i, builder);
    if (i == element.count) break;
    MeshFilePlace place = source.place();
    for (const PlyProperty& property : element.properties) {
      if (!property.is_corners) {
        skip_property(file, source, property);
        continue;
      }
      corners.resize(list_size(file, source, property));
      place = source.place();
      for (std::int64_t& corner : corners) corner = source.integer(property.type, "a vertex index");
    }
    if (strips)
      add_strips(corners, place, builder);
    else
      builder.add_face(corners, place);
  }
}

template <class Source>
TriangleSoup read_body(const FileText& file, const PlyHeader& header, Source source) {
  SoupBuilder builder(file.name);
  for (const PlyElement& element : header.elements) {
    if (element.properties.empty()) continue;
    std::size_t least = 0;  // room for one row
    for (const PlyProperty& p : element.properties) least += Source::size(p.is_list ? p.count_type : p.type);
    if (element.count > source.room() / least)
      fail_at(file.name, {element.line, MeshFilePlace::Unit::line},
              "the header announces " + std::to_string(element.count) + " rows of '" + element.name +
                  "', more than the file could hold; the header is wrong or the file cut short");
    if (element.name == "vertex") {
      builder.reserve(element.count, 0);
      read_vertices(file, source, element, builder);
    } else if (element.name == "face" || element.name == "tristrips") {
      builder.reserve(0, element.count);
      read_faces(file, source, element, builder);
    } else {
      for (std::size_t i = 0; i < element.count; ++i)
        for (const PlyProperty& property : element.properties) skip_property(file, source, property);
    }
  }
  return builder.finish();
}

}  // namespace

TriangleSoup read_ply(const FileText& file) {
  const PlyHeader header = read_ply_header(file);
  if (header.format == PlyFormat::ascii)
    return read_body(file, header, PlyAsciiSource(file.name, file.bytes.substr(header.size), header.lines + 1));
  if ((header.format == PlyFormat::binary_little) == (std::endian::native == std::endian::little))
    return read_body(file, header, PlyBinarySource<false>(file.name, file.bytes, header.size));
  return read_body(file, header, PlyBinarySource<true>(file.name, file.bytes, header.size));
}

}  // namespace toposcope
