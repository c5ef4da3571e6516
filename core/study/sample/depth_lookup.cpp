// SPDX-License-Identifier: BSD-3-Clause
#include "sample/depth_lookup.h"

#include <optional>

namespace toposcope {

DepthLookup::DepthLookup(const DepthView& view)
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
      tile.all.add(cell);
      if (cell.weight > 0) tile.measured.add(cell);
    }
}

DepthLookup::Verdict DepthLookup::judge(const Eigen::Vector3f& center, float radius, float front, float behind) const {
  const Eigen::Vector3f p = axes_ * center + offset_;
  const float first = p.z() - radius, last = p.z() + radius;
  const float reach = radius * focal_ / first * 1.15F + 1;  // 1.15: the ball seen askew
  const float middle = focal_ / p.z(), x = p.x() * middle + center_x_, y = p.y() * middle + center_y_;
  const auto tile = [](float pixel, float greatest) {
    return static_cast<std::uint32_t>(std::min(std::max(pixel, 0.0F), greatest)) / 4;
  };
  const std::uint32_t left = tile(x - reach, last_x_), right = tile(x + reach, last_x_);
  const std::uint32_t top = tile(y - reach, last_y_), bottom = tile(y + reach, last_y_);
  DepthRange all;
  bool near = false;
  for (std::uint32_t row = top; row <= bottom; ++row)
    for (std::uint32_t column = left; column <= right; ++column) {
      const Tile& t = tiles_[static_cast<std::size_t>(row) * tiles_wide_ + column];
      all.add(t.all);
      near = near || !(t.measured.in_front(last, front) || t.measured.behind(first, behind));
    }
  if (all.in_front(last, front)) return Verdict::free;
  if (all.behind(first, behind)) return Verdict::hidden;
  return near ? Verdict::near : Verdict::mixed;
}

std::vector<DepthLookup> lookups_of(std::span<const DepthView> views, Context& context) {
  std::vector<std::optional<DepthLookup>> made(views.size());
  context.parallel_for(views.size(), 4, [&](std::size_t first, std::size_t last) {
    for (std::size_t v = first; v < last; ++v) made[v].emplace(views[v]);
  });
  std::vector<DepthLookup> lookups;
  for (std::optional<DepthLookup>& lookup : made) lookups.push_back(std::move(*lookup));
  return lookups;
}

}  // namespace toposcope
