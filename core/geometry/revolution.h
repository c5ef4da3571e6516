// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Inner parts of the fit of surfaces of revolution.

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
Estimate estimate(const RevolutionKind& kind, std::span<const Vec3> points, const PrincipalAxes& principal,
                  double noise_floor);

/// Fills in what does not depend on the kind. \return nothing where fewer points than parameters lie near the surface
std::optional<RevolutionAccount> account_for(const RevolutionKind& kind, const Revolution& surface,
                                             const FitInput& input, const PrincipalAxes& principal, double reach,
                                             FittedShape& shape);

}  // namespace toposcope::revolution
