// SPDX-License-Identifier: BSD-3-Clause
#include "sample/lifting_surface.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

namespace toposcope {

namespace {

constexpr double thickest = 0.3;  ///< where the section is thickest, in chords
constexpr double nose = 0.6;      ///< radius of the leading edge, in parts of half the section's thickness

double cross(const Vec2& a, const Vec2& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// A line of ball centres along the span and their radii.
struct Ray {
  Vec2 from, to;
  double from_radius, to_radius;

  Vec2 at(double v) const { return from + share(v) * (to - from); }
  double radius(double v) const { return from_radius + share(v) * (to_radius - from_radius); }
  double share(double v) const { return (v - from.y()) / (to.y() - from.y()); }
};

/// Rounds a corner by a parabola, in few straight steps.
void round_corner(std::vector<Vec2>& line, const Vec2& before, const Vec2& corner, const Vec2& after, double length) {
  if (length <= 0) {
    line.push_back(corner);
    return;
  }
  const Vec2 back = (before - corner).normalized() * length, on = (after - corner).normalized() * length;
  constexpr int steps = 5;
  for (int i = 0; i <= steps; ++i) {
    const double t = double(i) / steps;
    line.push_back(corner + (1 - t) * (1 - t) * back + t * t * on);
  }
}

}  // namespace

double Planform::leading_edge(double along) const {
  return along * std::tan(sweep);
}

bool LiftingSurface::Strip::contains(const Vec2& x) const {
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2& a = polygon[i];
    const Vec2& b = polygon[i + 1 == polygon.size() ? 0 : i + 1];
    if (cross(b - a, x - a) < 0) return false;
  }
  return true;
}

void LiftingSurface::add_rib(const Vec2& from, double radius, const Vec2& to, double to_radius) {
  Rib rib;
  rib.from = from;
  rib.length = (to - from).norm();
  if (rib.length <= 0) return;
  rib.along = (to - from) / rib.length;
  rib.radius = radius;
  rib.slope = (to_radius - radius) / rib.length;
  rib.stretch = rib.slope / std::sqrt(1 - rib.slope * rib.slope);
  ribs_.push_back(rib);
}

LiftingSurface::LiftingSurface(const Planform& p)
    : origin_(p.origin), u_(p.u), v_(p.v), normal_(p.u.cross(p.v)), tip_line_(p.span) {
  // Balls touch the lines of leading and trailing edge from within. All is in proportion to the chord, so that the
  // radius is linear on either side of the thickest part.
  const double half = p.thickness / 2;
  const Vec2 lead[2] = {{0, 0}, {p.leading_edge(p.span), p.span}};
  const Vec2 trail[2] = {{p.root_chord, 0}, {p.leading_edge(p.span) + p.tip_chord, p.span}};
  const double chord[2] = {p.root_chord, p.tip_chord};
  const auto inwards = [](const Vec2* line, double side) {
    const Vec2 along = (line[1] - line[0]).normalized();
    return Vec2(side * along.y(), -side * along.x());
  };
  const Vec2 aft = inwards(lead, 1), fore = inwards(trail, -1);
  const auto ray = [&](const Vec2* line, const Vec2& shift, double radius) {
    return Ray{line[0] + chord[0] * shift, line[1] + chord[1] * shift, chord[0] * radius, chord[1] * radius};
  };
  const double front_radius = nose * half, back_radius = p.trailing * half;
  const Ray front = ray(lead, front_radius * aft, front_radius);
  const Ray ridge = ray(lead, Vec2(thickest, 0), half);
  const Ray back = ray(trail, back_radius * fore, back_radius);
  // The thickest ball at the tip touches its line: v + radius(v) = span.
  const double end = (p.span - ridge.from_radius) / (1 + (ridge.to_radius - ridge.from_radius) / p.span);

  const auto make_strip = [&](const Ray& edge, bool leading) {
    const Vec2 root = edge.at(0), corner = edge.at(end), ridge_root = ridge.at(0), ridge_tip = ridge.at(end);
    Eigen::Matrix2d across;
    across << (root - ridge_root).transpose(), (ridge_tip - ridge_root).transpose();
    const Vec2 rise(edge.radius(0) - ridge.radius(0), ridge.radius(end) - ridge.radius(0));
    Strip strip;
    strip.base = ridge_root;
    strip.radius = ridge.radius(0);
    strip.slope = across.inverse() * rise;
    strip.stretch = 1 / std::sqrt(1 - strip.slope.squaredNorm());
    std::vector<Vec2> outer = {root};  // from the root to the tip of the ridge
    const double length = std::min(p.tip_rounding * (ridge_tip - corner).norm(), 0.8 * (corner - root).norm());
    round_corner(outer, root, corner, ridge_tip, length);
    if (p.tip_rounding < 1) outer.push_back(ridge_tip);
    strip.polygon = outer;
    strip.polygon.push_back(ridge_root);
    double area = 0;
    for (std::size_t i = 0; i < strip.polygon.size(); ++i)
      area += cross(strip.polygon[i], strip.polygon[(i + 1) % strip.polygon.size()]);
    if (area < 0) std::reverse(strip.polygon.begin(), strip.polygon.end());
    if (!leading) std::reverse(outer.begin(), outer.end());
    for (const Vec2& x : outer) {
      if (!boundary_.empty() && (boundary_.back() - x).norm() < 1e-9 * p.span) continue;
      boundary_.push_back(x);
      radii_.push_back(strip.radius_at(x));
    }
    return strip;
  };
  strips_ = {make_strip(front, true), make_strip(back, false)};
  for (std::size_t i = 0; i + 1 < boundary_.size(); ++i)
    add_rib(boundary_[i], radii_[i], boundary_[i + 1], radii_[i + 1]);
  add_rib(ridge.at(0), ridge.radius(0), ridge.at(end), ridge.radius(end));
  add_rib(boundary_.front(), radii_.front(), ridge.at(0), ridge.radius(0));
  add_rib(ridge.at(0), ridge.radius(0), boundary_.back(), radii_.back());

  low_ = Vec3::Constant(std::numeric_limits<double>::infinity());
  high_ = -low_;
  const auto include = [&](const Vec2& x, double radius) {
    low_ = low_.cwiseMin(lift(x) - Vec3::Constant(radius));
    high_ = high_.cwiseMax(lift(x) + Vec3::Constant(radius));
  };
  for (std::size_t i = 0; i < boundary_.size(); ++i) include(boundary_[i], radii_[i]);
  include(ridge.at(0), ridge.radius(0));
  thinnest_ = 2 * *std::min_element(radii_.begin(), radii_.end());
}

Distance LiftingSurface::operator()(const Vec3& point) const {
  const Vec3 offset = point - origin_;
  const Vec2 q(offset.dot(u_), offset.dot(v_));
  const double side = offset.dot(normal_), height = std::abs(side);
  // The ball that comes nearest solves a convex problem: a solution within a strip is the solution.
  for (const Strip& strip : strips_) {
    if (!strip.contains(q + height * strip.stretch * strip.slope)) continue;
    const Vec3 gradient = -strip.slope.x() * u_ - strip.slope.y() * v_ + (side < 0 ? -1 : 1) / strip.stretch * normal_;
    return {height / strip.stretch - strip.radius_at(q), gradient};
  }
  Distance best{std::numeric_limits<double>::infinity(), Vec3::Zero()};
  Vec2 best_center = Vec2::Zero();
  double best_reach = 1;
  for (const Rib& rib : ribs_) {
    const Vec2 to = q - rib.from;
    const double foot = to.dot(rib.along);
    const double aside2 = std::max(0.0, to.squaredNorm() - foot * foot) + height * height;
    const double t = std::clamp(foot + rib.stretch * std::sqrt(aside2), 0.0, rib.length);
    const double reach = std::sqrt(aside2 + (t - foot) * (t - foot));
    const double value = reach - rib.radius - rib.slope * t;
    if (value >= best.value) continue;
    best.value = value;
    best_center = rib.from + t * rib.along;
    best_reach = reach;
  }
  const Vec2 away = q - best_center;
  best.gradient = best_reach > 0 ? Vec3((away.x() * u_ + away.y() * v_ + side * normal_) / best_reach) : normal_;
  return best;
}

std::vector<LiftingSurface::Piece> LiftingSurface::outline() const {
  std::vector<Piece> pieces;
  Vec2 last = Vec2::Zero();
  for (std::size_t i = 0; i + 1 < boundary_.size(); ++i) {
    const double length = (boundary_[i + 1] - boundary_[i]).norm();
    const Vec2 along = (boundary_[i + 1] - boundary_[i]) / length;
    const double slope = (radii_[i + 1] - radii_[i]) / length;
    const Vec2 spoke = -slope * along + std::sqrt(1 - slope * slope) * Vec2(-along.y(), along.x());
    const auto line = [&](const Vec2& x) { return Vec3(x.x() * u_ + x.y() * v_); };
    if (i > 0) {
      Piece arc;
      arc.center = lift(boundary_[i]);
      arc.begin = line(last);
      arc.end = line(spoke);
      arc.radius = radii_[i];
      arc.from = arc.center + arc.radius * arc.begin;
      arc.to = arc.center + arc.radius * arc.end;
      arc.length = arc.radius * std::atan2(std::abs(cross(last, spoke)), last.dot(spoke));
      if (arc.length > 0) pieces.push_back(arc);
    }
    Piece straight;
    straight.from = lift(boundary_[i] + radii_[i] * spoke);
    straight.to = lift(boundary_[i + 1] + radii_[i + 1] * spoke);
    straight.length = (straight.to - straight.from).norm();
    pieces.push_back(straight);
    last = spoke;
  }
  return pieces;
}

std::array<Vec3, 2> LiftingSurface::tip_corners() const {
  const std::vector<Piece> pieces = outline();
  const auto at_tip = [&](const Piece& line) {
    const double from = (line.from - origin_).dot(v_), to = (line.to - origin_).dot(v_);
    return Vec3(line.from + (tip_line_ - from) / (to - from) * (line.to - line.from));
  };
  return {at_tip(pieces.front()), at_tip(pieces.back())};
}

}  // namespace toposcope
