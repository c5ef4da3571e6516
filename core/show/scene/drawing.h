// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "toposcope/shapes.h"

namespace toposcope {

/// A piece of surface.
struct Patch {
  std::vector<Vec3> positions;
  std::vector<Triangle> triangles;
};

/// A fitted shape as lines, patches and points to draw; page, pictures and exports share it.
struct Drawing {
  std::vector<std::vector<Vec3>> lines;  ///< polylines; a closed one ends with its first point again
  std::vector<Patch> patches;
  std::vector<Vec3> points;
  bool empty() const { return lines.empty() && patches.empty() && points.empty(); }
};

/// Draws a shape by what its parameters are: {center, normal, radius} a circle; {point, normal} the part of a plane
/// within the hull of the region; {endpoints} segments; {center, radius} a sphere; {point, axis, radius} a cylinder and
/// {apex, axis, half_angle} a cone as long as the region; {center, axis, major_radius, minor_radius} a torus. Any other
/// shape is its outline.
/// \param region   what the shape was fitted to; without it planes, cylinders and cones have no end, so no drawing
/// \param outline  the fitter's, may be empty
Drawing draw_shape(std::span<const ShapeParameter> parameters, std::span<const Vec3> region,
                   std::span<const Vec3> outline = {}, bool outline_closed = false);

}  // namespace toposcope
