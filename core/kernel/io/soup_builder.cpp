// SPDX-License-Identifier: BSD-3-Clause
#include "io/soup_builder.h"

#include <algorithm>
#include <cstring>
#include <limits>

#include "base/errors.h"
#include "io/cut_polygons.h"
#include "toposcope/geometry/large_array.h"

namespace toposcope {
namespace {

constexpr std::int64_t largest_index = std::numeric_limits<Index>::max() - 1;

}  // namespace

void fail_at(const std::string& file, MeshFilePlace place, const std::string& message) {
  if (place.unit == MeshFilePlace::Unit::line)
    throw MeshError(file + ":" + std::to_string(place.number) + ": " + message);
  if (place.unit == MeshFilePlace::Unit::none) throw MeshError(file + ": " + message);
  throw MeshError(file + ": byte " + std::to_string(place.number) + ": " + message);
}

std::string quoted(std::string_view text) {
  constexpr std::size_t longest = 40;
  std::string result(text.substr(0, longest));
  std::replace_if(
      result.begin(), result.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  result.insert(result.begin(), '\'');
  result += text.size() > longest ? "...'" : "'";
  return result;
}

void SoupBuilder::reserve(std::size_t positions, std::size_t triangles) {
  reserve_large(soup_.positions, positions);
  reserve_large(soup_.triangles, triangles);
  reserve_large(soup_.face_origin, triangles);
}

void SoupBuilder::fail_not_finite(std::size_t vertex, MeshFilePlace place) const {
  fail_at(file_, place,
          "vertex " + std::to_string(vertex) +
              " (from 0) has a coordinate that is not a finite number; remove or repair it");
}

void SoupBuilder::add_face(std::span<const std::int64_t> corners, MeshFilePlace place) {
  for (std::int64_t corner : corners) {
    if (corner < 0 || corner > largest_index)
      fail_at(file_, place,
              "face " + std::to_string(soup_.input_faces) + " (from 0) refers to vertex " + std::to_string(corner) +
                  " (from 0), which cannot be; the index is wrong or the file damaged");
    if (corner > greatest_corner_) {
      greatest_corner_ = corner;
      greatest_place_ = place;
    }
  }
  if (soup_.input_faces == largest_index) fail_at(file_, place, "too many faces; decimate the mesh first");
  for (std::size_t i = 2; i < corners.size(); ++i) {
    soup_.triangles.push_back(
        {static_cast<Index>(corners[0]), static_cast<Index>(corners[i - 1]), static_cast<Index>(corners[i])});
    soup_.face_origin.push_back(soup_.input_faces);
  }
  ++soup_.input_faces;
  has_polygons_ = has_polygons_ || corners.size() > 3;
}

std::size_t SoupBuilder::add_triangle_rows(std::string_view rows, std::size_t stride, std::size_t count,
                                           std::size_t first_byte) {
  constexpr std::size_t least = 1 + sizeof(Triangle);
  constexpr std::int64_t largest = std::numeric_limits<std::int32_t>::max();  // as a signed index may say
  if (rows.size() < least) return 0;
  count = std::min({count, (rows.size() - least) / stride + 1, static_cast<std::size_t>(largest - soup_.input_faces)});
  for (std::size_t i = 0; i < count; ++i) {
    const char* row = rows.data() + i * stride;
    Triangle t;
    std::memcpy(t.data(), row + 1, sizeof t);
    const std::int64_t greatest = std::max({t[0], t[1], t[2]});
    if (*row != 3 || greatest > largest) return i;
    if (greatest > greatest_corner_) {
      greatest_corner_ = greatest;
      greatest_place_ = {first_byte + i * stride + 1, MeshFilePlace::Unit::byte};
    }
    soup_.triangles.push_back(t);
    soup_.face_origin.push_back(soup_.input_faces++);
  }
  return count;
}

TriangleSoup SoupBuilder::finish() {
  if (soup_.positions.empty()) throw MeshError(file_ + ": no vertex; is this the right file?");
  if (soup_.triangles.empty())
    throw MeshError(file_ + ": " + std::to_string(soup_.positions.size()) +
                    " vertices but no face with three corners; a point cloud has to be meshed first");
  if (greatest_corner_ >= static_cast<std::int64_t>(soup_.positions.size()))
    fail_at(file_, greatest_place_,
            "a face refers to vertex " + std::to_string(greatest_corner_) + " (from 0) but the file has " +
                std::to_string(soup_.positions.size()) + " vertices; the index is wrong or the file cut short");
  if (has_polygons_) cut_polygons(soup_);
  return std::move(soup_);
}

}  // namespace toposcope
