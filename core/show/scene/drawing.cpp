// SPDX-License-Identifier: BSD-3-Clause
#include "scene/drawing.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string_view>

#include "toposcope/geometry/lines.h"

namespace toposcope {
namespace {

constexpr Index turn_points = 96;  // of a circle
constexpr Index globe_around = 32, globe_along = 16;

/// Parameters by name; a missing one has no values.
class Parameters {
 public:
  explicit Parameters(std::span<const ShapeParameter> all) : all_(all) {}

  bool are(std::initializer_list<std::string_view> names) const {
    return all_.size() == names.size() && std::all_of(names.begin(), names.end(), [&](std::string_view name) {
             return std::any_of(all_.begin(), all_.end(), [&](const auto& each) { return each.name == name; });
           });
  }
  bool has(std::string_view name) const { return !find(name).empty(); }
  double number(std::string_view name) const { return find(name).front(); }
  Vec3 vector(std::string_view name) const { return points(name).front(); }
  std::vector<Vec3> points(std::string_view name) const {
    const std::vector<double>& values = find(name);
    std::vector<Vec3> list;
    for (std::size_t i = 0; i + 3 <= values.size(); i += 3) list.emplace_back(values[i], values[i + 1], values[i + 2]);
    return list;
  }

 private:
  const std::vector<double>& find(std::string_view name) const {
    static const std::vector<double> none;
    for (const ShapeParameter& each : all_)
      if (each.name == name) return each.values;
    return none;
  }
  std::span<const ShapeParameter> all_;
};

struct Frame {
  Vec3 origin, normal, u, v;
  Frame(const Vec3& at, const Vec3& direction)
      : origin(at), normal(direction.normalized()), u(any_perpendicular(normal)), v(normal.cross(u)) {}
  Vec3 at(double x, double y, double z = 0) const { return origin + x * u + y * v + z * normal; }
};

/// \param count  points of the turn; the first comes again
std::vector<Vec3> circle(const Frame& frame, double radius, double height = 0, Index count = turn_points) {
  std::vector<Vec3> line;
  for (Index i = 0; i <= count; ++i) {
    const double angle = 2 * pi * (i % count) / count;
    line.push_back(frame.at(radius * std::cos(angle), radius * std::sin(angle), height));
  }
  return line;
}

/// Corners of the convex hull, counter-clockwise (Andrew 1979).
std::vector<Eigen::Vector2d> hull(std::vector<Eigen::Vector2d> points) {
  const auto less = [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y());
  };
  std::sort(points.begin(), points.end(), less);
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return points;
  const auto left_turn = [](const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
    return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x()) > 0;
  };
  std::vector<Eigen::Vector2d> corners;
  const auto chain = [&](auto first, auto last) {
    const std::size_t start = corners.size();
    for (auto it = first; it != last; ++it) {
      while (corners.size() >= start + 2 && !left_turn(corners[corners.size() - 2], corners.back(), *it))
        corners.pop_back();
      corners.push_back(*it);
    }
    corners.pop_back();  // begins the other chain
  };
  chain(points.begin(), points.end());
  chain(points.rbegin(), points.rend());
  return corners;
}

Drawing plane_within(const Frame& frame, std::span<const Vec3> region) {
  std::vector<Eigen::Vector2d> flat;
  for (const Vec3& p : region) flat.emplace_back((p - frame.origin).dot(frame.u), (p - frame.origin).dot(frame.v));
  const std::vector<Eigen::Vector2d> corners = hull(std::move(flat));
  Drawing drawing;
  if (corners.size() < 3) return drawing;
  Patch patch;
  for (const Eigen::Vector2d& corner : corners) patch.positions.push_back(frame.at(corner.x(), corner.y()));
  for (Index i = 1; i + 1 < corners.size(); ++i) patch.triangles.push_back({0, i, i + 1});
  drawing.lines.push_back(patch.positions);
  drawing.lines.back().push_back(patch.positions.front());
  drawing.patches.push_back(std::move(patch));
  return drawing;
}

/// Rings of equally many points, joined.
Patch joined(const std::vector<std::vector<Vec3>>& rings) {
  Patch patch;
  const Index n = static_cast<Index>(rings.front().size());
  for (const std::vector<Vec3>& ring : rings) patch.positions.insert(patch.positions.end(), ring.begin(), ring.end());
  for (Index r = 0; r + 1 < rings.size(); ++r)
    for (Index i = 0; i < n; ++i) {
      const Index a = r * n + i, b = r * n + (i + 1) % n;
      patch.triangles.push_back({a, b, b + n});
      patch.triangles.push_back({a, b + n, a + n});
    }
  return patch;
}

std::vector<Vec3> open_ring(const Frame& frame, double radius, double height, Index count) {
  std::vector<Vec3> ring = circle(frame, radius, height, count);
  ring.pop_back();
  return ring;
}

