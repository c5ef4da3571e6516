// SPDX-License-Identifier: BSD-3-Clause
// Where to start: the fit itself only descends. Corners of the box serve for the shapes of wings and fins, means of
// slices and sectors for any number of segments.

#include <algorithm>
#include <array>
#include <cmath>

#include "objective.h"

namespace toposcope::line_group {
namespace {

constexpr std::size_t extreme_count = 6, coarse_points = 40, best_paths = 4;
constexpr std::size_t longest_path = 4;  // vertices: the number of paths grows with its factorial

/// Cuts the longest segment until there are as many as asked for.
void split(Polyline& polyline, std::size_t segments) {
  while (polyline.segments() < segments) {
    std::size_t longest = 0;
    for (std::size_t k = 1; k < polyline.segments(); ++k)
      if (polyline.length(k) > polyline.length(longest) * (1 + 1e-9)) longest = k;
    const Vec3 middle = (polyline.vertices[polyline.tail(longest)] + polyline.vertices[polyline.head(longest)]) / 2;
    polyline.vertices.insert(polyline.vertices.begin() + static_cast<std::ptrdiff_t>(longest + 1), middle);
  }
}

/// Means of `count` equally populated runs of the ranking, which begins at `first`; the same runs either way round.
std::vector<Vec3> run_means(const std::vector<std::pair<double, Vec3>>& ranking, std::size_t first, std::size_t count) {
  std::vector<Vec3> means(count, Vec3::Zero());
  const std::size_t n = ranking.size();
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t begin = (k * n + count - 1) / count, end = std::max((k + 1) * n / count, begin + 1);
    for (std::size_t i = begin; i < end; ++i)
      means[k] += ranking[(first + i) % n].second / static_cast<double>(end - begin);
  }
  return means;
}

std::vector<std::pair<double, Vec3>> ranked(const std::vector<Vec3>& points, const auto& key) {
  std::vector<std::pair<double, Vec3>> ranking;
  ranking.reserve(points.size());
  for (const Vec3& point : points) ranking.emplace_back(key(point), point);
  std::sort(ranking.begin(), ranking.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  return ranking;
}

void add_open_box_starts(const std::array<Vec3, 4>& corner, std::size_t segments, std::vector<Polyline>& all) {
  const auto mid = [&](std::size_t a, std::size_t b) -> Vec3 { return (corner[a % 4] + corner[b % 4]) / 2; };
  for (std::size_t k = 0; k < 4; ++k) {
    const Vec3 &a = corner[k], &b = corner[(k + 1) % 4], &c = corner[(k + 2) % 4], &d = corner[(k + 3) % 4];
    if (segments == 2) {
      all.push_back({{a, b, c}, false});
      all.push_back({{a, mid(k + 2, k + 3), b}, false});
    } else {
      all.push_back({{a, b, c, d}, false});  // U, open towards side d a
      if (k < 2) {                           // zig-zag: two parallel sides and a diagonal
        all.push_back({{a, b, d, c}, false});
        all.push_back({{b, a, c, d}, false});
      }
    }
  }
}

void add_closed_box_starts(const std::array<Vec3, 4>& corner, std::size_t segments, std::vector<Polyline>& all) {
  const auto mid = [&](std::size_t a, std::size_t b) -> Vec3 { return (corner[a % 4] + corner[b % 4]) / 2; };
  if (segments == 3)
    for (std::size_t k = 0; k < 4; ++k) {
      all.push_back({{corner[k], corner[(k + 1) % 4], mid(k + 2, k + 3)}, true});
      all.push_back({{corner[k], corner[(k + 1) % 4], corner[(k + 2) % 4]}, true});
    }
  else
    all.push_back({{corner[0], corner[1], corner[2], corner[3]}, true}),
        all.push_back({{mid(0, 1), mid(1, 2), mid(2, 3), mid(3, 0)}, true});
}

/// Sectors of equal population around the box's centre; an open polyline begins at the widest gap.
void add_sector_starts(const Problem& problem, std::vector<Polyline>& all) {
  const Vec3 &u = problem.box.axes[0], &v = problem.box.axes[1];
  const auto ranking = ranked(problem.points, [&](const Vec3& point) {
    const Vec3 arm = point - problem.box.center;
    return std::atan2(arm.dot(v), arm.dot(u));
  });
  const std::size_t n = ranking.size(), count = problem.segments + (problem.closed ? 0 : 1);
  std::size_t gap = 0;
  double widest = ranking.front().first + 2 * pi - ranking.back().first;
  for (std::size_t i = 1; i < n; ++i)
    if (ranking[i].first - ranking[i - 1].first > widest) widest = ranking[i].first - ranking[i - 1].first, gap = i;
  for (std::size_t phase = 0; phase < (problem.closed ? 3 : 1); ++phase)
    all.push_back({run_means(ranking, gap + phase * n / (3 * count), count), problem.closed});
}

/// The points that lie farthest from each other, one after the other: ends and corners of most shapes.
std::vector<Vec3> extreme_points(const std::vector<Vec3>& points, std::size_t count) {
  std::vector<double> distance(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) distance[i] = points[i].squaredNorm();
  std::vector<Vec3> extremes;
  for (std::size_t k = 0; k < count; ++k) {
    const auto farthest = std::max_element(distance.begin(), distance.end());
    if (!(*farthest > 0)) break;
    extremes.push_back(points[static_cast<std::size_t>(farthest - distance.begin())]);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double d2 = (points[i] - extremes.back()).squaredNorm();
      distance[i] = k == 0 ? d2 : std::min(distance[i], d2);
    }
  }
  return extremes;
}

/// Extends `path` by every choice of the extremes that it lacks.
void extend_paths(const std::vector<Vec3>& extremes, std::size_t length, std::vector<std::size_t>& path,
                  std::vector<std::vector<std::size_t>>& paths) {
  if (path.size() == length) {
    paths.push_back(path);
    return;
  }
  for (std::size_t i = 0; i < extremes.size(); ++i) {
    if (std::find(path.begin(), path.end(), i) != path.end()) continue;
    path.push_back(i);
    extend_paths(extremes, length, path, paths);
    path.pop_back();
  }
}

/// The best of all paths over extreme points: they find corners wherever the box has none.
void add_extreme_starts(const Problem& problem, std::vector<Polyline>& all) {
  const std::size_t length = problem.segments + (problem.closed ? 0 : 1);
  const std::vector<Vec3> coarse = representatives(problem.points, Vec3::Zero(), coarse_points);
  const std::vector<Vec3> extremes = extreme_points(problem.points, extreme_count);
  const PathCosts costs(extremes, coarse, coarse_width(problem), coarse_gap(problem, coarse.size()));
  std::vector<std::size_t> path;
  std::vector<std::vector<std::size_t>> paths;
  extend_paths(extremes, length, path, paths);
  std::vector<std::pair<double, Polyline>> ranking;
  for (const std::vector<std::size_t>& each : paths) {
    if (each.front() > each.back()) continue;  // the same path the other way round
    if (problem.closed && each.front() != *std::min_element(each.begin(), each.end())) continue;
    Polyline polyline{{}, problem.closed};
    for (const std::size_t i : each) polyline.vertices.push_back(extremes[i]);
    ranking.emplace_back(costs.of(each, problem.closed), std::move(polyline));
  }
  const std::size_t few = std::min(best_paths, ranking.size());
  std::partial_sort(ranking.begin(), ranking.begin() + static_cast<std::ptrdiff_t>(few), ranking.end(),
                    [](const auto& a, const auto& b) { return a.first < b.first; });
  for (std::size_t i = 0; i < few; ++i) all.push_back(std::move(ranking[i].second));
}

}  // namespace

