// SPDX-License-Identifier: BSD-3-Clause
#include <Eigen/Geometry>
#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <limits>
#include <string>

#include "base/errors.h"
#include "io/extension.h"
#include "io/mesh_io.h"

namespace toposcope {
namespace {

template <class T>
void append_little_endian(std::string& out, T value) {
  auto bytes = std::bit_cast<std::array<char, sizeof(T)>>(value);
  if constexpr (std::endian::native == std::endian::big) std::reverse(bytes.begin(), bytes.end());
  out.append(bytes.data(), bytes.size());
}

/// The shortest text that reads back as the same number.
template <class T>
void append_number(std::string& out, T value) {
  std::array<char, 32> digits;
  const auto [end, error] = std::to_chars(digits.data(), digits.data() + digits.size(), value);
  out.append(digits.data(), end);
}

void append_row(std::string& out, const Vec3& position) {
  for (int i = 0; i < 3; ++i) {
    if (i > 0) out += ' ';
    append_number(out, position[i]);
  }
  out += '\n';
}

std::string ply(std::span<const Vec3> positions, std::span<const Triangle> triangles,
                const FaceAttributes& attributes) {
  std::string out = "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(positions.size()) +
                    "\nproperty double x\nproperty double y\nproperty double z\nelement face " +
                    std::to_string(triangles.size()) + "\nproperty list uchar int vertex_indices\n";
  if (!attributes.colors.empty()) out += "property uchar red\nproperty uchar green\nproperty uchar blue\n";
  if (!attributes.labels.empty()) out += "property int label\n";
  if (!attributes.input_faces.empty()) out += "property int input_face\n";
  out += "end_header\n";
  out.reserve(out.size() + 24 * positions.size() + 24 * triangles.size());
  for (const Vec3& p : positions)
    for (double coordinate : p) append_little_endian(out, coordinate);
  for (std::size_t f = 0; f < triangles.size(); ++f) {
    out += '\3';
    for (Index v : triangles[f]) append_little_endian(out, v);
    if (!attributes.colors.empty())
      for (std::uint8_t channel : attributes.colors[f]) out += static_cast<char>(channel);
    if (!attributes.labels.empty()) append_little_endian(out, attributes.labels[f]);
    if (!attributes.input_faces.empty()) append_little_endian(out, attributes.input_faces[f]);
  }
  return out;
}

std::string obj(std::span<const Vec3> positions, std::span<const Triangle> triangles) {
  std::string out;
  for (const Vec3& p : positions) {
    out += "v ";
    append_row(out, p);
  }
  for (const Triangle& t : triangles) {
    out += 'f';
    for (Index v : t) {
      out += ' ';
      append_number(out, std::uint64_t{v} + 1);
    }
    out += '\n';
  }
  return out;
}

std::string off(std::span<const Vec3> positions, std::span<const Triangle> triangles) {
  std::string out = "OFF\n" + std::to_string(positions.size()) + ' ' + std::to_string(triangles.size()) + " 0\n";
  for (const Vec3& p : positions) append_row(out, p);
  for (const Triangle& t : triangles) {
    out += '3';
    for (Index v : t) {
      out += ' ';
      append_number(out, v);
    }
    out += '\n';
  }
  return out;
}

std::string stl(std::span<const Vec3> positions, std::span<const Triangle> triangles, const std::string& name) {
  std::string out = "toposcope";
  out.resize(80, ' ');
  out.reserve(84 + 50 * triangles.size());
  append_little_endian(out, static_cast<std::uint32_t>(triangles.size()));
  const auto append = [&](const Vec3& v) {
    for (double coordinate : v) {
      const auto single = static_cast<float>(coordinate);
      if (!std::isfinite(single)) throw MeshError(name + ": a coordinate is too large for STL; write PLY");
      append_little_endian(out, single);
    }
  };
  for (const auto& [a, b, c] : triangles) {
    append((positions[b] - positions[a]).cross(positions[c] - positions[a]).stableNormalized());
    for (Index v : {a, b, c}) append(positions[v]);
    append_little_endian(out, std::uint16_t{0});
  }
  return out;
}

/// What single precision makes of the faces, in words; empty where they keep their edges.
std::string lost_in_single_precision(std::span<const Vec3> positions, std::span<const Triangle> triangles,
                                     const std::string& name) {
  constexpr double clear = 16;  // steps between numbers: an edge as long keeps its length within some hundredths
  const auto is_lost = [&](const Vec3& a, const Vec3& b) {
    const double greatest = a.cwiseAbs().cwiseMax(b.cwiseAbs()).maxCoeff();
    const double step =
        std::max<double>(std::numeric_limits<float>::epsilon() * greatest, std::numeric_limits<float>::denorm_min());
    return a != b && (a - b).norm() < clear * step;
  };
  const auto lost = std::ranges::count_if(triangles, [&](const Triangle& t) {
    return is_lost(positions[t[0]], positions[t[1]]) || is_lost(positions[t[1]], positions[t[2]]) ||
           is_lost(positions[t[2]], positions[t[0]]);
  });
  if (lost == 0) return "";
  return name + ": STL has single precision, in which " + std::to_string(lost) + " of " +
         std::to_string(triangles.size()) +
         " faces lose their form so far from the origin or so small; write PLY, or move and scale the mesh first";
}

void check(const std::string& name, std::span<const Vec3> positions, std::span<const Triangle> triangles,
           const FaceAttributes& attributes) {
  const auto fits = [&](std::size_t count) { return count == 0 || count == triangles.size(); };
  if (!fits(attributes.colors.size()) || !fits(attributes.labels.size()) || !fits(attributes.input_faces.size()))
    throw MeshError(name + ": colours, labels and input faces must be one for each of the " +
                    std::to_string(triangles.size()) + " triangles, or none");
  for (const Triangle& t : triangles)
    for (Index v : t)
      if (v >= positions.size())
        throw MeshError(name + ": a triangle refers to vertex " + std::to_string(v) + " but there are " +
                        std::to_string(positions.size()));
}

}  // namespace

bool can_write_mesh(const std::filesystem::path& path) {
  const std::string extension = lower_extension(path);
  return extension == ".ply" || extension == ".obj" || extension == ".stl" || extension == ".off";
}

std::string write_mesh(const std::filesystem::path& path, std::span<const Vec3> positions,
                       std::span<const Triangle> triangles, const FaceAttributes& attributes) {
  const std::string name = path.string(), extension = lower_extension(path);
  check(name, positions, triangles, attributes);
  if (extension == ".ply") {
    write_file(path, ply(positions, triangles, attributes));
  } else if (extension == ".obj") {
    write_file(path, obj(positions, triangles));
  } else if (extension == ".stl") {
    write_file(path, stl(positions, triangles, name));
    return lost_in_single_precision(positions, triangles, name);
  } else if (extension == ".off") {
    write_file(path, off(positions, triangles));
  } else {
    throw UsageError(name + ": cannot write a mesh as '" + extension + "'; use .ply, .obj, .stl or .off");
  }
  return "";
}

}  // namespace toposcope
