// SPDX-License-Identifier: BSD-3-Clause
#include "sample/isosurface.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <set>
#include <stdexcept>

namespace toposcope {

namespace {

constexpr std::size_t block = 16;
constexpr double steepest_change = 1.25;  ///< change of the function per unit of length
constexpr Index none = std::numeric_limits<Index>::max();

/// Fills a cube of nodes: with its centre's value where that tells the sign of them all and none is next to the
/// surface, else part by part.
void fill_cube(NodeGrid& grid, const Implicit& surface, double level, const std::array<std::size_t, 3>& at,
               std::size_t side) {
  const auto& [x0, y0, z0] = at;
  if (side == 1) {
    grid.values[grid.node(x0, y0, z0)] = static_cast<float>(surface(grid.position(x0, y0, z0)).value - level);
    return;
  }
  const double half = static_cast<double>(side - 1) / 2;
  const double center = surface(grid.position(x0, y0, z0, Vec3::Constant(half))).value - level;
  if (std::abs(center) > steepest_change * grid.spacing * (half * std::sqrt(3.0) + 1)) {
    for (std::size_t z = z0; z < z0 + side; ++z)
      for (std::size_t y = y0; y < y0 + side; ++y)
        std::fill_n(grid.values.begin() + static_cast<std::ptrdiff_t>(grid.node(x0, y, z)), side,
                    static_cast<float>(center));
    return;
  }
  for (std::size_t c = 0; c < 8; ++c)
    fill_cube(grid, surface, level, {x0 + (c & 1) * side / 2, y0 + (c >> 1 & 1) * side / 2, z0 + (c >> 2) * side / 2},
              side / 2);
}

void fill(NodeGrid& grid, const Implicit& surface, double level, Context& context) {
  const std::array<std::size_t, 3> blocks = {grid.size[0] / block, grid.size[1] / block, grid.size[2] / block};
  context.parallel_for(blocks[0] * blocks[1] * blocks[2], 4, [&](std::size_t first, std::size_t last) {
    for (std::size_t b = first; b < last; ++b)
      fill_cube(grid, surface, level,
                {b % blocks[0] * block, b / blocks[0] % blocks[1] * block, b / (blocks[0] * blocks[1]) * block}, block);
  });
}

/// The corners of a cell: bit 0 is x, bit 1 y, bit 2 z. Its edges join corners that differ in one bit.
std::array<float, 8> corner_values(const NodeGrid& grid, std::size_t x, std::size_t y, std::size_t z) {
  std::array<float, 8> values;
  for (std::size_t c = 0; c < 8; ++c) values[c] = grid.values[grid.node(x + (c & 1), y + (c >> 1 & 1), z + (c >> 2))];
  return values;
}

/// Whether the surface passes between the corners of the cell at a node.
bool crossed(const NodeGrid& grid, std::size_t node) {
  const std::size_t row = grid.size[0], layer = grid.size[0] * grid.size[1];
  const float* v = &grid.values[node];
  const bool inside = v[0] < 0;
  for (const std::size_t offset : {std::size_t{1}, row, row + 1, layer, layer + 1, layer + row, layer + row + 1})
    if ((v[offset] < 0) != inside) return true;
  return false;
}

/// The corner to change where a face's or the cube's own opposite corners alone are inside (or outside): there a net
/// would touch itself. Slight ridges that run askew to the grid and barely cross its planes do this. 8: none.
std::size_t ambiguous_corner(const std::array<float, 8>& values) {
  const auto inside = [&](std::size_t c) { return values[c] < 0; };
  const auto least = [&](std::initializer_list<std::size_t> corners) {
    return std::min(corners, [&](std::size_t a, std::size_t b) { return std::abs(values[a]) < std::abs(values[b]); });
  };
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const std::size_t side : {std::size_t{0}, std::size_t{1}}) {
      const std::size_t a = side << axis, u = std::size_t{1} << (axis + 1) % 3, v = std::size_t{1} << (axis + 2) % 3;
      if (inside(a) == inside(a + u + v) && inside(a + u) == inside(a + v) && inside(a) != inside(a + u))
        return least({a, a + u, a + v, a + u + v});
    }
  const auto count = std::count_if(values.begin(), values.end(), [](float v) { return v < 0; });
  if (count != 2 && count != 6) return 8;
  for (std::size_t c = 0; c < 4; ++c)
    if (inside(c) == (count == 2) && inside(7 - c) == (count == 2)) return least({c, 7 - c});
  return 8;
}

/// Turns the signs of nodes that lie all but on the surface where that makes the net a manifold; each node once.
void resolve_ambiguities(NodeGrid& grid) {
  constexpr double all_but_on = 0.25;  ///< cells
  const float limit = static_cast<float>(all_but_on * grid.spacing);
  const auto turn = [&](auto&& self, std::size_t x, std::size_t y, std::size_t z,
                        std::set<std::size_t>& turned) -> void {
    const std::array<float, 8> values = corner_values(grid, x, y, z);
    const std::size_t c = ambiguous_corner(values);
    if (c == 8 || std::abs(values[c]) > limit) return;
    const std::size_t nx = x + (c & 1), ny = y + (c >> 1 & 1), nz = z + (c >> 2), node = grid.node(nx, ny, nz);
    if (!turned.insert(node).second) return;
    float& value = grid.values[node];
    value = value < 0 ? -value : std::min(-value, -std::numeric_limits<float>::min());
    for (std::size_t k = 0; k < 8; ++k) {
      const std::size_t cx = nx - (k & 1), cy = ny - (k >> 1 & 1), cz = nz - (k >> 2);
      if (cx + 1 < grid.size[0] && cy + 1 < grid.size[1] && cz + 1 < grid.size[2]) self(self, cx, cy, cz, turned);
    }
  };
  std::set<std::size_t> turned;
  for (std::size_t z = 0; z + 1 < grid.size[2]; ++z)
    for (std::size_t y = 0; y + 1 < grid.size[1]; ++y)
      for (std::size_t x = 0; x + 1 < grid.size[0]; ++x) {
        if (crossed(grid, grid.node(x, y, z))) turn(turn, x, y, z, turned);
      }
}

/// Mean of the points where the surface crosses the cell's edges, in cells from the cell's first corner.
Vec3 crossing_mean(const std::array<float, 8>& values) {
  Vec3 sum = Vec3::Zero();
  int count = 0;
  for (std::size_t c = 0; c < 8; ++c)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t d = c | (std::size_t{1} << axis);
      if (d == c || (values[c] < 0) == (values[d] < 0)) continue;
      Vec3 point(c & 1 ? 1 : 0, c & 2 ? 1 : 0, c & 4 ? 1 : 0);
      const double from = values[c], to = values[d];
      point[static_cast<Eigen::Index>(axis)] = from / (from - to);
      sum += point;
      ++count;
    }
  return sum / count;
}