Drawing sphere(const Vec3& center, double radius) {
  const Frame frame(center, Vec3::UnitZ());
  std::vector<std::vector<Vec3>> rings;
  for (Index k = 1; k < globe_along; ++k) {
    const double polar = pi * (1 - static_cast<double>(k) / globe_along);
    rings.push_back(open_ring(frame, radius * std::sin(polar), radius * std::cos(polar), globe_around));
  }
  Drawing drawing;
  Patch patch = joined(rings);
  const Index south = static_cast<Index>(patch.positions.size()), north = south + 1, last = south - globe_around;
  patch.positions.push_back(frame.at(0, 0, -radius));
  patch.positions.push_back(frame.at(0, 0, radius));
  for (Index i = 0; i < globe_around; ++i) {
    const Index next = (i + 1) % globe_around;
    patch.triangles.push_back({south, next, i});
    patch.triangles.push_back({north, last + i, last + next});
  }
  drawing.patches.push_back(std::move(patch));
  for (const Vec3 axis : {Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()})
    drawing.lines.push_back(circle(Frame(center, axis), radius));
  return drawing;
}

Drawing cylinder(const Frame& frame, double radius, std::span<const Vec3> region) {
  Drawing drawing;
  if (region.empty()) return drawing;
  double low = 1e300, high = -1e300;
  for (const Vec3& p : region) {
    const double height = (p - frame.origin).dot(frame.normal);
    low = std::min(low, height), high = std::max(high, height);
  }
  drawing.lines = {circle(frame, radius, low), circle(frame, radius, high)};
  drawing.patches.push_back(
      joined({open_ring(frame, radius, low, globe_around), open_ring(frame, radius, high, globe_around)}));
  return drawing;
}

/// \param half_angle  rad; from the frame's origin along its normal
Drawing cone(const Frame& frame, double half_angle, std::span<const Vec3> region) {
  Drawing drawing;
  if (region.empty()) return drawing;
  double low = 1e300, high = 0;
  for (const Vec3& p : region) {
    const double height = std::max(0.0, (p - frame.origin).dot(frame.normal));
    low = std::min(low, height), high = std::max(high, height);
  }
  const double slope = std::tan(half_angle);
  if (low > 0) drawing.lines.push_back(circle(frame, low * slope, low));
  drawing.lines.push_back(circle(frame, high * slope, high));
  drawing.patches.push_back(
      joined({open_ring(frame, low * slope, low, globe_around), open_ring(frame, high * slope, high, globe_around)}));
  return drawing;
}

Drawing torus(const Frame& frame, double major, double minor) {
  std::vector<std::vector<Vec3>> rings;
  for (Index k = 0; k <= globe_along; ++k) {  // around the tube from inside over below
    const double angle = pi * (2.0 * (k % globe_along) / globe_along - 1);
    rings.push_back(open_ring(frame, major + minor * std::cos(angle), minor * std::sin(angle), 2 * globe_around));
  }
  Drawing drawing;
  drawing.patches.push_back(joined(rings));
  drawing.lines = {circle(frame, major + minor), circle(frame, major - minor)};
  for (const Vec3& out : {frame.u, frame.v, Vec3(-frame.u), Vec3(-frame.v)})
    drawing.lines.push_back(circle(Frame(frame.origin + major * out, out.cross(frame.normal)), minor));
  return drawing;
}

Drawing segments(std::vector<Vec3> ends, bool closed) {
  Drawing drawing;
  drawing.points = ends;
  if (closed && !ends.empty()) ends.push_back(ends.front());
  drawing.lines.push_back(std::move(ends));
  return drawing;
}

}  // namespace

Drawing draw_shape(std::span<const ShapeParameter> parameters, std::span<const Vec3> region,
                   std::span<const Vec3> outline, bool outline_closed) {
  const Parameters given(parameters);
  if (given.are({"center", "normal", "radius"})) {
    Drawing drawing;
    drawing.lines.push_back(circle(Frame(given.vector("center"), given.vector("normal")), given.number("radius")));
    return drawing;
  }
  if (given.are({"point", "normal"})) return plane_within({given.vector("point"), given.vector("normal")}, region);
  if (given.are({"center", "radius"})) return sphere(given.vector("center"), given.number("radius"));
  if (given.are({"point", "axis", "radius"}))
    return cylinder({given.vector("point"), given.vector("axis")}, given.number("radius"), region);
  if (given.are({"apex", "axis", "half_angle"}))
    return cone({given.vector("apex"), given.vector("axis")}, given.number("half_angle") * pi / 180, region);
  if (given.are({"center", "axis", "major_radius", "minor_radius"}))
    return torus({given.vector("center"), given.vector("axis")}, given.number("major_radius"),
                 given.number("minor_radius"));
  if (given.has("endpoints"))
    return segments(given.points("endpoints"), given.has("closed") && given.number("closed") != 0);
  Drawing drawing;
  if (!outline.empty()) {
    drawing.lines.emplace_back(outline.begin(), outline.end());
    if (outline_closed) drawing.lines.back().push_back(outline.front());
  }
  return drawing;
}

}  // namespace toposcope
