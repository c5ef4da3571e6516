// SPDX-License-Identifier: BSD-3-Clause
#include "sample/depth_fusion.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace toposcope {

namespace {

/// A view's camera in single precision, for points about the origin.
struct Projector {
  float focal, center_x, center_y, last_x, last_y;
  std::uint32_t width;
  const DepthCell* cells;

  explicit Projector(const DepthView& view)
      : focal(static_cast<float>(view.focal)),
        center_x(static_cast<float>(view.center_x)),
        center_y(static_cast<float>(view.center_y)),
        last_x(static_cast<float>(view.width) - 0.5F),
        last_y(static_cast<float>(view.height) - 0.5F),
        width(view.width),
        cells(view.cells.data()) {}

  struct Look {
    float distance;  ///< to the plane seen there, positive in front of it
    float weight;
  };
  /// \param p  in the camera's frame
  Look operator()(const Eigen::Vector3f& p) const {
    const float scale = focal / p.z();
    const float x = std::min(std::max(p.x() * scale + center_x, 0.0F), last_x);
    const float y = std::min(std::max(p.y() * scale + center_y, 0.0F), last_y);
    const auto column = static_cast<std::int32_t>(x), row = static_cast<std::int32_t>(y);
    const DepthCell& cell = cells[static_cast<std::size_t>(row) * width + static_cast<std::size_t>(column)];
    const float fx = x - static_cast<float>(column), fy = y - static_cast<float>(row);
    const float w = cell.w + fx * cell.wx + fy * (cell.wy + fx * cell.wxy);
    return {(1 - p.z() * w) * cell.plane, cell.weight};
  }
};

/// What the views say of a row of nodes.
class RowFusion {
 public:
  RowFusion(std::span<const DepthView> views, const DepthFusion& fusion, std::size_t length)
      : views_(views),
        length_(length),
        distance_(views.size() * length),
        weight_(distance_.size()),
        top_(length),
        sum_(length),
        total_(length),
        carved_(length) {
    // Beside a node that lies inside, those outside are less than a cell's diagonal away.
    front_ = static_cast<float>(1.75 * fusion.spacing + 3 * fusion.noise);
    behind_ = static_cast<float>(fusion.behind);
    window_ = static_cast<float>(0.25 * fusion.spacing + 6 * fusion.noise);
    doubt_ = static_cast<float>(0.25 * fusion.spacing + 3 * fusion.noise);
    carved_value_ = static_cast<float>(0.5 * fusion.spacing);
    for (const DepthView& view : views) projectors_.emplace_back(view);
  }

  void fuse(const Vec3& start, double spacing, float* values) {
    std::fill(top_.begin(), top_.end(), nothing);
    std::fill(carved_.begin(), carved_.end(), 0);
    for (std::size_t v = 0; v < views_.size(); ++v) look(v, start, spacing);
    std::fill(sum_.begin(), sum_.end(), 0.0F);
    std::fill(total_.begin(), total_.end(), 0.0F);
    for (std::size_t v = 0; v < views_.size(); ++v) {
      const float* distance = distance_.data() + v * length_;
      const float* weight = weight_.data() + v * length_;
      for (std::size_t i = 0; i < length_; ++i) {
        const bool counts = distance[i] <= front_ && distance[i] >= top_[i] - window_;
        const float w = counts ? weight[i] : 0.0F;
        sum_[i] += w * (counts ? distance[i] : 0.0F);
        total_[i] += w;
      }
    }
    for (std::size_t i = 0; i < length_; ++i) values[i] = value(i);
  }

 private:
  static constexpr float nothing = -1e30F;

  void look(std::size_t v, const Vec3& start, double spacing) {
    const Eigen::Vector3f first = (views_[v].axes * (start - views_[v].viewpoint)).cast<float>();
    const Eigen::Vector3f step = (spacing * views_[v].axes.col(0)).cast<float>();
    float* distance = distance_.data() + v * length_;
    float* weight = weight_.data() + v * length_;
    for (std::size_t i = 0; i < length_; ++i) {
      const Projector::Look seen = projectors_[v](first + static_cast<float>(i) * step);
      distance[i] = seen.distance;
      weight[i] = seen.weight;
      const bool near = seen.weight > 0 && seen.distance <= front_ && seen.distance >= -behind_;
      top_[i] = std::max(top_[i], near ? seen.distance : nothing);
      carved_[i] |= seen.distance > front_;
    }
  }

  float value(std::size_t i) const {
    const bool near = top_[i] > nothing;
    if (!carved_[i]) return near ? sum_[i] / total_[i] : -front_;
    if (!near) return front_;
    // Seen through, though the views near it say that it lies deeper than the noise explains: behind them.
    return top_[i] > -doubt_ ? sum_[i] / total_[i] : carved_value_;
  }

  std::span<const DepthView> views_;
  std::size_t length_;
  std::vector<Projector> projectors_;
  std::vector<float> distance_, weight_;  // by view and node
  std::vector<float> top_, sum_, total_;
  std::vector<char> carved_;
  float front_, behind_, window_, doubt_, carved_value_;
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

}  // namespace

NodeGrid fuse_depths(std::span<const DepthView> views, const DepthFusion& fusion, const Vec3& low, const Vec3& high,
                     Context& context) {
  const Vec3 margin = Vec3::Constant(3 * fusion.spacing);
  NodeGrid grid = make_node_grid(low - margin, high + margin, fusion.spacing);
  context.parallel_for(grid.size[1] * grid.size[2], 256, [&](std::size_t first, std::size_t last) {
    RowFusion row(views, fusion, grid.size[0]);
    for (std::size_t r = first; r < last; ++r)
      row.fuse(grid.position(0, r % grid.size[1], r / grid.size[1]), grid.spacing,
               grid.values.data() + r * grid.size[0]);
  });
  clear_border(grid);
  Filler(grid).run();
  return grid;
}

std::vector<char> measured_near(std::span<const DepthView> views, std::span<const Vec3> points, double tolerance,
                                Context& context) {
  std::vector<char> measured(points.size(), 0);
  context.parallel_for(points.size(), 1024, [&](std::size_t first, std::size_t last) {
    for (const DepthView& view : views) {
      const Projector project(view);
      for (std::size_t i = first; i < last; ++i) {
        const Eigen::Vector3f p = (view.axes * (points[i] - view.viewpoint)).cast<float>();
        const Projector::Look seen = project(p);
        if (seen.weight > 0 && std::abs(seen.distance) <= static_cast<float>(tolerance)) measured[i] = 1;
      }
    }
  });
  return measured;
}

}  // namespace toposcope
