// SPDX-License-Identifier: BSD-3-Clause
#include "sample/depth_fusion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>

namespace toposcope {

namespace {

/// Points about the origin, coordinate by coordinate.
struct PointBatch {
  std::vector<float> x, y, z;
  explicit PointBatch(std::size_t count) : x(count), y(count), z(count) {}
  std::size_t size() const { return x.size(); }
  void set(std::size_t i, const Vec3& p) {
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
    std::vector<float> depth, column, row;
    explicit Scratch(std::size_t count) : depth(count), column(count), row(count) {}
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

  /// For each point the distance to the plane seen there, positive in front of it, and the measurement's weight.
  void look(const PointBatch& points, Scratch& scratch, float* distance, float* weight) const {
    const std::size_t count = points.size();
    float *depths = scratch.depth.data(), *columns = scratch.column.data(), *rows = scratch.row.data();
    for (std::size_t i = 0; i < count; ++i) {
      const float x = points.x[i], y = points.y[i], z = points.z[i];
      depths[i] = axes_(2, 0) * x + axes_(2, 1) * y + axes_(2, 2) * z + offset_.z();
      const float scale = focal_ / depths[i];
      const float column = (axes_(0, 0) * x + axes_(0, 1) * y + axes_(0, 2) * z + offset_.x()) * scale + center_x_;
      const float row = (axes_(1, 0) * x + axes_(1, 1) * y + axes_(1, 2) * z + offset_.y()) * scale + center_y_;
      columns[i] = std::min(std::max(column, 0.0F), last_x_);
      rows[i] = std::min(std::max(row, 0.0F), last_y_);
    }
    for (std::size_t i = 0; i < count; ++i) {
      const auto column = static_cast<std::int32_t>(columns[i]), row = static_cast<std::int32_t>(rows[i]);
      const DepthCell& cell = cells_[static_cast<std::size_t>(row) * width_ + static_cast<std::size_t>(column)];
      const float fx = columns[i] - static_cast<float>(column), fy = rows[i] - static_cast<float>(row);
      const float w = cell.w + fx * cell.wx + fy * (cell.wy + fx * cell.wxy);
      distance[i] = (1 - depths[i] * w) * cell.plane;
      weight[i] = cell.weight;
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
  float front, behind, window, doubt, carved;
  explicit Thresholds(const DepthFusion& fusion)
      // Beside a node that lies inside, those outside are less than a cell's diagonal away.
      : front(static_cast<float>(1.75 * fusion.spacing + 3 * fusion.noise)),
        behind(static_cast<float>(fusion.behind)),
        window(static_cast<float>(0.25 * fusion.spacing + 6 * fusion.noise)),
        doubt(static_cast<float>(0.25 * fusion.spacing + 3 * fusion.noise)),
        carved(static_cast<float>(0.5 * fusion.spacing)) {}
};

/// What the views say of a batch of points.
class BatchFusion {
 public:
  BatchFusion(const std::vector<Projector>& views, const DepthFusion& fusion, std::size_t length)
      : views_(views),
        t_(fusion),
        length_(length),
        distance_(views.size() * length),
        weight_(distance_.size()),
        top_(length),
        sum_(length),
        total_(length),
        carved_(length),
        scratch_(length) {}

  /// \param looking  the views to be asked
  /// \param carved   whether one of the others saw through all points
  void fuse(const PointBatch& points, std::span<const std::uint32_t> looking, bool carved) {
    std::fill(top_.begin(), top_.end(), nothing);
    std::fill(carved_.begin(), carved_.end(), static_cast<float>(carved));
    for (std::size_t v = 0; v < looking.size(); ++v) {
      float* distance = distance_.data() + v * length_;
      float* weight = weight_.data() + v * length_;
      views_[looking[v]].look(points, scratch_, distance, weight);
      for (std::size_t i = 0; i < length_; ++i) {
        const bool near = weight[i] > 0 && distance[i] <= t_.front && distance[i] >= -t_.behind;
        top_[i] = std::max(top_[i], near ? distance[i] : nothing);
        carved_[i] = distance[i] > t_.front ? 1.0F : carved_[i];
      }
    }
    std::fill(sum_.begin(), sum_.end(), 0.0F);
    std::fill(total_.begin(), total_.end(), 0.0F);
    for (std::size_t v = 0; v < looking.size(); ++v) {
      const float* distance = distance_.data() + v * length_;
      const float* weight = weight_.data() + v * length_;
      for (std::size_t i = 0; i < length_; ++i) {
        const float w = distance[i] <= t_.front && distance[i] >= top_[i] - t_.window ? weight[i] : 0.0F;
        sum_[i] += w > 0 ? w * distance[i] : 0.0F;
        total_[i] += w;
      }
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
  const std::vector<Projector>& views_;
  Thresholds t_;
  std::size_t length_;
  std::vector<float> distance_, weight_;  // by view and point
  std::vector<float> top_, sum_, total_, carved_;
  Projector::Scratch scratch_;
};

/// A block of 4 nodes along each axis.
class BlockFusion {
 public:
  static constexpr std::size_t side = 4;

  BlockFusion(const std::vector<Projector>& views, const DepthFusion& fusion)
      : views_(views), t_(fusion), points_(side * side * side), batch_(views, fusion, points_.size()) {}

  void fuse(NodeGrid& grid, std::size_t x0, std::size_t y0, std::size_t z0) {
    const Vec3 center = grid.position(x0, y0, z0, Vec3::Constant((side - 1) / 2.0));
    const auto radius = static_cast<float>((side - 1) / 2.0 * std::sqrt(3.0) * grid.spacing);
    looking_.clear();
    bool carved = false;
    for (std::uint32_t v = 0; v < views_.size(); ++v) {
      const Projector::Verdict verdict = views_[v].judge(center.cast<float>(), radius, t_.front, t_.behind);
      carved = carved || verdict == Projector::Verdict::free;
      if (verdict == Projector::Verdict::unclear) looking_.push_back(v);
    }
    std::size_t i = 0;
    for (std::size_t z = z0; z < z0 + side; ++z)
      for (std::size_t y = y0; y < y0 + side; ++y)
        for (std::size_t x = x0; x < x0 + side; ++x) points_.set(i++, grid.position(x, y, z));
    batch_.fuse(points_, looking_, carved);
    i = 0;
    for (std::size_t z = z0; z < z0 + side; ++z)
      for (std::size_t y = y0; y < y0 + side; ++y)
        for (std::size_t x = x0; x < x0 + side; ++x) grid.values[grid.node(x, y, z)] = batch_.value(i++);
  }

 private:
  const std::vector<Projector>& views_;
  Thresholds t_;
  PointBatch points_;
  BatchFusion batch_;
  std::vector<std::uint32_t> looking_;
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

/// Moves vertices by the measured distance along the gradient: those of a surface net lie inside of bends.
void settle(std::vector<Vec3>& positions, const NodeGrid& grid, const std::vector<Projector>& views,
            const DepthFusion& fusion, Context& context) {
  constexpr std::size_t size = 256;
  std::vector<std::uint32_t> all(views.size());
  std::iota(all.begin(), all.end(), 0U);
  context.parallel_for((positions.size() + size - 1) / size, 4, [&](std::size_t first, std::size_t last) {
    PointBatch points(size);
    BatchFusion batch(views, fusion, size);
    for (std::size_t c = first; c < last; ++c) {
      const std::size_t begin = c * size, count = std::min(size, positions.size() - begin);
      for (std::size_t i = 0; i < count; ++i) points.set(i, positions[begin + i]);
      batch.fuse(points, all, false);
      for (std::size_t i = 0; i < count; ++i) {
        if (!batch.measured(i) || std::abs(batch.measurement(i)) > 0.5 * grid.spacing) continue;
        const Vec3 gradient = gradient_at(grid, positions[begin + i]);
        if (const double length = gradient.norm(); length > 0)
          positions[begin + i] -= static_cast<double>(batch.measurement(i)) / length * gradient;
      }
    }
  });
}

}  // namespace

TriangleSoup fuse_depths(std::span<const DepthView> views, const DepthFusion& fusion, const Vec3& low, const Vec3& high,
                         Context& context) {
  const Vec3 margin = Vec3::Constant(3 * fusion.spacing);
  NodeGrid grid = make_node_grid(low - margin, high + margin, fusion.spacing);
  const std::vector<Projector> projectors = projectors_of(views, context);
  constexpr std::size_t side = BlockFusion::side;
  const std::size_t wide = grid.size[0] / side, high_blocks = grid.size[1] / side, deep = grid.size[2] / side;
  context.parallel_for(wide * high_blocks * deep, 16, [&](std::size_t first, std::size_t last) {
    BlockFusion block(projectors, fusion);
    for (std::size_t b = first; b < last; ++b)
      block.fuse(grid, b % wide * side, b / wide % high_blocks * side, b / (wide * high_blocks) * side);
  });
  clear_border(grid);
  Filler(grid).run();
  TriangleSoup mesh = surface_net(grid, {}, context);
  settle(mesh.positions, grid, projectors, fusion, context);
  return mesh;
}

std::vector<char> measured_near(std::span<const DepthView> views, std::span<const Vec3> points, double tolerance,
                                Context& context) {
  const std::vector<Projector> projectors = projectors_of(views, context);
  std::vector<char> measured(points.size(), 0);
  constexpr std::size_t size = 256;
  context.parallel_for((points.size() + size - 1) / size, 4, [&](std::size_t first, std::size_t last) {
    PointBatch batch(size);
    Projector::Scratch scratch(size);
    std::vector<float> distance(size), weight(size);
    for (std::size_t c = first; c < last; ++c) {
      const std::size_t begin = c * size, count = std::min(size, points.size() - begin);
      for (std::size_t i = 0; i < count; ++i) batch.set(i, points[begin + i]);
      for (const Projector& projector : projectors) {
        projector.look(batch, scratch, distance.data(), weight.data());
        for (std::size_t i = 0; i < count; ++i)
          if (weight[i] > 0 && std::abs(distance[i]) <= static_cast<float>(tolerance)) measured[begin + i] = 1;
      }
    }
  });
  return measured;
}

}  // namespace toposcope
