// SPDX-License-Identifier: BSD-3-Clause
#include "toposcope/geometry/representatives.h"

#include <algorithm>
#include <utility>

namespace toposcope {

std::vector<Vec3> representatives(std::span<const Vec3> points, const Vec3& center, std::size_t limit) {
  std::vector<std::pair<double, Index>> ranking(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    ranking[i] = {(points[i] - center).squaredNorm(), static_cast<Index>(i)};
  std::sort(ranking.begin(), ranking.end());
  const std::size_t count = std::min(limit, points.size());
  std::vector<Vec3> chosen(count);
  for (std::size_t k = 0; k < count; ++k) chosen[k] = points[ranking[k * points.size() / count].second];
  return chosen;
}

}  // namespace toposcope
