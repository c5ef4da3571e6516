// SPDX-License-Identifier: BSD-3-Clause
#include "io/soup_builder.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

#include "base/errors.h"

namespace toposcope {
namespace {

constexpr std::int64_t largest_index = std::numeric_limits<Index>::max() - 1;

/// How well a quad is cut into the triangles abc and acd: negative where one of them is folded over (the quad is
/// concave at b or d), and higher for a shorter cut.
double quality_of_cut(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Vec3 first = (b - a).cross(c - a), second = (c - a).cross(d - a);
  const double cut = (c - a).squaredNorm();
  return first.dot(second) < 0 ? -1 : 1 / (1 + cut / ((b - d).squaredNorm() + std::numeric_limits<double>::min()));
}

/// The fan cuts quads from their first corner, whichever that is; take the other cut where it is clearly better.
void improve_quads(TriangleSoup& soup) {
  constexpr double clearly = 1.001;  // a square keeps the cut of the fan, whatever its rounding
  const auto& origin = soup.face_origin;
  for (std::size_t f = 0; f + 1 < origin.size(); ++f) {
    const bool quad = origin[f] == origin[f + 1] && (f == 0 || origin[f - 1] != origin[f]) &&
                      (f + 2 == origin.size() || origin[f + 2] != origin[f]);
    if (!quad) continue;
    const auto [a, b, c] = soup.triangles[f];
    const Index d = soup.triangles[f + 1][2];
    const auto& p = soup.positions;
    const double as_is = quality_of_cut(p[a], p[b], p[c], p[d]), other = quality_of_cut(p[b], p[c], p[d], p[a]);
    if (other <= (as_is < 0 ? as_is : as_is * clearly)) continue;
    soup.triangles[f] = {b, c, d};
    soup.triangles[f + 1] = {b, d, a};
  }
}

}  // namespace

void fail_at(const std::string& file, MeshFilePlace place, const std::string& message) {
  if (place.unit == MeshFilePlace::Unit::line)
    throw MeshError(file + ":" + std::to_string(place.number) + ": " + message);
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
  soup_.positions.reserve(positions);
  soup_.triangles.reserve(triangles);
  soup_.face_origin.reserve(triangles);
}

void SoupBuilder::add_position(const Vec3& position, MeshFilePlace place) {
  if (!position.allFinite())
    fail_at(file_, place,
            "vertex " + std::to_string(soup_.positions.size()) +
                " (from 0) has a coordinate that is not a finite number; remove or repair it");
  soup_.positions.push_back(position);
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
  improve_quads(soup_);
  return std::move(soup_);
}

}  // namespace toposcope
