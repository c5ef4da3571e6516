// SPDX-License-Identifier: BSD-3-Clause
#include "inputs.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numeric>

namespace toposcope {
namespace {

TriangleSoup with_origins(TriangleSoup soup) {
  soup.face_origin.resize(soup.triangles.size());
  std::iota(soup.face_origin.begin(), soup.face_origin.end(), Index{0});
  soup.input_faces = static_cast<Index>(soup.triangles.size());
  return soup;
}

/// The quad's diagonal alternates, so that the mesh has no preferred direction.
void add_quad(TriangleSoup& soup, Index a, Index b, Index c, Index d, bool flip) {
  if (flip)
    soup.triangles.insert(soup.triangles.end(), {{a, b, d}, {b, c, d}});
  else
    soup.triangles.insert(soup.triangles.end(), {{a, b, c}, {a, c, d}});
}

}  // namespace

double Random::uniform(double low, double high) {
  return low + (high - low) * uniform_open(next());
}

double Random::normal() {
  const double u = uniform();
  return normal_pair(u, uniform())[0];
}

Eigen::Matrix3d random_rotation(std::uint64_t seed) {
  Random random(seed);
  const double w = random.normal(), x = random.normal(), y = random.normal(), z = random.normal();
  return Eigen::Quaterniond(w, x, y, z).normalized().toRotationMatrix();
}

TriangleSoup uneven_torus(int around, int along) {
  TriangleSoup soup;
  Random random(1);
  for (int i = 0; i < around; ++i)
    for (int j = 0; j < along; ++j) {
      const double u = 2 * pi * (i + random.uniform(-0.1, 0.1)) / around;
      const double v = 2 * pi * (j + random.uniform(-0.1, 0.1)) / along;
      const double tube = 0.25 + 0.09 * std::sin(u + 0.3) + 0.03 * std::cos(3 * u) + 0.02 * std::sin(v);
      const double r = 0.7 + tube * std::cos(v);
      soup.positions.emplace_back(r * std::cos(u), 0.8 * r * std::sin(u), tube * std::sin(v));
    }
  const auto at = [&](int i, int j) { return static_cast<Index>((i % around) * along + j % along); };
  for (int i = 0; i < around; ++i)
    for (int j = 0; j < along; ++j)
      add_quad(soup, at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1), (i + j) % 2 != 0);
  return with_origins(std::move(soup));
}

TriangleSoup wavy_sheet(int nx, int ny) {
  TriangleSoup soup;
  Random random(2);
  for (int i = 0; i <= nx; ++i)
    for (int j = 0; j <= ny; ++j) {
      const double x = 2.0 * (i + random.uniform(-0.1, 0.1)) / nx - 1;
      const double y = 1.4 * (j + random.uniform(-0.1, 0.1)) / ny - 0.7;
      soup.positions.emplace_back(x, y, 0.15 * std::sin(4 * x + y) + 0.1 * x * y * y + 0.05 * std::cos(5 * y));
    }
  const auto at = [&](int i, int j) { return static_cast<Index>(i * (ny + 1) + j); };
  for (int i = 0; i < nx; ++i)
    for (int j = 0; j < ny; ++j)
      add_quad(soup, at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1), (i + j) % 2 != 0);
  return with_origins(std::move(soup));
}

