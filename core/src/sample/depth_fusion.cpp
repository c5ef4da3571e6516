// SPDX-License-Identifier: BSD-3-Clause
#include "sample/depth_fusion.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>

namespace toposcope {

namespace {

using Floats = Eigen::ArrayXf;

/// Points about the origin, coordinate by coordinate.
struct PointBatch {
  Floats x, y, z;
  explicit PointBatch(Eigen::Index most) : x(most), y(most), z(most) {}
  void set(Eigen::Index i, const Vec3& p) {
    x[i] = static_cast<float>(p.x());
    y[i] = static_cast<float>(p.y());
    z[i] = static_cast<float>(p.z());
  }
};

/// Least and greatest values of the cells in tiles of 4 by 4.
struct Tile {
  float nearest = 0, farthest = 1e30F;  ///< inverse depths
  float plane = 1e30F;                  ///< least
};

/// A view's camera in single precision.
class Projector {
 public:
  /// Where points come to lie in the image.
  struct Scratch {
    Floats depth, scale, column, row;
    explicit Scratch(Eigen::Index most) : depth(most), scale(most), column(most), row(most) {}
  };

  explicit Projector(const DepthView& view)
      : axes_(view.axes.cast<float>()),
        offset_((-view.axes * view.viewpoint).cast<float>()),
        focal_(static_cast<float>(view.focal)),
        center_x_(static_cast<float>(view.center_x)),
        center_y_(static_cast<float>(view.center_y)),
        last_x_(static_cast<float>(view.width) - 0.5F),
        last_y_(static_cast<float>(view.height) - 0.5F),
        width_(view.width),
        cells_(view.cells.data()),
        tiles_wide_((view.width + 3) / 4) {
    tiles_.resize(static_cast<std::size_t>(tiles_wide_) * ((view.height + 3) / 4));
    for (std::uint32_t y = 0; y < view.height; ++y)
      for (std::uint32_t x = 0; x < view.width; ++x) {
        const DepthCell& cell = cells_[static_cast<std::size_t>(y) * width_ + x];
        Tile& tile = tiles_[static_cast<std::size_t>(y / 4) * tiles_wide_ + x / 4];
        const float beside = cell.w + cell.wx, below = cell.w + cell.wy, across = beside + cell.wy + cell.wxy;
        tile.nearest = std::max(tile.nearest, std::max(std::max(cell.w, beside), std::max(below, across)));
        tile.farthest = std::min(tile.farthest, std::min(std::min(cell.w, beside), std::min(below, across)));
        tile.plane = std::min(tile.plane, cell.plane);
      }
  }

  /// What the view says of a ball: that it saw through all of it, that all of it lies deep behind what it saw, or
  /// neither.
  enum class Verdict { free, hidden, unclear };
  Verdict judge(const Eigen::Vector3f& center, float radius, float front, float behind) const {
    const Eigen::Vector3f p = axes_ * center + offset_;
    const float scale = focal_ / (p.z() - radius), reach = radius * scale * 1.15F + 1;  // 1.15: the ball seen askew
    const float middle = focal_ / p.z(), x = p.x() * middle + center_x_, y = p.y() * middle + center_y_;
    const auto tile = [](float pixel, float last) {
      return static_cast<std::uint32_t>(std::min(std::max(pixel, 0.0F), last)) / 4;
    };
    const std::uint32_t left = tile(x - reach, last_x_), right = tile(x + reach, last_x_);
    const std::uint32_t top = tile(y - reach, last_y_), bottom = tile(y + reach, last_y_);
    Tile all;
    for (std::uint32_t row = top; row <= bottom; ++row)
      for (std::uint32_t column = left; column <= right; ++column) {
        const Tile& t = tiles_[static_cast<std::size_t>(row) * tiles_wide_ + column];
        all.nearest = std::max(all.nearest, t.nearest);
        all.farthest = std::min(all.farthest, t.farthest);
        all.plane = std::min(all.plane, t.plane);
      }
    if ((1 - (p.z() + radius) * all.nearest) * all.plane > front) return Verdict::free;
    if (((p.z() - radius) * all.farthest - 1) * all.plane > behind) return Verdict::hidden;
    return Verdict::unclear;
  }

