// SPDX-License-Identifier: BSD-3-Clause
// The account of a surface of revolution, and its outline.

#include "revolution.h"

#include <Eigen/Dense>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "toposcope/geometry/chords.h"
#include "toposcope/geometry/point_sets.h"
#include "toposcope/geometry/turn_coverage.h"

namespace toposcope {
namespace {

constexpr double noise_floor_scales = 0.02;  // the least noise to assume: exact points leave the loss some width
constexpr std::size_t outline_limit = 512;

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Why no points like these determine a surface, or nothing.
std::string degeneracy(const PrincipalAxes& axes) {
  const double rounding = 1e-12 * axes.centroid.norm(), spread = std::sqrt(axes.variance[0]);
  const auto least = std::max(1e-6 * spread, rounding);
  if (!(spread > rounding) || !(std::sqrt(axes.variance[1]) > least))
    return "the points lie on one line or in one spot";
  if (!(std::sqrt(axes.variance[2]) > least)) return "the points lie in one plane";
  return {};
}

/// Inverse of a normal matrix whose variances end at `limit`: a direction that the points leave open is uncertain, not
/// exact as a pseudo-inverse would have it.
Eigen::MatrixXd inverse_up_to(const Eigen::MatrixXd& information, double limit) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(information);
  const Eigen::VectorXd variance = eigen.eigenvalues().cwiseMax(1 / limit).cwiseInverse();
  return eigen.eigenvectors() * variance.asDiagonal() * eigen.eigenvectors().transpose();
}

}  // namespace

std::vector<double> RevolutionAccount::of(std::span<const double> derivatives) const {
  const Eigen::Index size = freedom.count();
  const Eigen::Map<const RowMajor> inner(covariance.data(), size, size);
  const Eigen::Map<const RowMajor> spread(derivatives.data(), static_cast<Eigen::Index>(derivatives.size()) / size,
                                          size);
  const RowMajor all = spread * inner * spread.transpose();
  return {all.data(), all.data() + all.size()};
}

std::vector<double> RevolutionAccount::point_on_axis(double height) const {
  const auto size = static_cast<std::size_t>(freedom.count()), shifts = static_cast<std::size_t>(freedom.shifts);
  std::vector<double> rows(3 * size, 0);
  for (std::size_t row = 0; row < 3; ++row) {
    const auto axis = static_cast<Eigen::Index>(row);
    for (std::size_t k = 0; k < shifts; ++k) rows[row * size + k] = frame[k][axis];
    for (std::size_t k = 0; k < static_cast<std::size_t>(freedom.tilts); ++k)
      rows[row * size + shifts + k] = height * frame[k][axis];
  }
  return rows;
}

std::vector<double> RevolutionAccount::axis_direction() const {
  const auto size = static_cast<std::size_t>(freedom.count()), shifts = static_cast<std::size_t>(freedom.shifts);
  std::vector<double> rows(3 * size, 0);
  for (std::size_t row = 0; row < 3; ++row)
    for (std::size_t k = 0; k < static_cast<std::size_t>(freedom.tilts); ++k)
      rows[row * size + shifts + k] = frame[k][static_cast<Eigen::Index>(row)];
  return rows;
}

AxisPosition position(const Revolution& surface, const Vec3& point) {
  const Vec3 arm = point - surface.origin;
  const double height = arm.dot(surface.axis);
  return {(arm - height * surface.axis).norm(), height};
}

std::optional<PlaneCircle> plane_circle(std::span<const std::array<double, 2>> points) {
  double mean[2] = {0, 0}, spread = 0;
  const double n = static_cast<double>(points.size());
  for (const auto& p : points) mean[0] += p[0] / n, mean[1] += p[1] / n;
  for (const auto& p : points) spread += std::pow(p[0] - mean[0], 2) + std::pow(p[1] - mean[1], 2);
  const double unit = std::sqrt(spread / n);
  if (!(unit > 0)) return std::nullopt;
  Eigen::Matrix3d matrix = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (const auto& p : points) {
    const Eigen::Vector3d row(2 * (p[0] - mean[0]) / unit, 2 * (p[1] - mean[1]) / unit, 1);
    matrix += row * row.transpose() / n;
    right += row * (row.head<2>().squaredNorm() / 4) / n;
  }
  const auto solver = Eigen::FullPivLU<Eigen::Matrix3d>(matrix).setThreshold(1e-9);
  if (!solver.isInvertible()) return std::nullopt;
  const Eigen::Vector3d solved = solver.solve(right);
  const double radius = std::sqrt(solved[2] + solved.head<2>().squaredNorm());
  if (!std::isfinite(radius)) return std::nullopt;
  return PlaneCircle{mean[0] + unit * solved[0], mean[1] + unit * solved[1], unit * radius};
}

