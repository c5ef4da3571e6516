// SPDX-License-Identifier: BSD-3-Clause
#include "support/meshes.h"

#include <Eigen/Geometry>
#include <cmath>
#include <map>
#include <numeric>
#include <random>
#include <utility>

namespace toposcope::test {
namespace {

void add_quad(TriangleSoup& soup, Index a, Index b, Index c, Index d) {
  soup.triangles.push_back({a, b, c});
  soup.triangles.push_back({a, c, d});
}

TriangleSoup finished(TriangleSoup soup) {
  soup.input_faces = static_cast<Index>(soup.triangles.size());
  soup.face_origin.resize(soup.triangles.size());
  std::iota(soup.face_origin.begin(), soup.face_origin.end(), Index{0});
  return soup;
}

/// Fisher and Yates; std::shuffle differs between standard libraries.
std::vector<Index> random_permutation(std::size_t count, std::mt19937_64& random) {
  std::vector<Index> order(count);
  std::iota(order.begin(), order.end(), Index{0});
  for (std::size_t i = count; i > 1; --i) std::swap(order[i - 1], order[random() % i]);
  return order;
}

}  // namespace

TriangleSoup make_sphere(int subdivisions, double radius) {
  const double g = (1 + std::sqrt(5.0)) / 2;
  TriangleSoup soup;
  for (double s : {1.0, -1.0})
    for (double t : {g, -g}) {
      soup.positions.push_back({0, s, t});
      soup.positions.push_back({s, t, 0});
      soup.positions.push_back({t, 0, s});
    }
  // The faces are the triples of vertices at mutual distance 2.
  const auto adjacent = [&](Index a, Index b) {
    return std::abs((soup.positions[a] - soup.positions[b]).squaredNorm() - 4) < 1e-9;
  };
  for (Index a = 0; a < 12; ++a)
    for (Index b = a + 1; b < 12; ++b)
      for (Index c = b + 1; c < 12; ++c)
        if (adjacent(a, b) && adjacent(b, c) && adjacent(c, a)) {
          const auto& p = soup.positions;
          const bool outward = p[a].dot(p[b].cross(p[c])) > 0;
          soup.triangles.push_back(outward ? Triangle{a, b, c} : Triangle{a, c, b});
        }
  for (int level = 0; level < subdivisions; ++level) {
    std::map<std::pair<Index, Index>, Index> middle;
    const auto middle_of = [&](Index a, Index b) {
      const auto [it, fresh] = middle.try_emplace(std::minmax(a, b), static_cast<Index>(soup.positions.size()));
      if (fresh) soup.positions.push_back((soup.positions[a].normalized() + soup.positions[b].normalized()) / 2);
      return it->second;
    };
    std::vector<Triangle> finer;
    for (const auto& [a, b, c] : soup.triangles) {
      const Index ab = middle_of(a, b), bc = middle_of(b, c), ca = middle_of(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    soup.triangles = std::move(finer);
  }
  for (Vec3& p : soup.positions) p = radius * p.normalized();
  return finished(std::move(soup));
}

TriangleSoup make_cylinder(double radius, double height, int around, int along, bool capped) {
  TriangleSoup soup;
  for (int j = 0; j <= along; ++j)
    for (int i = 0; i < around; ++i) {
      const double angle = 2 * pi * i / around;
      soup.positions.push_back(
          {radius * std::cos(angle), radius * std::sin(angle), height * (double(j) / along - 0.5)});
    }
  const auto at = [&](int i, int j) { return static_cast<Index>(j * around + i % around); };
  for (int j = 0; j < along; ++j)
    for (int i = 0; i < around; ++i) add_quad(soup, at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
  if (capped) {
    const Index bottom = static_cast<Index>(soup.positions.size()), top = bottom + 1;
    soup.positions.push_back({0, 0, -height / 2});
    soup.positions.push_back({0, 0, height / 2});
    for (int i = 0; i < around; ++i) {
      soup.triangles.push_back({bottom, at(i + 1, 0), at(i, 0)});
      soup.triangles.push_back({top, at(i, along), at(i + 1, along)});
    }
  }
  return finished(std::move(soup));
}

TriangleSoup make_can(double radius, double height, int around, int along, int across) {
  std::vector<std::pair<double, double>> profile;  // (radius, z), from the bottom's first ring to the top's last
  for (int i = 1; i <= across; ++i) profile.emplace_back(radius * i / across, -height / 2);
  for (int j = 1; j <= along; ++j) profile.emplace_back(radius, height * (double(j) / along - 0.5));
  for (int i = across - 1; i >= 1; --i) profile.emplace_back(radius * i / across, height / 2);
  TriangleSoup soup;
  for (const auto& [r, z] : profile)
    for (int i = 0; i < around; ++i) {
      const double angle = 2 * pi * i / around;
      soup.positions.push_back({r * std::cos(angle), r * std::sin(angle), z});
    }
  const int rings = static_cast<int>(profile.size());
  const auto at = [&](int i, int j) { return static_cast<Index>(j * around + i % around); };
  for (int j = 0; j + 1 < rings; ++j)
    for (int i = 0; i < around; ++i) add_quad(soup, at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
  const Index bottom = static_cast<Index>(soup.positions.size()), top = bottom + 1;
  soup.positions.push_back({0, 0, -height / 2});
  soup.positions.push_back({0, 0, height / 2});
  for (int i = 0; i < around; ++i) {
    soup.triangles.push_back({bottom, at(i + 1, 0), at(i, 0)});
    soup.triangles.push_back({top, at(i, rings - 1), at(i + 1, rings - 1)});
  }
  return finished(std::move(soup));
}

TriangleSoup make_torus(double major, double minor, int nu, int nv) {
  TriangleSoup soup;
  for (int i = 0; i < nu; ++i)
    for (int j = 0; j < nv; ++j) {
      const double u = 2 * pi * i / nu, v = 2 * pi * j / nv, r = major + minor * std::cos(v);
      soup.positions.push_back({r * std::cos(u), r * std::sin(u), minor * std::sin(v)});
    }
  const auto at = [&](int i, int j) { return static_cast<Index>(i % nu * nv + j % nv); };
  for (int i = 0; i < nu; ++i)
    for (int j = 0; j < nv; ++j) add_quad(soup, at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
  return finished(std::move(soup));
}

TriangleSoup make_grid(int nx, int ny, double width, double depth) {
  TriangleSoup soup;
  for (int j = 0; j <= ny; ++j)
    for (int i = 0; i <= nx; ++i)
      soup.positions.push_back({width * (double(i) / nx - 0.5), depth * (double(j) / ny - 0.5), 0});
  const auto at = [&](int i, int j) { return static_cast<Index>(j * (nx + 1) + i); };
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i) add_quad(soup, at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
  return finished(std::move(soup));
}

TriangleSoup make_sheet(double width, double thickness, int n) {
  TriangleSoup soup;
  for (const double side : {-1, 1})
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i <= n; ++i)
        soup.positions.push_back({width * (double(i) / n - 0.5), width * (double(j) / n - 0.5), side * thickness / 2});
  const auto below = [&](int i, int j) { return static_cast<Index>(j * (n + 1) + i); };
  const auto above = [&](int i, int j) { return below(i, j) + static_cast<Index>((n + 1) * (n + 1)); };
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      add_quad(soup, above(i, j), above(i + 1, j), above(i + 1, j + 1), above(i, j + 1));
      add_quad(soup, below(i, j), below(i, j + 1), below(i + 1, j + 1), below(i + 1, j));
    }
  for (int k = 0; k < n; ++k) {
    add_quad(soup, below(k, 0), below(k + 1, 0), above(k + 1, 0), above(k, 0));
    add_quad(soup, below(k + 1, n), below(k, n), above(k, n), above(k + 1, n));
    add_quad(soup, below(0, k + 1), below(0, k), above(0, k), above(0, k + 1));
    add_quad(soup, below(n, k), below(n, k + 1), above(n, k + 1), above(n, k));
  }
  return finished(std::move(soup));
}

TriangleSoup make_box(const Vec3& sides, int n) {
  TriangleSoup soup;
  std::map<std::array<int, 3>, Index> index;  // lattice point of the surface -> vertex
  const auto at = [&](const std::array<int, 3>& lattice) {
    const auto [it, fresh] = index.try_emplace(lattice, static_cast<Index>(soup.positions.size()));
    if (fresh)
      soup.positions.push_back({sides[0] * (double(lattice[0]) / n - 0.5), sides[1] * (double(lattice[1]) / n - 0.5),
                                sides[2] * (double(lattice[2]) / n - 0.5)});
    return it->second;
  };
  for (std::size_t w = 0; w < 3; ++w)
    for (bool far : {false, true}) {
      // Seen from outside, (u, v, w) is right-handed on the far face and left-handed on the near one.
      const std::size_t u = (w + (far ? 1 : 2)) % 3, v = (w + (far ? 2 : 1)) % 3;
      const auto corner = [&](int i, int j) {
        std::array<int, 3> lattice{};
        lattice[u] = i, lattice[v] = j, lattice[w] = far ? n : 0;
        return at(lattice);
      };
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j)
          add_quad(soup, corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1));
    }
  return finished(std::move(soup));
}

TriangleSoup transformed(TriangleSoup soup, const Eigen::Matrix3d& rotation, double scale, const Vec3& translation) {
  for (Vec3& p : soup.positions) p = rotation * (scale * p) + translation;
  return soup;
}

TriangleSoup shuffled(const TriangleSoup& soup, std::uint64_t seed, std::vector<Index>* new_vertex) {
  std::mt19937_64 random(seed);
  const std::vector<Index> place = random_permutation(soup.positions.size(), random);
  TriangleSoup result;
  result.input_faces = soup.input_faces;
  result.positions.resize(soup.positions.size());
  for (std::size_t v = 0; v < place.size(); ++v) result.positions[place[v]] = soup.positions[v];
  for (Index f : random_permutation(soup.triangles.size(), random)) {
    const Triangle& t = soup.triangles[f];
    const std::size_t first = random() % 3;
    result.triangles.push_back({place[t[first]], place[t[(first + 1) % 3]], place[t[(first + 2) % 3]]});
    result.face_origin.push_back(soup.face_origin[f]);
  }
  if (new_vertex) *new_vertex = place;
  return result;
}

Eigen::Matrix3d random_rotation(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  Eigen::Quaterniond q;
  do {
    q.coeffs() = {normal(random), normal(random), normal(random), normal(random)};
  } while (q.squaredNorm() < 1e-6);
  return q.normalized().toRotationMatrix();
}

}  // namespace toposcope::test
