// SPDX-License-Identifier: BSD-3-Clause
#include "objective.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace toposcope::line_group {
namespace {

constexpr std::size_t pieces_per_segment = 8;  // where a polyline is held against the points
constexpr double piece_weight = 4;             // of the polyline's pieces against the points
constexpr double infinity = std::numeric_limits<double>::infinity();

double share_of(std::size_t piece) {
  return (static_cast<double>(piece) + 0.5) / static_cast<double>(pieces_per_segment);
}

double weight_of_a_piece(std::size_t segments) {
  return piece_weight / static_cast<double>(segments * pieces_per_segment);
}

/// Where the anchor nearest to `piece` is, unless one lies within `gap`: then any such. `beside` is tried first.
struct Anchor {
  double squared = infinity;
  std::size_t place = 0;
};
Anchor anchor_of(const Vec3& piece, std::span<const Vec3> anchors, double gap, std::size_t beside) {
  const double free = gap * gap;
  Anchor nearest{(piece - anchors[beside]).squaredNorm(), beside};
  for (std::size_t i = 0; i < anchors.size() && nearest.squared > free; ++i)
    if (const double d2 = (piece - anchors[i]).squaredNorm(); d2 < nearest.squared) nearest = {d2, i};
  return nearest;
}

/// What the points of one segment add to its normal equations: the blocks of all that lie beside it are the same but
/// for their factors, since sliding along the segment costs nothing.
struct Sums {
  double tail_tail = 0, tail_head = 0, head_head = 0;  ///< of the points beside the segment
  double at_tail = 0, at_head = 0;                     ///< of the points beyond an end
  Vec3 to_tail = Vec3::Zero(), to_head = Vec3::Zero();

  void add(double weight, double t, const Vec3& difference) {
    to_tail += (weight * (1 - t)) * difference;
    to_head += (weight * t) * difference;
    if (t <= 0) {
      at_tail += weight;
    } else if (t >= 1) {
      at_head += weight;
    } else {
      tail_tail += weight * (1 - t) * (1 - t);
      tail_head += weight * (1 - t) * t;
      head_head += weight * t * t;
    }
  }

  void add_to(NormalEquations& equations, const Segment& segment, std::size_t tail, std::size_t head) const {
    const Vec3 unit = segment.along.normalized();
    const Eigen::Matrix3d all = Eigen::Matrix3d::Identity(), across = all - unit * unit.transpose();
    const auto block = [&](std::size_t i, std::size_t j) { return equations.matrix.block<3, 3>(3 * i, 3 * j); };
    block(tail, tail) += tail_tail * across + at_tail * all;
    block(head, head) += head_head * across + at_head * all;
    block(tail, head) += tail_head * across;
    block(head, tail) += tail_head * across;
    equations.gradient.segment<3>(3 * tail) -= to_tail;
    equations.gradient.segment<3>(3 * head) -= to_head;
  }
};

}  // namespace

double Objective::pull_of_points(const Polyline& polyline, NormalEquations* equations) {
  const std::size_t segments = polyline.segments();
  segments_.clear();
  for (std::size_t k = 0; k < segments; ++k)
    segments_.emplace_back(polyline.vertices[polyline.tail(k)], polyline.vertices[polyline.head(k)]);
  std::vector<Sums> sums(equations ? segments : 0);
  const double share = 1 / static_cast<double>(points_.size()), inverse_width2 = 1 / (width_ * width_);
  double cost = 0;
  for (const Vec3& point : points_) {
    const Nearest at = nearest(segments_, point);
    const double fall = 1 + at.squared * inverse_width2;
    cost += 0.5 * share * at.squared / fall;
    if (equations) sums[at.segment].add(share / (fall * fall), at.t, at.difference);
  }
  for (std::size_t k = 0; k < sums.size(); ++k)
    sums[k].add_to(*equations, segments_[k], polyline.tail(k), polyline.head(k));
  return cost;
}

