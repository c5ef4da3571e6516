// SPDX-License-Identifier: BSD-3-Clause
#include "sample/depth_fusion.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "sample/batch_fusion.h"
#include "sample/well_composed.h"

namespace toposcope {

namespace {

/// A cube of nodes, 4 along each axis.
constexpr std::size_t side = 4;

/// Fuses eight blocks at a time: what a view says of all of them need not be asked again.
class BlockFusion {
 public:
  BlockFusion(const std::vector<DepthLookup>& views, const DepthFusion& fusion)
      : views_(views),
        t_(fusion),
        points_(side * side * side),
        batch_(fusion, side * side * side),
        level_(static_cast<float>(fusion.level)) {}

  void fuse_eight(NodeGrid& grid, std::size_t x0, std::size_t y0, std::size_t z0) {
    near_.clear();
    mixed_.clear();
    bool carved = false;
    const auto [center, radius] = ball(grid, x0, y0, z0, 2 * side);
    for (const DepthLookup& view : views_) {
      const DepthLookup::Verdict verdict = view.judge(center, radius, t_.front, t_.behind);
      carved = carved || verdict == DepthLookup::Verdict::free;
      if (verdict == DepthLookup::Verdict::near) near_.push_back(&view);
      if (verdict == DepthLookup::Verdict::near || verdict == DepthLookup::Verdict::mixed) mixed_.push_back(&view);
    }
    if (carved && near_.empty()) return fill(grid, x0, y0, z0);
    for (std::size_t c = 0; c < 8; ++c)
      fuse(grid, x0 + (c & 1) * side, y0 + (c >> 1 & 1) * side, z0 + (c >> 2) * side, carved);
  }

 private:
  static std::pair<Eigen::Vector3f, float> ball(const NodeGrid& grid, std::size_t x, std::size_t y, std::size_t z,
                                                std::size_t nodes) {
    const double half = static_cast<double>(nodes - 1) / 2;
    return {grid.position(x, y, z, Vec3::Constant(half)).cast<float>(),
            static_cast<float>(half * std::sqrt(3.0) * grid.spacing)};
  }

  void fill(NodeGrid& grid, std::size_t x0, std::size_t y0, std::size_t z0) const {
    for (std::size_t z = z0; z < z0 + 2 * side; ++z)
      for (std::size_t y = y0; y < y0 + 2 * side; ++y)
        std::fill_n(grid.values.begin() + static_cast<std::ptrdiff_t>(grid.node(x0, y, z)), 2 * side,
                    t_.front - level_);
  }

  void fuse(NodeGrid& grid, std::size_t x0, std::size_t y0, std::size_t z0, bool carved) {
    std::size_t i = 0;
    for (std::size_t z = z0; z < z0 + side; ++z)
      for (std::size_t y = y0; y < y0 + side; ++y)
        for (std::size_t x = x0; x < x0 + side; ++x)
          points_.set(static_cast<Eigen::Index>(i++), grid.position(x, y, z));
    const auto [center, radius] = ball(grid, x0, y0, z0, side);
    batch_.fuse(carved ? near_ : mixed_, points_, i, center, radius, carved);
    i = 0;
    for (std::size_t z = z0; z < z0 + side; ++z)
      for (std::size_t y = y0; y < y0 + side; ++y)
        for (std::size_t x = x0; x < x0 + side; ++x) grid.values[grid.node(x, y, z)] = batch_.value(i++) - level_;
  }

