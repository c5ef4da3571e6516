// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Implicit modelling: solids as signed distances with gradients, negative inside, and booleans that round the edge
// that they make. Every function is a value, may be called from any thread and throws nothing.

#include <functional>

#include "sample/plane_path.h"
#include "toposcope/types.h"

namespace toposcope {

/// Signed distance to a surface, and its gradient: the outward normal on the surface.
struct Distance {
  double value = 0;
  Vec3 gradient = Vec3::Zero();
};

using Implicit = std::function<Distance(const Vec3&)>;

/// Solid of revolution: the profile's x is the distance from the axis, its y the height along it; the material lies
/// to the profile's left. The profile starts and ends on the axis or out of reach.
Implicit revolve(PlanePath profile, const Vec3& origin, const Vec3& axis);

/// Round tube of radius `radius` along a path in the plane origin + x * u + y * v, with round ends.
/// \pre u and v are orthonormal
Implicit sweep(PlanePath path, const Vec3& origin, const Vec3& u, const Vec3& v, double radius);

/// Box about `center` with edges along x, y, z rounded by `radius`.
Implicit box(const Vec3& center, const Vec3& half_sides, double radius);

Implicit complement(Implicit a);

/// Union whose inner edges are filled by a rolling ball of radius `fillet` (0: sharp). The fillet is the exact
/// circular one where the surfaces are plane or their angle is constant across it.
Implicit unite(Implicit a, Implicit b, double fillet = 0);

/// Intersection and difference whose outer edges are rounded with radius `rounding`.
Implicit intersect(Implicit a, Implicit b, double rounding = 0);
Implicit subtract(Implicit a, Implicit b, double rounding = 0);

/// The solid on the side y >= 0 and its mirror image. \pre what lies at y < 0 of `a` is its own mirror image
Implicit mirror_y(Implicit a);

/// The same surface, cheaper far from it: farther than `margin` from the box, which contains the solid, the distance is
/// that to the box, which is a lower bound. `margin` must exceed the fillets that the solid is united with.
Implicit within_box(Implicit a, const Vec3& low, const Vec3& high, double margin);

struct Foot {
  Vec3 point, gradient;
};
/// Moves a point near the surface along the gradient until the function is at most `tolerance` there. Where fillets are
/// squeezed the function is steeper than its gradient says and steps overshoot: then it goes to where the function
/// would vanish between the last two points.
Foot settle(const Implicit& surface, Vec3 point, double tolerance);

/// settle to 1e-12 of `scale`, unless the function is not a distance there.
Vec3 project(const Implicit& surface, const Vec3& point, double scale);

/// Moves a point to where two functions vanish, by least steps: the curve in which two surfaces meet.
Vec3 project_to_curve(const Implicit& f, const Implicit& g, Vec3 point);

}  // namespace toposcope
