// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "shape_fixture.h"

namespace toposcope::test {

/// Checked arguments as the kernel would hand them over.
inline Arguments line_group(int segments, bool closed = false, const std::string& ends = "extent") {
  return Arguments(PluginKind::shapes, "line-group",
                   {{"segments", std::to_string(segments)}, {"closed", closed ? "true" : "false"}, {"ends", ends}});
}

using Corners = std::vector<Vec3>;

/// Points along the polyline, `step` apart (corners included), with normal noise across and along.
inline PointSets sampled(Corners corners, bool closed, double step, double noise = 0, std::uint64_t seed = 1) {
  Random random(seed);
  if (closed) corners.push_back(corners.front());
  PointSets sets;
  sets.mean_edge = step;
  for (std::size_t k = 0; k + 1 < corners.size(); ++k) {
    const int count = static_cast<int>(std::round((corners[k + 1] - corners[k]).norm() / step));
    for (int i = 0; i < count; ++i)
      sets.points.push_back(corners[k] + (corners[k + 1] - corners[k]) * i / count + random.normal3(noise));
  }
  if (!closed) sets.points.push_back(corners.back() + random.normal3(noise));
  return sets;
}

inline Corners endpoints(const FittedShape& fitted) {
  const std::vector<double>& values = parameter_values(fitted, "endpoints");
  Corners corners;
  for (std::size_t i = 0; i < values.size(); i += 3) corners.push_back(Vec3(&values[i]));
  return corners;
}

/// Greatest distance between matching endpoints, over the orders in which they may be listed.
inline double mismatch(const Corners& found, const Corners& truth, bool closed) {
  if (found.size() != truth.size()) return std::numeric_limits<double>::infinity();
  const std::size_t n = truth.size();
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t shift = 0; shift < (closed ? n : 1); ++shift)
    for (const bool reversed : {false, true}) {
      double worst = 0;
      for (std::size_t i = 0; i < n; ++i)
        worst = std::max(worst, (found[i] - truth[reversed ? (2 * n - 1 - i - shift) % n : (i + shift) % n]).norm());
      least = std::min(least, worst);
    }
  return least;
}

}  // namespace toposcope::test