/// Cosine between a triangle's normal and the mean direction of its corners.
double agreement(const TriangleSoup& mesh, const std::vector<Vec3>& directions, const Triangle& t) {
  const Vec3& a = mesh.positions[t[0]];
  const Vec3 normal = (mesh.positions[t[1]] - a).cross(mesh.positions[t[2]] - a);
  const Vec3 wanted = directions[t[0]] + directions[t[1]] + directions[t[2]];
  return normal.dot(wanted) / std::max(normal.norm() * wanted.norm(), 1e-300);
}

/// \param directions  of the vertices; empty: the shorter diagonal cuts
void add_quad(TriangleSoup& mesh, const std::vector<Vec3>& directions, const std::array<Index, 4>& q) {
  const std::array<Triangle, 2> one = {{{q[0], q[1], q[2]}, {q[0], q[2], q[3]}}};
  const std::array<Triangle, 2> other = {{{q[0], q[1], q[3]}, {q[1], q[2], q[3]}}};
  bool first;
  if (directions.empty()) {
    const auto gap = [&](int i, int j) { return (mesh.positions[q[i]] - mesh.positions[q[j]]).squaredNorm(); };
    first = gap(0, 2) <= gap(1, 3);
  } else {
    const auto worse = [&](const std::array<Triangle, 2>& pair) {
      return std::min(agreement(mesh, directions, pair[0]), agreement(mesh, directions, pair[1]));
    };
    first = worse(one) >= worse(other);
  }
  for (const Triangle& t : first ? one : other) mesh.triangles.push_back(t);
}

}  // namespace