double Objective::pull_of_anchors(const Polyline& polyline, NormalEquations* equations) {
  const std::size_t segments = polyline.segments();
  const double weight = weight_of_a_piece(segments);
  beside_.resize(segments * pieces_per_segment, 0);
  double cost = 0;
  for (std::size_t k = 0; k < segments; ++k) {
    const std::size_t ends[] = {polyline.tail(k), polyline.head(k)};
    const Vec3 &tail = polyline.vertices[ends[0]], &head = polyline.vertices[ends[1]];
    for (std::size_t i = 0; i < pieces_per_segment; ++i) {
      const double t = share_of(i);
      const Vec3 piece = (1 - t) * tail + t * head;
      std::size_t& beside = beside_[k * pieces_per_segment + i];
      const Anchor anchor = anchor_of(piece, anchors_, gap_, beside);
      beside = anchor.place;
      const double distance = std::sqrt(anchor.squared), beyond = distance - gap_;
      if (beyond <= 0) continue;
      cost += 0.5 * weight * beyond * beyond;
      if (!equations) continue;
      const Vec3 unit = (piece - anchors_[anchor.place]) / distance;
      const double part = beyond / distance;
      const Eigen::Matrix3d block =
          weight * (part * part * Eigen::Matrix3d::Identity() + (1 - part * part) * unit * unit.transpose());
      const double shares[] = {1 - t, t};
      for (int p = 0; p < 2; ++p) {
        equations->gradient.segment<3>(3 * ends[p]) += shares[p] * weight * beyond * unit;
        for (int q = 0; q < 2; ++q)
          equations->matrix.block<3, 3>(3 * ends[p], 3 * ends[q]) += shares[p] * shares[q] * block;
      }
    }
  }
  return cost;
}

double Objective::evaluate(const Polyline& polyline, NormalEquations* equations) {
  if (equations) {
    const auto size = static_cast<Eigen::Index>(3 * polyline.vertices.size());
    equations->matrix.setZero(size, size);
    equations->gradient.setZero(size);
  }
  const double points = pull_of_points(polyline, equations);
  return points + pull_of_anchors(polyline, equations);
}

PathCosts::PathCosts(std::span<const Vec3> vertices, std::span<const Vec3> points, double width, double gap)
    : vertices_(vertices.size()),
      points_(points.size()),
      width_(width),
      squared_(vertices_ * vertices_ * points_),
      beyond_(vertices_ * vertices_) {
  for (std::size_t i = 0; i < vertices_; ++i)
    for (std::size_t j = 0; j < vertices_; ++j) {
      const std::size_t at = pair(i, j);
      const Segment segment(vertices[i], vertices[j]);
      for (std::size_t p = 0; p < points_; ++p) squared_[at * points_ + p] = nearest({&segment, 1}, points[p]).squared;
      std::size_t beside = 0;
      for (std::size_t k = 0; k < pieces_per_segment; ++k) {
        const Anchor anchor = anchor_of(vertices[i] + share_of(k) * segment.along, points, gap, beside);
        beside = anchor.place;
        const double beyond = std::max(0.0, std::sqrt(anchor.squared) - gap);
        beyond_[at] += 0.5 * beyond * beyond;
      }
    }
}

double PathCosts::of(std::span<const std::size_t> path, bool closed) const {
  const std::size_t segments = path.size() - (closed ? 0 : 1);
  const auto segment = [&](std::size_t k) { return pair(path[k], path[(k + 1) % path.size()]); };
  double points = 0, pieces = 0;
  for (std::size_t k = 0; k < segments; ++k) pieces += beyond_[segment(k)];
  for (std::size_t p = 0; p < points_; ++p) {
    double least = infinity;
    for (std::size_t k = 0; k < segments; ++k) least = std::min(least, squared_[segment(k) * points_ + p]);
    points += 0.5 * least / (1 + least / (width_ * width_));
  }
  return points / static_cast<double>(points_) + weight_of_a_piece(segments) * pieces;
}

}  // namespace toposcope::line_group