std::vector<Polyline> starts(const Problem& problem) {
  const Box& box = problem.box;
  const Vec3 u = 0.475 * box.a() * box.axes[0], v = 0.475 * box.b() * box.axes[1];  // a little inside
  const std::array<Vec3, 4> corner = {box.center - u - v, box.center + u - v, box.center + u + v, box.center - u + v};
  std::vector<Polyline> all;
  if (problem.closed)
    add_closed_box_starts(corner, problem.segments, all);
  else
    add_open_box_starts(corner, problem.segments, all);
  for (Polyline& polyline : all) split(polyline, problem.segments);
  if (problem.segments + (problem.closed ? 0 : 1) <= longest_path) add_extreme_starts(problem, all);
  if (problem.points.size() > 2 * (problem.segments + 1)) {
    add_sector_starts(problem, all);
    if (!problem.closed) {  // slices across the longest and the middle axis: graphs over an axis
      for (int axis = 0; axis < 2; ++axis) {
        const Vec3& direction = box.axes[static_cast<std::size_t>(axis)];
        const auto ranking = ranked(problem.points, [&](const Vec3& point) { return point.dot(direction); });
        all.push_back({run_means(ranking, 0, problem.segments + 1), false});
      }
    }
  }
  return all;
}

}  // namespace toposcope::line_group