namespace revolution {

std::optional<RevolutionAccount> account_for(const RevolutionKind& kind, const Revolution& surface,
                                             const FitInput& input, const PrincipalAxes& principal,
                                             const Witnesses& witnesses, FittedShape& shape) {
  const Freedom freedom = kind.freedom();
  const int size = freedom.count();
  RevolutionAccount account;
  account.freedom = freedom;
  account.reach = witnesses.reach;
  // The first direction points at the points' centroid where that is off the axis.
  account.frame = frame_about(surface.axis, principal);
  const Vec3 arm = principal.centroid - surface.origin, side = arm - arm.dot(surface.axis) * surface.axis;
  const double spread = std::sqrt(principal.variance[0] + principal.variance[1] + principal.variance[2]);
  if (side.norm() > 1e-6 * spread) {
    const Vec3 u = side.normalized();
    account.frame = {u, surface.axis.cross(u), surface.axis};
  }
  if (freedom.tilts == 0) account.frame = principal.axes;
  // All parameters as lengths: angles as the displacement that they give to points as far away as the spread.
  Eigen::VectorXd unit = Eigen::VectorXd::Ones(size);
  unit.segment(freedom.shifts, freedom.tilts).setConstant(1 / spread);
  if (freedom.second_is_angle) unit[size - 1] = 1 / spread;

  const double edge = input.mean_edge;
  std::vector<double> angles;
  std::vector<Vec3> counted;
  double widest = 0;
  Eigen::MatrixXd information = Eigen::MatrixXd::Zero(size, size);
  Eigen::VectorXd gradient(size);
  double squares = 0, left_out = 0, mean = 0, mean_square = 0;
  account.low = std::numeric_limits<double>::infinity(), account.high = -account.low;
  for (std::size_t i = 0; i < input.points.size(); ++i) {
    const Vec3& point = input.points[i];
    const double d = signed_distance(kind, freedom, surface, {account.frame, account.frame}, point, gradient.data());
    if (!(std::abs(d) <= witnesses.reach)) {
      left_out += input.areas[i];
      continue;
    }
    account.area += input.areas[i];
    if (!witnesses.read_only || was_read(input, i)) {
      counted.push_back(point);
      squares += d * d;
      gradient.array() *= unit.array();
      information += gradient * gradient.transpose();
    }
    const auto [radius, height] = position(surface, point);
    const Vec3 out = point - surface.origin;
    angles.push_back(std::atan2(out.dot(account.frame[1]), out.dot(account.frame[0])));
    widest = std::max(widest, radius);
    account.low = std::min(account.low, height), account.high = std::max(account.high, height);
    mean += height, mean_square += height * height;
  }
  if (counted.size() < static_cast<std::size_t>(size)) {
    shape.summary.termination = Termination::failed;
    shape.summary.message = std::to_string(counted.size()) + " of " + std::to_string(input.points.size()) +
                            " points lie near the " + kind.name() + ": " + std::to_string(size) +
                            " are needed (option 'scale')";
    return std::nullopt;
  }
  const double n = static_cast<double>(counted.size()), all = static_cast<double>(angles.size());
  // Where the surface is widest a point stands for the least part of the turn.
  TurnCoverage covered(2 * pi * widest / edge);
  for (const double angle : angles) covered.add(angle, 2 * pi * widest / edge);
  account.turn = covered.part();
  account.samples = std::clamp(account.area / (edge * edge), 1.0, n);
  account.position_variance = std::max(0.0, mean_square / all - mean * mean / (all * all));
  shape.rms = std::sqrt(squares / n);
  shape.explained = std::sqrt(account.area) / edge;
  shape.unexplained = std::sqrt(left_out) / edge;

  // Neighbouring vertices err alike, so about one sample per square of a mean edge counts. Rounding is the least noise.
  const double rounding = 1e-16 * (input.object_box.diagonal() + surface.origin.norm());
  const double variance = std::max(squares / std::max(1.0, n - size), rounding * rounding);
  const double limit = std::pow(surface.profile[0], 2) + std::pow(input.box.diagonal(), 2);
  Eigen::MatrixXd covariance =
      unit.asDiagonal() * inverse_up_to(information * (account.samples / n / variance), limit) * unit.asDiagonal();
  add_what_is_hidden(kind, surface, account, {chord_ends(input, kind, surface, witnesses.reach), variance}, covariance);
  account.covariance.assign(covariance.data(), covariance.data() + covariance.size());  // symmetric
  return account;
}

}  // namespace revolution

