// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// What a mesh hides of a round shape: its vertices that were read sample the shape, what lies between them lies on
// chords. Part of toposcope_geometry.

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <vector>

#include "toposcope/shapes.h"

namespace toposcope {

/// Whether a point of a fit is a vertex that was read, and not one that a filter made. Points of no mesh all are.
inline bool was_read(const FitInput& input, std::size_t point) {
  if (input.mesh == nullptr || input.mesh->input_vertices.empty()) return true;
  return input.mesh->input_vertices[input.vertices[point]] != no_vertex;
}

/// Where the chords end on which points lie that a filter made: the vertices that were read, of those fitted and next
/// to them. Each once, in the order of the vertices.
std::vector<Vec3> ends_of_chords(const FitInput& input);

/// How deep the chords between points of a circle lie under it: half of the turn that has points has chords no deeper.
/// The widest gap counts as an opening. Length; 0 for fewer than two points.
/// \param angles  of the points about the centre, rad, -pi to pi
double typical_sagitta(std::vector<double> angles, double radius);

/// Variance about the shape through the vertices of one that lies anywhere between it and the chords.
inline double chord_variance(double sagitta) {
  return sagitta * sagitta / 3;
}

/// By how much a standard deviation of a radius must grow so that two of it reach as far as two of the curvature's do
/// (up to five times): noise that bends a flat arc more makes the radius small, and its own deviation with it.
/// \param part  the standard deviation, as part of the radius
inline double curvature_stretch(double part) {
  return 1 / (1 - 2 * std::min(part, 0.4));
}

/// Whether some points determine all parameters about as well as as many of all would: in no direction is what one of
/// them says on average less than a tenth.
/// \param some, all  normal matrices, each divided by its number of points
bool as_well_spread(const Eigen::MatrixXd& some, const Eigen::MatrixXd& all);

}  // namespace toposcope
