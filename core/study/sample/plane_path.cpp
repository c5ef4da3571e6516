// SPDX-License-Identifier: BSD-3-Clause
#include "sample/plane_path.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace toposcope {

namespace {

double cross(const Vec2& u, const Vec2& v) {
  return u.x() * v.y() - u.y() * v.x();
}
Vec2 right_of(const Vec2& direction) {
  return {direction.y(), -direction.x()};
}

}  // namespace

void PlanePath::add_line(const Vec2& from, const Vec2& to, double shortest) {
  const Vec2 step = to - from;
  if (step.norm() <= shortest) return;
  const Vec2 normal = right_of(step.normalized());
  elements_.push_back({from, to, normal, normal, from, 0, 0});
}

PlanePath::PlanePath(const std::vector<Corner>& corners) {
  const std::size_t count = corners.size();
  if (count < 2) throw std::logic_error("a path needs two corners");
  std::vector<Vec2> points;
  double extent = 0;
  for (const Corner& corner : corners) {
    points.emplace_back(corner.x, corner.y);
    extent = std::max(extent, (points.back() - points.front()).norm());
  }
  const double shortest = 1e-9 * extent;  // lines of rounding errors between arcs that just touch
  crests_ = begins_ = ends_ = points;

  Vec2 last = points.front();
  for (std::size_t i = 1; i < count; ++i) {
    const Vec2 along = (points[i] - points[i - 1]).normalized();
    Vec2 arc_begin = points[i];
    Element arc;
    if (i + 1 < count && corners[i].radius > 0) {
      const double radius = corners[i].radius;
      const Vec2 next = (points[i + 1] - points[i]).normalized();
      const double angle = std::atan2(cross(along, next), along.dot(next));
      const double tangent = radius * std::tan(std::abs(angle) / 2);
      arc_begin = points[i] - tangent * along;
      arc.from = arc_begin;
      arc.to = points[i] + tangent * next;
      arc.turn = angle > 0 ? 1 : -1;
      arc.radius = radius;
      arc.center = arc.from - arc.turn * radius * right_of(along);
      arc.normal_from = right_of(along);
      arc.normal_to = right_of(next);
      begins_[i] = arc.from;
      ends_[i] = arc.to;
      crests_[i] = arc.center + radius * (points[i] - arc.center).normalized();
    }
    if (along.dot(arc_begin - last) < -shortest) throw std::domain_error("the arcs of a path overlap");
    add_line(last, arc_begin, shortest);
    last = arc_begin;
    if (arc.turn != 0) {
      elements_.push_back(arc);
      last = arc.to;
    }
  }
  joints_.push_back({elements_.front().from, elements_.front().normal_from, true});
  for (std::size_t i = 1; i < elements_.size(); ++i) {
    const Vec2& normal = elements_[i - 1].normal_to;
    const Vec2 bisector = (normal + elements_[i].normal_from).normalized();
    joints_.push_back({elements_[i].from, bisector, normal.dot(bisector) < 1 - 1e-12});
  }
  joints_.push_back({elements_.back().to, elements_.back().normal_to, true});
}

PlanePath::Closest PlanePath::closest(const Vec2& query) const {
  Closest best;
  double best_distance = std::numeric_limits<double>::infinity();
  const auto offer = [&](const Vec2& point, const Vec2& normal, bool sharp) {
    const double distance = (query - point).squaredNorm();
    if (distance >= best_distance) return;
    best_distance = distance;
    best = {point, normal, sharp};
  };
  std::size_t joint_offered = 0;  // the last one: neighbours share it
  for (std::size_t i = 0; i < elements_.size(); ++i) {
    const Element& element = elements_[i];
    if (element.turn == 0) {
      const Vec2 step = element.to - element.from;
      const double t = step.dot(query - element.from) / step.squaredNorm();
      if (t > 0 && t < 1) {
        offer(element.from + t * step, element.normal_from, false);
        continue;
      }
    } else {
      const Vec2 spoke = query - element.center;
      if (element.turn * cross(element.from - element.center, spoke) >= 0 &&
          element.turn * cross(spoke, element.to - element.center) >= 0 && spoke != Vec2::Zero()) {
        const Vec2 outward = spoke.normalized();
        offer(element.center + element.radius * outward, element.turn * outward, false);
        continue;
      }
    }
    if (i == 0 || joint_offered != i) offer(joints_[i].point, joints_[i].normal, joints_[i].sharp);
    offer(joints_[i + 1].point, joints_[i + 1].normal, joints_[i + 1].sharp);
    joint_offered = i + 1;
  }
  return best;
}

}  // namespace toposcope