FittedShape RevolutionFitter::fit(const FitInput& input, const Options& /*arguments*/, Context& /*context*/) const {
  const RevolutionKind& kind = *kind_;
  const double scale = scale_ * input.mean_edge;
  FittedShape shape;
  shape.summary.termination = Termination::degenerate;
  const std::string none = std::string(": no ") + kind.name() + " is determined";
  const auto count = static_cast<std::size_t>(kind.freedom().count());
  if (input.points.size() < count) {
    shape.summary.message = "fewer than " + std::to_string(count) + " points" + none;
    return shape;
  }
  if (!(input.mean_edge > 0)) {
    shape.summary.message = "the mean edge length is zero: distances have no scale";
    return shape;
  }
  const PrincipalAxes principal = principal_axes(input.points);
  if (const std::string reason = degeneracy(principal); !reason.empty()) {
    shape.summary.message = reason + none;
    return shape;
  }
  revolution::Estimate found = revolution::estimate(kind, input.points, principal, noise_floor_scales * scale);
  shape.summary = std::move(found.summary);
  if (!shape.summary.usable()) return shape;
  const bool moved = revolution::move_to_read(kind, input, principal, 2 * scale, noise_floor_scales * scale, found);
  found.surface = kind.settled(found.surface);
  const auto account = revolution::account_for(kind, found.surface, input, principal, {2 * scale, moved}, shape);
  if (!account) return shape;
  if (const std::string reason = kind.report(found.surface, *account, input, shape); !reason.empty()) {
    shape.summary.termination = Termination::degenerate;
    shape.summary.message = reason;
  }
  return shape;
}

Interval RevolutionFitter::bounds(std::string_view measure, std::span<const Box> sets,
                                  const Options& /*arguments*/) const {
  if (measure == "coverage") return {0, 1};
  if (measure == "area") return {0, std::numeric_limits<double>::infinity()};
  const double diameter = enclosing_diameter(sets) * (1 + 1e-9);  // no two points are farther apart
  return {0, measure == "length" ? diameter : flat_diagonals * diameter};
}

void OutlinePath::arc(const Vec3& center, const Vec3& x, const Vec3& y, double from, double to) {
  pieces_.push_back({center, x, y, from, to, std::abs(to - from) * std::max(x.norm(), y.norm())});
}

void OutlinePath::line(const Vec3& from, const Vec3& to) {
  pieces_.push_back({from, to - from, Vec3::Zero(), 0, 0, (to - from).norm()});
}

std::vector<Vec3> OutlinePath::points(double step) const {
  double length = 0;
  for (const Piece& piece : pieces_) length += piece.length;
  // Each piece is cut into ceil(length / step) parts: at most length / step + pieces in all.
  step = std::max(step, length / static_cast<double>(outline_limit - pieces_.size() - 1));
  std::vector<Vec3> points;
  for (const Piece& piece : pieces_) {
    const auto parts = static_cast<std::size_t>(std::max(std::ceil(piece.length / step), 1.0));
    for (std::size_t i = points.empty() ? 0 : 1; i <= parts; ++i) {
      const double t = static_cast<double>(i) / static_cast<double>(parts);
      const double angle = piece.from + t * (piece.to - piece.from);
      points.push_back(piece.from == piece.to
                           ? Vec3(piece.center + t * piece.x)
                           : Vec3(piece.center + std::cos(angle) * piece.x + std::sin(angle) * piece.y));
    }
  }
  return points;
}

OutlinePath two_rings(const Revolution& surface, const RevolutionAccount& account, std::array<double, 2> radii) {
  OutlinePath path;
  const auto& [u, v, axis] = account.frame;
  const Vec3 low = surface.origin + account.low * axis, high = surface.origin + account.high * axis;
  path.arc(low, radii[0] * u, radii[0] * v, 0, 2 * pi);
  path.line(low + radii[0] * u, high + radii[1] * u);
  path.arc(high, radii[1] * u, radii[1] * v, 0, 2 * pi);
  return path;
}

}  // namespace toposcope