TriangleSoup block(int n) {
  // A cube's surface lattice, each lattice point once, then stretched to unequal sides.
  TriangleSoup soup;
  std::vector<Index> index(static_cast<std::size_t>((n + 1) * (n + 1) * (n + 1)), 0);
  const auto slot = [&](int x, int y, int z) -> Index& {
    return index[static_cast<std::size_t>((x * (n + 1) + y) * (n + 1) + z)];
  };
  Random random(3);
  const auto on_edge = [&](int a) { return a == 0 || a == n; };
  for (int x = 0; x <= n; ++x)
    for (int y = 0; y <= n; ++y)
      for (int z = 0; z <= n; ++z) {
        if (!on_edge(x) && !on_edge(y) && !on_edge(z)) continue;
        slot(x, y, z) = static_cast<Index>(soup.positions.size());
        const auto place = [&](int a) { return (a + (on_edge(a) ? 0 : random.uniform(-0.12, 0.12))) / n - 0.5; };
        const double px = place(x), py = place(y), pz = place(z);
        soup.positions.emplace_back(1.9 * px, 1.3 * py, 0.8 * pz);
      }
  const auto side = [&](auto corner, bool outwards) {
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        const Index a = corner(i, j), b = corner(i + 1, j), c = corner(i + 1, j + 1), d = corner(i, j + 1);
        outwards ? add_quad(soup, a, b, c, d, (i + j) % 2 != 0) : add_quad(soup, a, d, c, b, (i + j) % 2 != 0);
      }
  };
  for (const int end : {0, n}) {
    side([&](int i, int j) { return slot(i, j, end); }, end == n);
    side([&](int i, int j) { return slot(end, i, j); }, end == n);
    side([&](int i, int j) { return slot(j, end, i); }, end == n);
  }
  return with_origins(std::move(soup));
}

std::vector<NamedSoup> degenerate_soups() {
  const auto made = [](const char* name, std::vector<Vec3> positions, std::vector<Triangle> triangles) {
    return NamedSoup{name, with_origins({std::move(positions), std::move(triangles), {}, 0})};
  };
  std::vector<NamedSoup> soups = {
      made("one triangle", {{0, 0, 0}, {1, 0, 0}, {0.2, 0.9, 0}}, {{0, 1, 2}}),
      made("a tetrahedron", {{0, 0, 0}, {1, 0, 0}, {0.2, 0.9, 0}, {0.3, 0.2, 0.8}},
           {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}),
      made("a needle", {{0, 0, 0}, {1, 0, 0}, {0.5, 1e-9, 0}}, {{0, 1, 2}}),
      made("a face without area", {{0, 0, 0}, {1, 0, 0}, {0.5, 0, 0}}, {{0, 1, 2}}),
      made("vertices at one place", {{0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {0.2, 0.9, 0}}, {{0, 1, 3}, {0, 3, 2}}),
      made("two separate triangles", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 3}, {1, 0, 3}, {0, 1.2, 3}},
           {{0, 1, 2}, {3, 4, 5}}),
      made("a loose vertex", {{9, 9, 9}, {0, 0, 0}, {1, 0, 0}, {0.2, 0.9, 0}}, {{1, 2, 3}}),
      made("two faces back to back", {{0, 0, 0}, {1, 0, 0}, {0.2, 0.9, 0}}, {{0, 1, 2}, {0, 2, 1}}),
  };
  TriangleSoup flat = wavy_sheet(6, 5);
  for (Vec3& p : flat.positions) p.z() = 0;
  soups.push_back({"a flat sheet", std::move(flat)});
  return soups;
}

TriangleSoup moved(const TriangleSoup& soup, const Motion& motion) {
  TriangleSoup result = soup;
  for (Vec3& p : result.positions) p = motion(p);
  if (motion.shuffle == 0) return result;
  Random random(motion.shuffle);
  std::vector<Index> old_of(soup.positions.size());
  std::iota(old_of.begin(), old_of.end(), Index{0});
  random.shuffle(old_of);
  std::vector<Index> new_of(old_of.size());
  for (Index v = 0; v < old_of.size(); ++v) {
    new_of[old_of[v]] = v;
    result.positions[v] = motion(soup.positions[old_of[v]]);
  }
  for (Triangle& t : result.triangles) {
    const std::size_t first = random.below(3);
    t = {new_of[t[first]], new_of[t[(first + 1) % 3]], new_of[t[(first + 2) % 3]]};
  }
  random.shuffle(result.triangles);
  return with_origins(std::move(result));
}

}  // namespace toposcope
