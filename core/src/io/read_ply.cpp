// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <bit>
#include <cmath>

#include "io/ply_header.h"
#include "io/readers.h"
#include "io/text_cursor.h"

namespace toposcope {
namespace {

class AsciiSource {
 public:
  AsciiSource(const std::string& file, std::string_view body, std::size_t line) : text_(file, body, {}, line) {}
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

template <bool swapped>
class BinarySource {
 public:
  BinarySource(const std::string& file, std::string_view bytes, std::size_t begin)
      : file_(file), bytes_(bytes), at_(begin) {}
  MeshFilePlace place() const { return {at_, MeshFilePlace::Unit::byte}; }
  static std::size_t size(PlyScalar type) { return ply_scalar_size(type); }
  std::size_t room() const { return bytes_.size() - at_; }

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
    std::array<char, sizeof(T)> copy;
    std::copy_n(bytes_.data() + at_, sizeof(T), copy.begin());
    if constexpr (swapped) std::reverse(copy.begin(), copy.end());
    at_ += sizeof(T);
    return std::bit_cast<T>(copy);
  }
  [[noreturn]] void cut_short() const { fail_at(file_, place(), "the file ends within its data; it is cut short"); }

  const std::string& file_;
  std::string_view bytes_;
  std::size_t at_;
};

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

template <class Source>
void read_vertices(const FileText& file, Source& source, const PlyElement& element, SoupBuilder& builder) {
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

template <class Source>
void read_faces(const FileText& file, Source& source, const PlyElement& element, SoupBuilder& builder) {
  std::vector<std::int64_t> corners;
  for (std::size_t i = 0; i < element.count; ++i) {
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
    } else if (element.name == "face") {
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
    return read_body(file, header, AsciiSource(file.name, file.bytes.substr(header.size), header.lines + 1));
  if ((header.format == PlyFormat::binary_little) == (std::endian::native == std::endian::little))
    return read_body(file, header, BinarySource<false>(file.name, file.bytes, header.size));
  return read_body(file, header, BinarySource<true>(file.name, file.bytes, header.size));
}

}  // namespace toposcope
