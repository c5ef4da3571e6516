// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <bit>
#include <cctype>
#include <limits>

#include "io/readers.h"
#include "io/text_cursor.h"

namespace toposcope {
namespace {

constexpr std::size_t header_size = 80, facet_size = 50;

template <class T>
T little_endian(const char* bytes) {
  std::array<char, sizeof(T)> copy;
  std::copy_n(bytes, sizeof(T), copy.begin());
  if constexpr (std::endian::native == std::endian::big) std::reverse(copy.begin(), copy.end());
  return std::bit_cast<T>(copy);
}

/// Gives equal positions the same vertex, numbered in order of appearance. Open addressing: one array of indices.
class Welder {
 public:
  /// \param facets  about how many: a closed surface has half as many vertices, and a small table stays in the cache
  Welder(SoupBuilder& builder, std::size_t facets) : builder_(builder) {
    slots_.assign(std::bit_ceil(std::max<std::size_t>(facets, 8)), empty);
  }

  std::int64_t vertex(const Vec3& given, MeshFilePlace place) {
    const Vec3 position = given + Vec3::Zero();  // -0 becomes 0
    if (2 * builder_.position_count() >= slots_.size()) grow();
    Index& slot = find(position);
    if (slot == empty) {
      slot = static_cast<Index>(builder_.position_count());
      builder_.add_position(position, place);
    }
    return slot;
  }

 private:
  static constexpr Index empty = std::numeric_limits<Index>::max();

  Index& find(const Vec3& position) {
    std::uint64_t hash = 0;
    for (double coordinate : position) {  // SplitMix64's finalizer
      hash += std::bit_cast<std::uint64_t>(coordinate) + 0x9e3779b97f4a7c15;
      hash = (hash ^ (hash >> 30)) * 0xbf58476d1ce4e5b9;
      hash = (hash ^ (hash >> 27)) * 0x94d049bb133111eb;
      hash ^= hash >> 31;
    }
    std::size_t i = hash & (slots_.size() - 1);
    while (slots_[i] != empty && builder_.position(slots_[i]) != position) i = (i + 1) & (slots_.size() - 1);
    return slots_[i];
  }

  void grow() {
    slots_.assign(2 * slots_.size(), empty);
    for (Index v = 0; v < builder_.position_count(); ++v) find(builder_.position(v)) = v;
  }

  SoupBuilder& builder_;
  std::vector<Index> slots_;
};

TriangleSoup read_binary(const FileText& file) {
  const std::string_view bytes = file.bytes;
  std::size_t facets = little_endian<std::uint32_t>(bytes.data() + header_size);
  const std::size_t held = (bytes.size() - header_size - 4) / facet_size;
  // Programs that write as they go leave the count as it was, at 0 or at its greatest: the size tells better.
  constexpr std::size_t unknown = std::numeric_limits<std::uint32_t>::max();
  if ((bytes.size() - header_size - 4) % facet_size == 0 && (facets < held || facets == unknown)) facets = held;
  if (facets > held)
    fail_at(file.name, {header_size, MeshFilePlace::Unit::byte},
            "the header announces " + std::to_string(facets) + " facets but the file holds " + std::to_string(held) +
                "; it is cut short, or not an STL file");
  SoupBuilder builder(file.name);
  builder.reserve(facets / 2, facets);
  Welder welder(builder, facets);
  for (std::size_t f = 0; f < facets; ++f) {
    std::size_t at = header_size + 4 + f * facet_size + 12;  // after the normal
    const MeshFilePlace place{at, MeshFilePlace::Unit::byte};
    std::array<std::int64_t, 3> corners{};
    for (std::int64_t& corner : corners) {
      Vec3 position;
      for (double& coordinate : position) {
        coordinate = little_endian<float>(bytes.data() + at);
        at += 4;
      }
      corner = welder.vertex(position, place);
    }
    builder.add_face(corners, place);
  }
  return builder.finish();
}

std::string lower(std::string_view word) {
  std::string result(word);
  for (char& c : result) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return result;
}

TriangleSoup read_ascii(const FileText& file) {
  TextCursor text(file.name, file.bytes, {});
  SoupBuilder builder(file.name);
  Welder welder(builder, file.bytes.size() / 256);
  std::vector<std::int64_t> corners;
  bool in_facet = false;
  while (text.find_word()) {
    const MeshFilePlace place = text.place();
    const std::string_view word = text.word();
    const std::string keyword = lower(word.substr(0, 16));
    if (keyword == "vertex" && in_facet) {
      Vec3 position;
      for (double& coordinate : position) coordinate = text.need_number("a coordinate");
      corners.push_back(welder.vertex(position, place));
    } else if (keyword == "facet" && !in_facet) {
      in_facet = true;
      corners.clear();
      text.skip_line();  // the normal follows from the corners
    } else if (keyword == "endfacet" && in_facet) {
      in_facet = false;
      builder.add_face(corners, place);
    } else if ((keyword == "solid" || keyword == "endsolid") && !in_facet) {
      text.skip_line();  // a name, which may be anything
    } else if ((keyword != "outer" && keyword != "loop" && keyword != "endloop") || !in_facet) {
      text.fail("unexpected " + quoted(word) + (in_facet ? " in" : " outside of") + " a facet; the file is damaged");
    }
  }
  if (in_facet) text.fail("the file ends within a facet; it is cut short");
  return builder.finish();
}

}  // namespace

bool is_binary_stl(std::string_view bytes) {
  return bytes.size() >= header_size + 4 &&
         (bytes.size() - header_size - 4) / facet_size == little_endian<std::uint32_t>(bytes.data() + header_size) &&
         (bytes.size() - header_size - 4) % facet_size == 0;
}

TriangleSoup read_stl(const FileText& file) {
  // Binary files may begin with "solid" as well; only the size tells for sure.
  const std::size_t first = std::min(file.bytes.find_first_not_of(" \t\r\n"), file.bytes.size());
  const bool solid = lower(file.bytes.substr(first, 5)) == "solid";
  const bool text = solid && file.bytes.substr(0, 1024).find('\0') == file.bytes.npos;
  if (!is_binary_stl(file.bytes) && (text || file.bytes.size() < header_size + 4)) {
    if (!solid)
      fail_at(file.name, {file.bytes.size(), MeshFilePlace::Unit::byte},
              "an STL file begins with 'solid' or has at least 84 bytes; it is cut short, or not an STL file");
    return read_ascii(file);
  }
  return read_binary(file);
}

}  // namespace toposcope