  /// Calls take(i, distance, weight) for each point: the distance to the plane seen there, positive in front of it, and
  /// the measurement's weight.
  template <class Take>
  void look(const PointBatch& points, Eigen::Index count, Scratch& scratch, Take take) const {
    const auto x = points.x.head(count), y = points.y.head(count), z = points.z.head(count);
    auto depth = scratch.depth.head(count), scale = scratch.scale.head(count);
    auto columns = scratch.column.head(count), rows = scratch.row.head(count);
    depth = axes_(2, 0) * x + axes_(2, 1) * y + axes_(2, 2) * z + offset_.z();
    scale = focal_ / depth;
    columns = (axes_(0, 0) * x + axes_(0, 1) * y + axes_(0, 2) * z + offset_.x()) * scale + center_x_;
    columns = columns.max(0.0F).min(last_x_);
    rows = (axes_(1, 0) * x + axes_(1, 1) * y + axes_(1, 2) * z + offset_.y()) * scale + center_y_;
    rows = rows.max(0.0F).min(last_y_);
    for (Eigen::Index i = 0; i < count; ++i) {
      const auto column = static_cast<std::int32_t>(columns[i]), row = static_cast<std::int32_t>(rows[i]);
      const DepthCell& cell = cells_[static_cast<std::size_t>(row) * width_ + static_cast<std::size_t>(column)];
      const float fx = columns[i] - static_cast<float>(column), fy = rows[i] - static_cast<float>(row);
      const float w = cell.w + fx * cell.wx + fy * (cell.wy + fx * cell.wxy);
      take(static_cast<std::size_t>(i), (1 - depth[i] * w) * cell.plane, cell.weight);
    }
  }

 private:
  Eigen::Matrix3f axes_;
  Eigen::Vector3f offset_;
  float focal_, center_x_, center_y_, last_x_, last_y_;
  std::uint32_t width_;
  const DepthCell* cells_;
  std::uint32_t tiles_wide_;
  std::vector<Tile> tiles_;
};

struct Thresholds {
  float front;   ///< free space begins here; beside a node inside the net those outside are less than a cell's diagonal
                 ///< away
  float behind;  ///< a surface seen says nothing of what is deeper
  float window;  ///< measurements so far behind the foremost one count as of the same surface
  float doubt;   ///< and so deep as of another one, when other views saw through
  float carved;  ///< value of a node that was seen through and not measured
  explicit Thresholds(const DepthFusion& f)
      : front(static_cast<float>(1.75 * f.spacing + f.level + 3 * f.noise)),
        behind(static_cast<float>(1.7 * f.spacing)),
        window(static_cast<float>(0.25 * f.spacing + 6 * f.noise)),
        doubt(static_cast<float>(0.25 * f.spacing + 3 * f.noise)),
        carved(static_cast<float>(0.5 * f.spacing + f.level)) {}
};

/// What the views say of a batch of points that lie close together.
class BatchFusion {
 public:
  BatchFusion(const std::vector<Projector>& views, const DepthFusion& fusion, std::size_t most_points)
      : views_(views),
        t_(fusion),
        top_(most_points),
        sum_(most_points),
        total_(most_points),
        carved_(most_points),
        scratch_(static_cast<Eigen::Index>(most_points)) {}

  /// \param center, radius  a ball that contains the points
  void fuse(const PointBatch& points, std::size_t count, const Vec3& center, float radius) {
    std::fill_n(top_.begin(), count, nothing);
    std::fill_n(carved_.begin(), count, 0);
    near_.clear();
    bool all_carved = false;
    for (const Projector& view : views_) {
      const Projector::Verdict verdict = view.judge(center.cast<float>(), radius, t_.front, t_.behind);
      all_carved = all_carved || verdict == Projector::Verdict::free;
      if (verdict != Projector::Verdict::unclear) continue;
      view.look(points, static_cast<Eigen::Index>(count), scratch_, [&](std::size_t i, float distance, float weight) {
        if (distance > t_.front) {
          carved_[i] = 1;
        } else if (distance >= -t_.behind && weight > 0) {
          top_[i] = std::max(top_[i], distance);
          near_.push_back({static_cast<std::uint32_t>(i), distance, weight});
        }
      });
    }
    if (all_carved) std::fill_n(carved_.begin(), count, 1);
    std::fill_n(sum_.begin(), count, 0.0F);
    std::fill_n(total_.begin(), count, 0.0F);
    for (const Measurement& m : near_) {
      const float w = m.distance >= top_[m.point] - t_.window ? m.weight : 0;
      sum_[m.point] += w * m.distance;
      total_[m.point] += w;
    }
  }

  bool measured(std::size_t i) const { return top_[i] > nothing; }
  float measurement(std::size_t i) const { return sum_[i] / total_[i]; }
  float value(std::size_t i) const {
    if (carved_[i] == 0) return measured(i) ? measurement(i) : -t_.front;
    if (!measured(i)) return t_.front;
    // Seen through, though the views near it say that it lies deeper than the noise explains: behind them.
    return top_[i] > -t_.doubt ? measurement(i) : t_.carved;
  }

