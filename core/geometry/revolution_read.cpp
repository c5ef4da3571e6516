// SPDX-License-Identifier: BSD-3-Clause
// Vertices that were read lie on the surface that was tessellated; those that a filter put between them do not. What
// neither of them says of the surface.

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <utility>

#include "revolution.h"
#include "toposcope/geometry/chords.h"

namespace toposcope {

std::array<double, 2> RevolutionKind::sagittas(const Revolution& surface, const RevolutionAccount& account,
                                               std::span<const Vec3> points) const {
  std::vector<double> angles;
  double radius = 0;
  for (const Vec3& point : points) {
    const Vec3 out = point - surface.origin;
    angles.push_back(std::atan2(out.dot(account.frame[1]), out.dot(account.frame[0])));
    radius += position(surface, point).radius / static_cast<double>(points.size());
  }
  return {typical_sagitta(std::move(angles), radius), 0};
}

namespace revolution {
namespace {

constexpr double chords_alone = 0.25;    // of the mean square distance: what is left without them
constexpr std::size_t spare_points = 3;  // more than parameters, so that residuals say something

/// Normal matrix per point of those within reach, with all parameters as lengths.
struct Information {
  Eigen::MatrixXd sum;
  std::vector<Vec3> points;
  Eigen::MatrixXd per_point() const { return sum / static_cast<double>(points.size()); }
};

/// Mean square of the distances, those beyond reach counted as reach.
double mean_square(const RevolutionKind& kind, const Revolution& surface, std::span<const Vec3> points, double reach) {
  double sum = 0;
  for (const Vec3& point : points) {
    const double d = std::abs(signed_distance(kind, kind.freedom(), surface, {}, point, nullptr));
    sum += d <= reach ? d * d : reach * reach;
  }
  return sum / static_cast<double>(points.size());
}

}  // namespace

bool move_to_read(const RevolutionKind& kind, const FitInput& input, const PrincipalAxes& principal, double reach,
                  double noise_floor, Estimate& found) {
  if (input.mesh == nullptr || input.mesh->input_vertices.empty()) return false;
  const Freedom freedom = kind.freedom();
  const int size = freedom.count();
  const double spread = std::sqrt(principal.variance[0] + principal.variance[1] + principal.variance[2]);
  Eigen::VectorXd unit = Eigen::VectorXd::Ones(size), gradient(size);
  unit.segment(freedom.shifts, freedom.tilts).setConstant(1 / spread);
  if (freedom.second_is_angle) unit[size - 1] = 1 / spread;
  const std::array<Vec3, 3> frame = frame_about(found.surface.axis, principal);
  Information all{Eigen::MatrixXd::Zero(size, size), {}}, read = all;
  for (std::size_t i = 0; i < input.points.size(); ++i) {
    const double d = signed_distance(kind, freedom, found.surface, {frame, frame}, input.points[i], gradient.data());
    if (!(std::abs(d) <= reach)) continue;
    gradient.array() *= unit.array();
    all.sum.noalias() += gradient * gradient.transpose();
    all.points.push_back(input.points[i]);
    if (!was_read(input, i)) continue;
    read.sum.noalias() += gradient * gradient.transpose();
    read.points.push_back(input.points[i]);
  }
  if (read.points.size() == all.points.size() || read.points.size() < static_cast<std::size_t>(size) + spare_points)
    return false;
  if (!as_well_spread(read.per_point(), all.per_point())) return false;
  Estimate moved = estimate(kind, read.points, principal, noise_floor, &found.surface);
  // Where chords are not what most of the distances come from, there is nothing to gain from fewer points.
  if (!moved.summary.usable() || !(mean_square(kind, moved.surface, read.points, reach) <=
                                   chords_alone * mean_square(kind, found.surface, all.points, reach)))
    return false;
  moved.summary.iterations += found.summary.iterations;
  found = std::move(moved);
  return true;
}

std::vector<Vec3> chord_ends(const FitInput& input, const RevolutionKind& kind, const Revolution& surface,
                             double reach) {
  std::vector<Vec3> ends = ends_of_chords(input);
  std::erase_if(ends, [&](const Vec3& end) {
    return !(std::abs(signed_distance(kind, kind.freedom(), surface, {}, end, nullptr)) <= reach);
  });
  return ends;
}

void add_what_is_hidden(const RevolutionKind& kind, const Revolution& surface, const RevolutionAccount& account,
                        const Fitted& fitted, Eigen::MatrixXd& covariance) {
  const Freedom freedom = kind.freedom();
  const int radii = freedom.second_is_angle ? 1 : freedom.profile, first = freedom.shifts + freedom.tilts;
  Eigen::VectorXd stretch = Eigen::VectorXd::Ones(freedom.count());
  for (int k = 0; k < radii; ++k) {
    const double radius = std::abs(surface.profile[static_cast<std::size_t>(k)]);
    stretch[first + k] = curvature_stretch(std::sqrt(covariance(first + k, first + k)) / radius);
  }
  stretch.head(freedom.shifts).setConstant(stretch[first]);
  covariance = stretch.asDiagonal() * covariance * stretch.asDiagonal();
  const int round = radii - 1;  // a sphere is round both ways, and a torus by its tube
  const double ways = freedom.tilts == 0 ? 2 : 1;
  const double outwards = ways * fitted.variance / (2 * std::abs(surface.profile[static_cast<std::size_t>(round)]));
  covariance(first + round, first + round) += outwards * outwards;
  if (fitted.chord_ends.empty()) return;
  const std::array<double, 2> sagittas = kind.sagittas(surface, account, fitted.chord_ends);
  for (int k = 0; k < radii; ++k)
    covariance(first + k, first + k) += chord_variance(sagittas[static_cast<std::size_t>(k)]);
}

}  // namespace revolution
}  // namespace toposcope
