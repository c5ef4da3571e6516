// SPDX-License-Identifier: BSD-3-Clause
#include "sample/implicit.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace toposcope {

namespace {

Distance operator-(const Distance& d) {
  return {-d.value, -d.gradient};
}

/// The union of two distances with the fillet that a ball of radius r leaves when it rolls in their corner. In the
/// plane of the two normals the ball's centre c has distance r from both surfaces, so w = c - x satisfies
/// w.n1 = r - d1, w.n2 = r - d2; x sees the fillet while w lies between n1 and n2.
Distance rolling_ball(const Distance& a, const Distance& b, double radius) {
  const Distance& least = a.value <= b.value ? a : b;
  const double u = radius - a.value, v = radius - b.value;
  if (radius <= 0 || (u <= 0 && v <= 0)) return least;
  const double c = std::clamp(a.gradient.dot(b.gradient), -1.0, 1.0);
  const double s2 = 1 - c * c;
  if (s2 < 1e-9) return least;  // surfaces that touch or face each other make no corner
  const double along_a = (u - c * v) / s2, along_b = (v - c * u) / s2;
  if (along_a <= 0 || along_b <= 0) return least;
  const Vec3 w = along_a * a.gradient + along_b * b.gradient;
  const double length = w.norm();
  return {radius - length, w / length};
}

}  // namespace

Implicit revolve(PlanePath profile, const Vec3& origin, const Vec3& axis) {
  return [profile = std::move(profile), origin, axis = axis.normalized().eval()](const Vec3& point) -> Distance {
    const Vec3 offset = point - origin;
    const double height = offset.dot(axis);
    const Vec3 radial = offset - height * axis;
    const double radius = radial.norm();
    const Vec2 query(radius, height);
    const PlanePath::Closest closest = profile.closest(query);
    const Vec2 away = query - closest.point;
    const double side = away.dot(closest.normal);
    const double value = closest.sharp ? std::copysign(away.norm(), side) : side;
    const Vec2 normal = closest.sharp && value != 0 ? Vec2(away / value) : closest.normal;
    const Vec3 outward = radius > 0 ? Vec3(radial / radius) : Vec3(Vec3::Zero());
    return {value, normal.x() * outward + normal.y() * axis};
  };
}

Implicit sweep(PlanePath path, const Vec3& origin, const Vec3& u, const Vec3& v, double radius) {
  return [path = std::move(path), origin, u, v, radius](const Vec3& point) -> Distance {
    const Vec3 offset = point - origin;
    const Vec2 closest = path.closest({offset.dot(u), offset.dot(v)}).point;
    const Vec3 away = offset - closest.x() * u - closest.y() * v;
    const double length = away.norm();
    return {length - radius, length > 0 ? Vec3(away / length) : Vec3(u.cross(v))};
  };
}

Implicit box(const Vec3& center, const Vec3& half_sides, double radius) {
  const Vec3 core = half_sides - Vec3::Constant(radius);
  return [center, core, radius](const Vec3& point) -> Distance {
    const Vec3 offset = point - center;
    const Vec3 over = offset.cwiseAbs() - core;
    const Vec3 sign = offset.unaryExpr([](double x) { return std::copysign(1.0, x); });
    const Vec3 beyond = over.cwiseMax(0.0);
    const double outside = beyond.norm();
    if (outside > 0) return {outside - radius, sign.cwiseProduct(beyond / outside)};
    Eigen::Index nearest = 0;
    const double inside = over.maxCoeff(&nearest);
    return {inside - radius, sign[nearest] * Vec3::Unit(nearest)};
  };
}

Implicit complement(Implicit a) {
  return [a = std::move(a)](const Vec3& point) { return -a(point); };
}

Implicit unite(Implicit a, Implicit b, double fillet) {
  return [a = std::move(a), b = std::move(b), fillet](const Vec3& point) {
    return rolling_ball(a(point), b(point), fillet);
  };
}

Implicit intersect(Implicit a, Implicit b, double rounding) {
  return [a = std::move(a), b = std::move(b), rounding](const Vec3& point) {
    return -rolling_ball(-a(point), -b(point), rounding);
  };
}

Implicit subtract(Implicit a, Implicit b, double rounding) {
  return intersect(std::move(a), complement(std::move(b)), rounding);
}

Implicit mirror_y(Implicit a) {
  return [a = std::move(a)](const Vec3& point) -> Distance {
    Distance d = a({point.x(), std::abs(point.y()), point.z()});
    if (point.y() < 0) d.gradient.y() = -d.gradient.y();
    return d;
  };
}

Implicit within_box(Implicit a, const Vec3& low, const Vec3& high, double margin) {
  return [a = std::move(a), low, high, margin](const Vec3& point) -> Distance {
    const Vec3 away = point - point.cwiseMax(low).cwiseMin(high);
    const double distance2 = away.squaredNorm();
    if (distance2 <= margin * margin) return a(point);
    const double distance = std::sqrt(distance2);
    return {distance, away / distance};
  };
}

Foot settle(const Implicit& surface, Vec3 point, double tolerance) {
  constexpr int most_steps = 60;
  Vec3 last = point;
  double last_value = 0;
  for (int i = 0;; ++i) {
    const Distance d = surface(point);
    const double slope = d.gradient.squaredNorm();
    if (std::abs(d.value) <= tolerance || slope < 1e-6 || i == most_steps) return {point, d.gradient};
    const bool overshot = d.value * last_value < 0 && std::abs(d.value) > 0.3 * std::abs(last_value);
    const Vec3 here = point;
    if (overshot)
      point = last + last_value / (last_value - d.value) * (here - last);
    else
      point -= d.value / slope * d.gradient;
    last = here;
    last_value = d.value;
  }
}

Vec3 project(const Implicit& surface, const Vec3& point, double scale) {
  return settle(surface, point, 1e-12 * scale).point;
}

Vec3 project_to_curve(const Implicit& f, const Implicit& g, Vec3 point) {
  for (int i = 0; i < 40; ++i) {
    const Distance a = f(point), b = g(point);
    const double aa = a.gradient.squaredNorm(), bb = b.gradient.squaredNorm(), ab = a.gradient.dot(b.gradient);
    const double determinant = aa * bb - ab * ab;
    if (determinant < 1e-9 * aa * bb) break;
    const double along_a = (bb * a.value - ab * b.value) / determinant;
    const double along_b = (aa * b.value - ab * a.value) / determinant;
    point -= along_a * a.gradient + along_b * b.gradient;
  }
  return point;
}

}  // namespace toposcope
