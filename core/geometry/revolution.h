// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Inner parts of the fit of surfaces of revolution.

#include <Eigen/Core>
#include <vector>

#include "toposcope/geometry/point_sets.h"
#include "toposcope/geometry/revolution.h"

namespace toposcope::revolution {

/// Directions in which a surface's parameters are moved: of the origin, and of the axis.
struct Basis {
  std::array<Vec3, 3> shifts, tilts;
};

/// Two directions across an axis that turn with the points: the first is near one of the points' principal axes.
std::array<Vec3, 3> frame_about(const Vec3& axis, const PrincipalAxes& principal);

/// Signed distance. \param gradient  null, or room for `freedom.count()` numbers: shifts, tilts, profile
double signed_distance(const RevolutionKind& kind, const Freedom& freedom, const Revolution& surface,
                       const Basis& basis, const Vec3& point, double* gradient);

/// Each of the queries with the normal of its `count` nearest points; left out where these lie on a line.
std::vector<OrientedPoint> local_normals(std::span<const Vec3> queries, std::span<const Vec3> points,
                                         std::size_t count);

struct Estimate {
  Revolution surface;
  FitSummary summary;
};

/// The surface of least Geman-McClure distance. \pre points' axes are not degenerate
/// \param noise_floor  the least noise to assume, mesh unit
/// \param start        a surface near by, refined alone; null: it is searched for
Estimate estimate(const RevolutionKind& kind, std::span<const Vec3> points, const PrincipalAxes& principal,
                  double noise_floor, const Revolution* start = nullptr);

/// Moves a surface that was fitted to all points to those that were read, where there are others and these determine
/// it too. \param reach  points within it belong to the surface, mesh unit \return whether it did
bool move_to_read(const RevolutionKind& kind, const FitInput& input, const PrincipalAxes& principal, double reach,
                  double noise_floor, Estimate& found);

/// Which points say how exact a surface is.
struct Witnesses {
  double reach = 0;        ///< those within it, mesh unit
  bool read_only = false;  ///< those of them that were read
};
/// Fills in what does not depend on the kind. \return nothing where fewer points than parameters lie near the surface
std::optional<RevolutionAccount> account_for(const RevolutionKind& kind, const Revolution& surface,
                                             const FitInput& input, const PrincipalAxes& principal,
                                             const Witnesses& witnesses, FittedShape& shape);

/// Those ends of chords (ends_of_chords) that lie within reach of a surface.
std::vector<Vec3> chord_ends(const FitInput& input, const RevolutionKind& kind, const Revolution& surface,
                             double reach);

/// What a surface was fitted to.
struct Fitted {
  std::vector<Vec3> chord_ends;
  double variance;  ///< of the points' distances
};

/// Widens the covariance by what residuals do not show: that it is the curvature, not the radius, that errs evenly;
/// noise along the surface, which moves points outwards; and how deep chords lie.
void add_what_is_hidden(const RevolutionKind& kind, const Revolution& surface, const RevolutionAccount& account,
                        const Fitted& fitted, Eigen::MatrixXd& covariance);

}  // namespace toposcope::revolution