NodeGrid make_node_grid(const Vec3& low, const Vec3& high, double spacing) {
  NodeGrid grid;
  grid.spacing = spacing;
  // An odd offset keeps the planes of the object off the planes of the grid, where signs would be those of rounding.
  grid.origin = low - spacing * Vec3(1.3713, 1.4159, 1.4771);
  double total = 1;
  for (std::size_t i = 0; i < 3; ++i) {
    const double cells = std::ceil((high[i] - grid.origin[i]) / spacing + 1.5) + 1;
    total *= cells + block;
    if (total > 2147483648.0) throw std::length_error("a grid of more than 2^31 nodes");
    grid.size[i] = (static_cast<std::size_t>(cells) + block - 1) / block * block;
  }
  grid.values.resize(grid.size[0] * grid.size[1] * grid.size[2]);
  return grid;
}

TriangleSoup surface_net(const NodeGrid& grid, const PlaceVertices& place) {
  TriangleSoup mesh;
  std::vector<Index> vertex_of(grid.values.size(), none);
  for (std::size_t z = 0; z + 1 < grid.size[2]; ++z)
    for (std::size_t y = 0; y + 1 < grid.size[1]; ++y)
      for (std::size_t x = 0; x + 1 < grid.size[0]; ++x) {
        if (!crossed(grid, grid.node(x, y, z))) continue;
        vertex_of[grid.node(x, y, z)] = static_cast<Index>(mesh.positions.size());
        mesh.positions.push_back(grid.position(x, y, z, crossing_mean(corner_values(grid, x, y, z))));
      }
  const std::vector<Vec3> directions = place(mesh.positions);
  for (std::size_t z = 1; z + 1 < grid.size[2]; ++z)
    for (std::size_t y = 1; y + 1 < grid.size[1]; ++y)
      for (std::size_t x = 1; x + 1 < grid.size[0]; ++x) {
        const std::array<std::size_t, 3> step = {1, grid.size[0], grid.size[0] * grid.size[1]};
        const std::size_t node = grid.node(x, y, z);
        for (std::size_t axis = 0; axis < 3; ++axis) {
          const bool from = grid.values[node] < 0, to = grid.values[node + step[axis]] < 0;
          if (from == to) continue;
          const std::size_t u = step[(axis + 1) % 3], v = step[(axis + 2) % 3];
          std::array<Index, 4> quad = {vertex_of[node - u - v], vertex_of[node - v], vertex_of[node],
                                       vertex_of[node - u]};
          if (to) std::swap(quad[1], quad[3]);  // counter-clockwise seen from outside
          add_quad(mesh, directions, quad);
        }
      }
  return mesh;
}

TriangleSoup extract_isosurface(const Implicit& surface, const Vec3& low, const Vec3& high, double spacing,
                                double level, Context& context) {
  NodeGrid grid = make_node_grid(low - Vec3::Constant(level), high + Vec3::Constant(level), spacing);
  fill(grid, surface, level, context);
  resolve_ambiguities(grid);
  return surface_net(grid, [&](std::vector<Vec3>& positions) {
    context.parallel_for(positions.size(), 1024, [&](std::size_t first, std::size_t last) {
      for (std::size_t v = first; v < last; ++v) positions[v] = project(surface, positions[v], spacing);
    });
    return std::vector<Vec3>();
  });
}

bool is_closed_manifold(const TriangleSoup& mesh) {
  struct Spoke {  // in the star of `center` the face leads from one neighbour to the next
    Index center, from, to;
    bool operator<(const Spoke& other) const {
      return center != other.center ? center < other.center : from < other.from;
    }
  };
  std::vector<Spoke> spokes;
  spokes.reserve(3 * mesh.triangles.size());
  for (const Triangle& t : mesh.triangles)
    for (std::size_t i = 0; i < 3; ++i) spokes.push_back({t[i], t[(i + 1) % 3], t[(i + 2) % 3]});
  std::sort(spokes.begin(), spokes.end());
  for (auto star = spokes.begin(); star != spokes.end();) {
    const auto end = std::find_if(star, spokes.end(), [&](const Spoke& s) { return s.center != star->center; });
    if (std::adjacent_find(star, end, [](const Spoke& a, const Spoke& b) { return a.from == b.from; }) != end)
      return false;
    Index neighbor = star->from;
    std::ptrdiff_t count = 0;
    do {
      const auto next = std::lower_bound(star, end, Spoke{star->center, neighbor, 0});
      if (next == end || next->from != neighbor) return false;
      neighbor = next->to;
      ++count;
    } while (neighbor != star->from && count <= end - star);
    if (count != end - star) return false;
    star = end;
  }
  return true;
}

}  // namespace toposcope
