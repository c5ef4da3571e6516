// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstdint>

namespace toposcope {

/// A point, displacement or direction in the frame and unit of the mesh file, the *mesh unit*. Not vectorizable, so its
/// size and alignment do not depend on `-mavx` and it may cross the plugin boundary.
using Vec3 = Eigen::Vector3d;

/// Index of a vertex, a face, a working set, a candidate; from 0.
using Index = std::uint32_t;

/// Vertex indices of a face, counter-clockwise seen from outside.
using Triangle = std::array<Index, 3>;

inline constexpr double pi = 3.14159265358979323846;

/// An oriented box, sides sorted a >= b >= c (dissertation 4.5, Figure 5.1).
struct Box {
  Vec3 center = Vec3::Zero();                                                ///< where the diagonals meet
  std::array<Vec3, 3> axes = {Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};  ///< orthonormal, right-handed
  std::array<double, 3> sides = {0, 0, 0};                                   ///< full lengths a, b, c, mesh unit

  /// The sides, longest first.
  double a() const { return sides[0]; }
  /// \copydoc a
  double b() const { return sides[1]; }
  /// \copydoc a
  double c() const { return sides[2]; }
  /// Length of the diagonal, mesh unit.
  double diagonal() const { return std::sqrt(a() * a() + b() * b() + c() * c()); }
};

}  // namespace toposcope
