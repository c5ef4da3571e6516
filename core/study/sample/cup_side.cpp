// SPDX-License-Identifier: BSD-3-Clause
#include <limits>

#include "sample/cup.h"

namespace toposcope {

namespace {

constexpr double share = 0.7;  ///< of the shorter line that the arc takes: the rest is for lip and foot

}  // namespace

CupSide::CupSide(double bottom_radius, double top_radius, double height, double bulge, double bulge_height)
    : bottom_(bottom_radius, 0), top_(top_radius, height), straight_(bulge == 0) {
  const double on_line = bottom_radius + (top_radius - bottom_radius) * bulge_height / height;
  middle_ = Vec2(on_line + bulge, bulge_height);
  lower_ = std::atan2(middle_.x() - bottom_.x(), middle_.y());
  upper_ = std::atan2(top_.x() - middle_.x(), top_.y() - middle_.y());
  arc_ = straight_ ? std::numeric_limits<double>::infinity()
                   : share * std::min((middle_ - bottom_).norm(), (top_ - middle_).norm()) /
                         std::tan(std::abs(upper_ - lower_) / 2);
}

double CupSide::line(double z, double within) const {
  const double slant = z < middle_.y() ? lower_ : upper_;
  return middle_.x() + (z - middle_.y()) * std::tan(slant) - within / std::cos(slant);
}

double CupSide::radius(double z) const {
  if (straight_) return line(z, 0);
  const double turn = std::abs(upper_ - lower_) / 2, reach = arc_ * std::tan(turn);
  const Vec2 begin = middle_ - reach * Vec2(std::sin(lower_), std::cos(lower_));
  const Vec2 end = middle_ + reach * Vec2(std::sin(upper_), std::cos(upper_));
  if (z <= begin.y() || z >= end.y()) return line(z, 0);
  const double side = bulges() ? 1 : -1;
  const Vec2 center = begin - side * arc_ * Vec2(std::cos(lower_), -std::sin(lower_));
  return center.x() + side * std::sqrt(arc_ * arc_ - (z - center.y()) * (z - center.y()));
}

double CupSide::widest() const {
  double widest = std::max(bottom_.x(), top_.x());
  if (!straight_ && bulges()) widest = std::max(widest, middle_.x());
  return widest;
}

std::vector<Corner> CupSide::corners(double within, double from, double to) const {
  std::vector<Corner> corners = {{line(from, within), from}};
  if (!straight_) {
    const double half = (lower_ + upper_) / 2, inward = within / std::cos((lower_ - upper_) / 2);
    corners.push_back({middle_.x() - inward * std::cos(half), middle_.y() + inward * std::sin(half),
                       bulges() ? arc_ - within : arc_ + within});
  }
  corners.push_back({line(to, within), to});
  return corners;
}

}  // namespace toposcope