  const std::vector<DepthLookup>& views_;
  FusionThresholds t_;
  PointBatch points_;
  BatchFusion batch_;
  float level_;
  std::vector<const DepthLookup*> near_, mixed_;  // mixed or near
};

/// The two outer layers lie outside.
void clear_border(NodeGrid& grid) {
  const auto border = [](std::size_t i, std::size_t size) { return i < 2 || i + 2 >= size; };
  const float outside = static_cast<float>(2 * grid.spacing);
  for (std::size_t z = 0; z < grid.size[2]; ++z)
    for (std::size_t y = 0; y < grid.size[1]; ++y)
      for (std::size_t x = 0; x < grid.size[0]; ++x)
        if (border(x, grid.size[0]) || border(y, grid.size[1]) || border(z, grid.size[2]))
          grid.values[grid.node(x, y, z)] = outside;
}

/// Direction in which the distance grows, interpolated in the cell about a point.
Vec3 gradient_at(const NodeGrid& grid, const Vec3& point) {
  const Vec3 at = (point - grid.origin) / grid.spacing;
  std::array<std::size_t, 3> cell;
  std::array<double, 3> part;
  for (std::size_t k = 0; k < 3; ++k) {
    const double x = at[static_cast<Eigen::Index>(k)];
    cell[k] = static_cast<std::size_t>(x);
    part[k] = x - static_cast<double>(cell[k]);
  }
  Vec3 gradient = Vec3::Zero();
  for (std::size_t c = 0; c < 8; ++c) {
    const std::array<std::size_t, 3> bit = {c & 1, c >> 1 & 1, c >> 2};
    const double value = grid.values[grid.node(cell[0] + bit[0], cell[1] + bit[1], cell[2] + bit[2])];
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t u = (k + 1) % 3, v = (k + 2) % 3;
      gradient[static_cast<Eigen::Index>(k)] += (bit[k] == 1 ? value : -value) * (bit[u] == 1 ? part[u] : 1 - part[u]) *
                                                (bit[v] == 1 ? part[v] : 1 - part[v]);
    }
  }
  return gradient;
}

/// Moves vertices by the measured distance along the gradient: those of a surface net lie inside of bends, or as
/// far outside as it was laid. Vertices are
/// taken by blocks of cells, so that each is asked of few views. Returns the gradients.
std::vector<Vec3> settle(std::vector<Vec3>& positions, const NodeGrid& grid, const std::vector<DepthLookup>& views,
                         const DepthFusion& fusion, Context& context) {
  constexpr std::size_t most = side * side * side;
  const std::array<std::size_t, 3> blocks = {grid.size[0] / side, grid.size[1] / side, grid.size[2] / side};
  const auto block_of = [&](const Vec3& p) {
    std::size_t block = 0;
    for (std::size_t k = 3; k-- > 0;) {
      const auto axis = static_cast<Eigen::Index>(k);
      block = block * blocks[k] + static_cast<std::size_t>((p[axis] - grid.origin[axis]) / grid.spacing) / side;
    }
    return block;
  };
  std::vector<Index> first_of(blocks[0] * blocks[1] * blocks[2] + 1, 0), order(positions.size());
  std::vector<std::size_t> block(positions.size());
  for (std::size_t v = 0; v < positions.size(); ++v) ++first_of[(block[v] = block_of(positions[v])) + 1];
  std::partial_sum(first_of.begin(), first_of.end(), first_of.begin());
  std::vector<Index> next(first_of.begin(), first_of.end() - 1);
  for (std::size_t v = 0; v < positions.size(); ++v) order[next[block[v]]++] = static_cast<Index>(v);
  std::vector<const DepthLookup*> all;
  for (const DepthLookup& view : views) all.push_back(&view);
  const auto radius = static_cast<float>(side / 2.0 * std::sqrt(3.0) * grid.spacing);
  std::vector<Vec3> directions(positions.size());
  context.parallel_for(first_of.size() - 1, 64, [&](std::size_t first, std::size_t last) {
    PointBatch points(most);
    BatchFusion batch(fusion, most);
    for (std::size_t b = first; b < last; ++b) {
      const std::size_t count = first_of[b + 1] - first_of[b];  // a vertex for each cell at most
      if (count == 0) continue;
      const Index* members = order.data() + first_of[b];
      for (std::size_t i = 0; i < count; ++i) points.set(static_cast<Eigen::Index>(i), positions[members[i]]);
      const Vec3 center = grid.position(b % blocks[0] * side, b / blocks[0] % blocks[1] * side,
                                        b / (blocks[0] * blocks[1]) * side, Vec3::Constant(side / 2.0));
      batch.fuse(all, points, count, center.cast<float>(), radius, true);
      for (std::size_t i = 0; i < count; ++i) {
        Vec3& position = positions[members[i]];
        const Vec3 direction = directions[members[i]] = gradient_at(grid, position).stableNormalized();
        if (batch.measured(i) && std::abs(batch.measurement(i)) <= 0.5 * grid.spacing + fusion.level)
          position -= static_cast<double>(batch.measurement(i)) * direction;
      }
    }
  });
  return directions;
}

}  // namespace

TriangleSoup fuse_depths(std::span<const DepthView> views, const DepthFusion& fusion, const Vec3& low, const Vec3& high,
                         Context& context) {
  const Vec3 margin = Vec3::Constant(3 * fusion.spacing + fusion.level);
  NodeGrid grid = make_node_grid(low - margin, high + margin, fusion.spacing);
  const std::vector<DepthLookup> lookups = lookups_of(views, context);
  const std::size_t wide = grid.size[0] / (2 * side), rows = grid.size[1] / (2 * side),
                    deep = grid.size[2] / (2 * side);
  context.parallel_for(wide * rows * deep, 8, [&](std::size_t first, std::size_t last) {
    BlockFusion blocks(lookups, fusion);
    for (std::size_t b = first; b < last; ++b)
      blocks.fuse_eight(grid, 2 * side * (b % wide), 2 * side * (b / wide % rows), 2 * side * (b / (wide * rows)));
  });
  clear_border(grid);
  make_well_composed(grid);
  return surface_net(grid,
                     [&](std::vector<Vec3>& positions) { return settle(positions, grid, lookups, fusion, context); });
}

std::vector<char> measured_near(std::span<const DepthView> views, std::span<const Vec3> points, double tolerance,
                                Context& context) {
  const std::vector<DepthLookup> lookups = lookups_of(views, context);
  std::vector<char> measured(points.size(), 0);
  constexpr std::size_t size = 256;
  context.parallel_for((points.size() + size - 1) / size, 4, [&](std::size_t first, std::size_t last) {
    PointBatch batch(size);
    DepthLookup::Scratch scratch(size);
    for (std::size_t c = first; c < last; ++c) {
      const std::size_t begin = c * size, count = std::min(size, points.size() - begin);
      for (std::size_t i = 0; i < count; ++i) batch.set(static_cast<Eigen::Index>(i), points[begin + i]);
      for (const DepthLookup& lookup : lookups)
        lookup.look(batch, static_cast<Eigen::Index>(count), scratch, [&](std::size_t i, float distance, float weight) {
          if (weight > 0 && std::abs(distance) <= static_cast<float>(tolerance)) measured[begin + i] = 1;
        });
    }
  });
  return measured;
}

}  // namespace toposcope
