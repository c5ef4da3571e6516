// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Solids with known sides for the examples' tests.

#include <cmath>
#include <cstdint>
#include <map>
#include <random>
#include <vector>

#include "toposcope/types.h"

namespace solids {

using toposcope::Index;
using toposcope::Triangle;
using toposcope::Vec3;

struct Solid {
  std::vector<Vec3> positions;
  std::vector<Triangle> triangles;
  std::vector<int> side_of;  ///< per vertex: its side, from 0; -1 on an edge between sides
};

/// Even noise of so many mean edges, the same on every platform.
inline void shake(Solid& solid, double edge, double noise, std::uint32_t seed) {
  std::mt19937 random(seed);
  const auto uniform = [&] { return static_cast<double>(random()) / 2147483647.5 - 1; };
  for (Vec3& p : solid.positions) {
    const double x = uniform(), y = uniform(), z = uniform();
    p += noise * edge * std::sqrt(3.0) * Vec3(x, y, z);  // of that standard deviation along each axis
  }
}

/// A cuboid of 2 x 1.5 x 1 with n quads along its longest side.
inline Solid block(int n, double noise, std::uint32_t seed) {
  Solid solid;
  std::map<std::array<int, 3>, Index> known;
  const std::array<int, 3> size = {n, 3 * n / 4, n / 2};
  const auto vertex = [&](std::array<int, 3> at, int side) {
    const auto [entry, added] = known.try_emplace(at, static_cast<Index>(solid.positions.size()));
    if (added) {
      solid.positions.push_back(Vec3(at[0], at[1], at[2]) * (2.0 / n));
      solid.side_of.push_back(side);
    } else if (solid.side_of[entry->second] != side) {
      solid.side_of[entry->second] = -1;
    }
    return entry->second;
  };
  for (int side = 0; side < 6; ++side) {
    const auto axis = static_cast<std::size_t>(side / 2), u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (int i = 0; i < size[u]; ++i)
      for (int j = 0; j < size[v]; ++j) {
        const auto at = [&](int x, int y) {
          std::array<int, 3> place{};
          place[axis] = side % 2 ? size[axis] : 0;
          place[u] = x;
          place[v] = y;
          return vertex(place, side);
        };
        const Index a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1), d = at(i, j + 1);
        if (side % 2)
          solid.triangles.insert(solid.triangles.end(), {{a, b, c}, {a, c, d}});
        else
          solid.triangles.insert(solid.triangles.end(), {{a, c, b}, {a, d, c}});
      }
  }
  shake(solid, 2.0 / n, noise, seed);
  return solid;
}

/// An elliptic can about the z axis: semi-axes a and b, `around` vertices around. Sides: wall, bottom, top.
inline Solid oval_can(double a, double b, double height, int around, double noise, std::uint32_t seed) {
  Solid solid;
  const double edge = 2 * toposcope::pi * std::sqrt((a * a + b * b) / 2) / around;
  const int rows = static_cast<int>(std::lround(height / edge)), rings = static_cast<int>(std::lround(b / edge));
  const auto ring = [&](double part, double z, int side) {
    const Index first = static_cast<Index>(solid.positions.size());
    for (int i = 0; i < around; ++i) {
      const double t = 2 * toposcope::pi * i / around;
      solid.positions.emplace_back(part * a * std::cos(t), part * b * std::sin(t), z);
      solid.side_of.push_back(side);
    }
    return first;
  };
  const auto join = [&](Index low, Index high) {
    for (Index i = 0; i < static_cast<Index>(around); ++i) {
      const Index next = (i + 1) % static_cast<Index>(around);
      solid.triangles.insert(solid.triangles.end(),
                             {{low + i, low + next, high + next}, {low + i, high + next, high + i}});
    }
  };
  Index before = 0;
  for (int row = 0; row <= rows; ++row) {
    const Index now = ring(1, height * row / rows - height / 2, row == 0 || row == rows ? -1 : 0);
    if (row > 0) join(before, now);
    before = now;
  }
  for (const int top : {0, 1}) {
    Index outer = top ? before : 0;
    for (int k = rings - 1; k > 0; --k) {
      const Index inner = ring(static_cast<double>(k) / rings, top ? height / 2 : -height / 2, 1 + top);
      top ? join(outer, inner) : join(inner, outer);
      outer = inner;
    }
    const Index middle = static_cast<Index>(solid.positions.size());
    solid.positions.emplace_back(0, 0, top ? height / 2 : -height / 2);
    solid.side_of.push_back(1 + top);
    for (Index i = 0; i < static_cast<Index>(around); ++i) {
      const Index next = (i + 1) % static_cast<Index>(around);
      if (top)
        solid.triangles.push_back({outer + i, outer + next, middle});
      else
        solid.triangles.push_back({outer + next, outer + i, middle});
    }
  }
  shake(solid, edge, noise, seed);
  return solid;
}

/// The unit sphere: an icosahedron whose faces are cut in four so many times.
inline Solid sphere(int subdivisions) {
  const double g = (1 + std::sqrt(5.0)) / 2;
  Solid solid;
  for (const double s : {-1.0, 1.0})
    for (const double t : {-g, g}) {
      solid.positions.emplace_back(s, t, 0);
      solid.positions.emplace_back(0, s, t);
      solid.positions.emplace_back(t, 0, s);
    }
  for (Index i = 0; i < 12; ++i)  // of three vertices two edges apart in pairs
    for (Index j = i + 1; j < 12; ++j)
      for (Index k = j + 1; k < 12; ++k) {
        const Vec3 &a = solid.positions[i], &b = solid.positions[j], &c = solid.positions[k];
        if ((a - b).norm() > 2.1 || (b - c).norm() > 2.1 || (c - a).norm() > 2.1) continue;
        const Vec3 u = b - a, v = c - a;
        const Vec3 normal(u.y() * v.z() - u.z() * v.y(), u.z() * v.x() - u.x() * v.z(), u.x() * v.y() - u.y() * v.x());
        solid.triangles.push_back(normal.dot(a) > 0 ? Triangle{i, j, k} : Triangle{i, k, j});
      }
  for (int level = 0; level < subdivisions; ++level) {
    std::map<std::pair<Index, Index>, Index> middles;
    const auto middle = [&](Index i, Index j) {
      const auto [entry, added] = middles.try_emplace(std::minmax(i, j), static_cast<Index>(solid.positions.size()));
      if (added) solid.positions.push_back((solid.positions[i] + solid.positions[j]) / 2);
      return entry->second;
    };
    std::vector<Triangle> finer;
    for (const Triangle& t : solid.triangles) {
      const Index a = middle(t[0], t[1]), b = middle(t[1], t[2]), c = middle(t[2], t[0]);
      finer.insert(finer.end(), {{t[0], a, c}, {t[1], b, a}, {t[2], c, b}, {a, b, c}});
    }
    solid.triangles = std::move(finer);
  }
  for (Vec3& p : solid.positions) p.normalize();
  solid.side_of.assign(solid.positions.size(), 0);
  return solid;
}

}  // namespace solids
