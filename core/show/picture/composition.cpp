// SPDX-License-Identifier: BSD-3-Clause
#include "picture/composition.h"

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "toposcope/geometry/lines.h"

namespace toposcope {
namespace {

constexpr float crease_cosine = 0.766F;  // 40 degrees
constexpr Index around = 10;             // sides of a tube
constexpr double point_radius = 1.9;     // of a ball at a point, in tube radii

using Normal = Eigen::Vector3f;

void add(ShadedMesh& solid, const std::array<Vec3, 3>& corners, const std::array<Vec3, 3>& normals, const Rgb& color) {
  const Index first = static_cast<Index>(solid.positions.size());
  solid.positions.insert(solid.positions.end(), corners.begin(), corners.end());
  solid.triangles.push_back({first, first + 1, first + 2});
  solid.normals.push_back({normals[0].cast<float>(), normals[1].cast<float>(), normals[2].cast<float>()});
  solid.triangle_colors.push_back(color);
}

void add_tube(ShadedMesh& solid, const Vec3& tail, const Vec3& head, double radius, const Rgb& color) {
  const Vec3 along = head - tail;
  if (!(along.norm() > 0)) return;
  const Vec3 axis = along.normalized(), u = any_perpendicular(axis), v = axis.cross(u);
  const auto arm = [&](Index i) {
    const double angle = 2 * pi * (i % around) / around;
    return Vec3(std::cos(angle) * u + std::sin(angle) * v);
  };
  for (Index i = 0; i < around; ++i) {
    const Vec3 a = arm(i), b = arm(i + 1);
    add(solid, {tail + radius * a, tail + radius * b, head + radius * b}, {a, b, b}, color);
    add(solid, {tail + radius * a, head + radius * b, head + radius * a}, {a, b, a}, color);
  }
}

void add_ball(ShadedMesh& solid, const Vec3& center, double radius, const Rgb& color) {
  constexpr Index along = 6;
  const auto at = [](Index i, Index j) {
    const double angle = 2 * pi * (i % around) / around, polar = pi * j / along;
    return Vec3(std::sin(polar) * std::cos(angle), std::sin(polar) * std::sin(angle), std::cos(polar));
  };
  for (Index j = 0; j < along; ++j)
    for (Index i = 0; i < around; ++i) {
      const Vec3 a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1), d = at(i, j + 1);
      const auto place = [&](const Vec3& n) { return Vec3(center + radius * n); };
      if (j + 1 < along) add(solid, {place(a), place(d), place(c)}, {a, d, c}, color);
      if (j > 0) add(solid, {place(a), place(c), place(b)}, {a, c, b}, color);
    }
}

}  // namespace

Composition in_unit_box(Composition composition) {
  const auto for_each_point = [&](const auto& body) {
    for (ShadedMesh* solid : {&composition.surface, &composition.lines, &composition.sheets})
      for (Vec3& p : solid->positions) body(p);
  };
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for_each_point([&](const Vec3& p) { low = low.cwiseMin(p), high = high.cwiseMax(p); });
  const double diagonal = (high - low).stableNorm();
  if (!(diagonal > 0) || !std::isfinite(diagonal)) return composition;
  const Vec3 middle = low + (high - low) / 2;
  for_each_point([&](Vec3& p) { p = (p - middle) / diagonal; });
  composition.line_radius /= diagonal;
  return composition;
}

void ShadedMesh::append(const ShadedMesh& other) {
  const Index first = static_cast<Index>(positions.size());
  positions.insert(positions.end(), other.positions.begin(), other.positions.end());
  for (const Triangle& t : other.triangles) triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  normals.insert(normals.end(), other.normals.begin(), other.normals.end());
  triangle_colors.insert(triangle_colors.end(), other.triangle_colors.begin(), other.triangle_colors.end());
  vertex_colors.insert(vertex_colors.end(), other.vertex_colors.begin(), other.vertex_colors.end());
}

std::vector<std::array<Eigen::Vector3f, 3>> corner_normals(const std::vector<Vec3>& positions,
                                                           const std::vector<Triangle>& triangles) {
  std::vector<Normal> of_face(triangles.size());
  std::vector<std::array<float, 3>> angles(triangles.size());
  std::vector<std::vector<std::pair<Index, float>>> around_vertex(positions.size());  // faces and their angles
  for (Index t = 0; t < triangles.size(); ++t) {
    const Triangle& triangle = triangles[t];
    const auto corner = [&](std::size_t k) { return positions[triangle[k % 3]]; };
    const Vec3 normal = (corner(1) - corner(0)).cross(corner(2) - corner(0));
    of_face[t] = normal.norm() > 0 ? Normal(normal.normalized().cast<float>()) : Normal(Normal::Zero());
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 u = corner(k + 1) - corner(k), v = corner(k + 2) - corner(k);
      angles[t][k] = static_cast<float>(std::atan2(u.cross(v).norm(), u.dot(v)));
      around_vertex[triangle[k]].emplace_back(t, angles[t][k]);
    }
  }
  std::vector<std::array<Normal, 3>> normals(triangles.size());
  for (Index t = 0; t < triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      Normal sum = angles[t][k] * of_face[t];
      for (const auto& [other, angle] : around_vertex[triangles[t][k]])
        if (other != t && of_face[other].dot(of_face[t]) > crease_cosine) sum += angle * of_face[other];
      normals[t][k] = sum.norm() > 0 ? Normal(sum.normalized()) : of_face[t];
    }
  return normals;
}

ShadedMesh tubes(const Drawing& drawing, double radius, const Rgb& color) {
  ShadedMesh solid;
  for (const std::vector<Vec3>& line : drawing.lines)
    for (std::size_t i = 0; i < line.size(); ++i) {
      if (i > 0) add_tube(solid, line[i - 1], line[i], radius, color);
      add_ball(solid, line[i], radius, color);
    }
  for (const Vec3& point : drawing.points) add_ball(solid, point, point_radius * radius, color);
  return solid;
}

ShadedMesh sheets(const Drawing& drawing, const Rgb& color) {
  ShadedMesh solid;
  for (const Patch& patch : drawing.patches) {
    ShadedMesh part{patch.positions, patch.triangles, corner_normals(patch.positions, patch.triangles), {}, {}};
    part.triangle_colors.assign(patch.triangles.size(), color);
    solid.append(part);
  }
  return solid;
}

}  // namespace toposcope