 private:
  static constexpr float nothing = -1e30F;
  struct Measurement {
    std::uint32_t point;
    float distance, weight;
  };
  const std::vector<Projector>& views_;
  Thresholds t_;
  std::vector<float> top_, sum_, total_;
  std::vector<char> carved_;
  std::vector<Measurement> near_;
  Projector::Scratch scratch_;
};

/// A block of 4 nodes along each axis.
class BlockFusion {
 public:
  static constexpr std::size_t side = 4;

  BlockFusion(const std::vector<Projector>& views, const DepthFusion& fusion)
      : points_(side * side * side),
        batch_(views, fusion, side * side * side),
        level_(static_cast<float>(fusion.level)) {}

  void fuse(NodeGrid& grid, std::size_t x0, std::size_t y0, std::size_t z0) {
    const Vec3 center = grid.position(x0, y0, z0, Vec3::Constant((side - 1) / 2.0));
    const auto radius = static_cast<float>((side - 1) / 2.0 * std::sqrt(3.0) * grid.spacing);
    std::size_t i = 0;
    for (std::size_t z = z0; z < z0 + side; ++z)
      for (std::size_t y = y0; y < y0 + side; ++y)
        for (std::size_t x = x0; x < x0 + side; ++x)
          points_.set(static_cast<Eigen::Index>(i++), grid.position(x, y, z));
    batch_.fuse(points_, i, center, radius);
    i = 0;
    for (std::size_t z = z0; z < z0 + side; ++z)
      for (std::size_t y = y0; y < y0 + side; ++y)
        for (std::size_t x = x0; x < x0 + side; ++x) grid.values[grid.node(x, y, z)] = batch_.value(i++) - level_;
  }

 private:
  PointBatch points_;
  BatchFusion batch_;
  float level_;
};

/// Fills in nodes until no two cells' faces meet in an edge or a corner alone: the set of nodes inside is
/// well-composed. Nodes only change from outside to inside, so that it ends.
class Filler {
 public:
  explicit Filler(NodeGrid& grid) : grid_(grid), step_({1, grid.size[0], grid.size[0] * grid.size[1]}) {}

  void run() {
    for (std::size_t z = 0; z + 1 < grid_.size[2]; ++z)
      for (std::size_t y = 0; y + 1 < grid_.size[1]; ++y)
        for (std::size_t x = 0; x + 1 < grid_.size[0]; ++x) check(grid_.node(x, y, z));
    while (!changed_.empty()) {
      const std::size_t node = changed_.back();
      changed_.pop_back();
      for (std::size_t c = 0; c < 8; ++c)
        check(node - ((c & 1) != 0 ? step_[0] : 0) - ((c & 2) != 0 ? step_[1] : 0) - ((c & 4) != 0 ? step_[2] : 0));
    }
  }

 private:
  bool inside(std::size_t node) const { return grid_.values[node] < 0; }

  /// Looks at the cell of which `node` is the first corner.
  void check(std::size_t node) {
    unsigned mask = 0;
    for (unsigned c = 0; c < 8; ++c) mask |= static_cast<unsigned>(inside(corner(node, c))) << c;
    if (mask == 0 || mask == 255) return;
    for (unsigned axis = 0; axis < 3; ++axis)
      for (unsigned side = 0; side < 2; ++side) {
        const unsigned u = 1U << ((axis + 1) % 3), v = 1U << ((axis + 2) % 3), base = side << axis;
        const std::array<unsigned, 4> face = {base, base | u, base | u | v, base | v};
        const bool a = mask >> face[0] & 1, b = mask >> face[1] & 1, c = mask >> face[2] & 1, d = mask >> face[3] & 1;
        if (a == c && b == d && a != b) return fill(node, a ? face[1] : face[0], a ? face[3] : face[2]);
      }
    for (unsigned c = 0; c < 4; ++c) {
      const unsigned pair = 1U << c | 1U << (7 - c);
      if (mask == pair) return fill_largest_gap(node, pair);
      if ((mask ^ 255U) == pair) return fill(node, c, 7 - c);
    }
  }

  std::size_t corner(std::size_t node, unsigned c) const {
    return node + ((c & 1U) != 0 ? step_[0] : 0) + ((c & 2U) != 0 ? step_[1] : 0) + ((c & 4U) != 0 ? step_[2] : 0);
  }

  void fill(std::size_t node, unsigned c, unsigned d) {
    const std::size_t p = corner(node, c), q = corner(node, d);
    set_inside(grid_.values[q] < grid_.values[p] ? q : p);
  }

  /// Of the nodes outside the one nearest to the surface.
  void fill_largest_gap(std::size_t node, unsigned inside_mask) {
    std::size_t best = 0;
    float least = 1e30F;
    for (unsigned c = 0; c < 8; ++c) {
      const std::size_t p = corner(node, c);
      if ((inside_mask >> c & 1U) == 0 && grid_.values[p] < least) {
        least = grid_.values[p];
        best = p;
      }
    }
    set_inside(best);
  }

  void set_inside(std::size_t node) {
    grid_.values[node] = -0.05F * static_cast<float>(grid_.spacing);
    changed_.push_back(node);
  }

  NodeGrid& grid_;
  std::array<std::size_t, 3> step_;
  std::vector<std::size_t> changed_;
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

std::vector<Projector> projectors_of(std::span<const DepthView> views, Context& context) {
  std::vector<std::optional<Projector>> made(views.size());
  context.parallel_for(views.size(), 4, [&](std::size_t first, std::size_t last) {
    for (std::size_t v = first; v < last; ++v) made[v].emplace(views[v]);
  });
  std::vector<Projector> projectors;
  for (std::optional<Projector>& projector : made) projectors.push_back(std::move(*projector));
  return projectors;
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
std::vector<Vec3> settle(std::vector<Vec3>& positions, const NodeGrid& grid, const std::vector<Projector>& views,
                         const DepthFusion& fusion, Context& context) {
  constexpr std::size_t side = 4, most = side * side * side;
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
  const auto radius = static_cast<float>(side / 2.0 * std::sqrt(3.0) * grid.spacing);
  std::vector<Vec3> directions(positions.size());
  context.parallel_for(first_of.size() - 1, 64, [&](std::size_t first, std::size_t last) {
    PointBatch points(most);
    BatchFusion batch(views, fusion, most);
    for (std::size_t b = first; b < last; ++b) {
      const std::size_t count = first_of[b + 1] - first_of[b];  // a vertex for each cell at most
      if (count == 0) continue;
      const Index* members = order.data() + first_of[b];
      for (std::size_t i = 0; i < count; ++i) points.set(static_cast<Eigen::Index>(i), positions[members[i]]);
      const Vec3 center = grid.position(b % blocks[0] * side, b / blocks[0] % blocks[1] * side,
                                        b / (blocks[0] * blocks[1]) * side, Vec3::Constant(side / 2.0));
      batch.fuse(points, count, center, radius);
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
  const std::vector<Projector> projectors = projectors_of(views, context);
  constexpr std::size_t side = BlockFusion::side;
  // Eight blocks together look at about the same pixels.
  const std::size_t wide = grid.size[0] / (2 * side), rows = grid.size[1] / (2 * side),
                    deep = grid.size[2] / (2 * side);
  context.parallel_for(wide * rows * deep, 8, [&](std::size_t first, std::size_t last) {
    BlockFusion block(projectors, fusion);
    for (std::size_t b = first; b < last; ++b)
      for (std::size_t c = 0; c < 8; ++c)
        block.fuse(grid, (2 * (b % wide) + (c & 1)) * side, (2 * (b / wide % rows) + (c >> 1 & 1)) * side,
                   (2 * (b / (wide * rows)) + (c >> 2)) * side);
  });
  clear_border(grid);
  Filler(grid).run();
  return surface_net(
      grid, [&](std::vector<Vec3>& positions) { return settle(positions, grid, projectors, fusion, context); });
}

std::vector<char> measured_near(std::span<const DepthView> views, std::span<const Vec3> points, double tolerance,
                                Context& context) {
  const std::vector<Projector> projectors = projectors_of(views, context);
  std::vector<char> measured(points.size(), 0);
  constexpr std::size_t size = 256;
  context.parallel_for((points.size() + size - 1) / size, 4, [&](std::size_t first, std::size_t last) {
    PointBatch batch(size);
    Projector::Scratch scratch(size);
    for (std::size_t c = first; c < last; ++c) {
      const std::size_t begin = c * size, count = std::min(size, points.size() - begin);
      for (std::size_t i = 0; i < count; ++i) batch.set(static_cast<Eigen::Index>(i), points[begin + i]);
      for (const Projector& projector : projectors)
        projector.look(batch, static_cast<Eigen::Index>(count), scratch,
                       [&](std::size_t i, float distance, float weight) {
                         if (weight > 0 && std::abs(distance) <= static_cast<float>(tolerance)) measured[begin + i] = 1;
                       });
    }
  });
  return measured;
}

}  // namespace toposcope
