// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <span>

#include "model/model.h"
#include "toposcope/mesh_view.h"
#include "toposcope/shapes.h"

namespace toposcope {

/// One of the object's own directions.
struct OwnAxis {
  Vec3 direction = Vec3::Zero();  ///< unit length
  double certainty = 0;           ///< 2 p - 1, p the probability that it does not run the other way
};

/// Up, front and right of an object, at right angles; what nothing tells is absent.
struct OwnAxes {
  std::optional<OwnAxis> up, front, right;
};

/// Where something lies, and its standard deviation in each direction; mesh unit.
struct Place {
  Vec3 point = Vec3::Zero();
  double sd = 0;
};

/// Where an object lies of which nothing was found: in the middle of the surface, give or take a quarter of bb(O).c.
Place middle_of(const MeshView& mesh);

/// The object's own directions, from the associations of the abstract part and the features that were found. An object
/// lies at the mean of the features that it holds (through parts and bounds); one that holds none, in the middle; one
/// of which none was found, anywhere. A direction runs along the mean of the normals or axes that the model names for
/// it (`axes`), the way that its associations say. One without such features runs as its associations do, to within 45
/// degrees, and at right angles to those before it in the order: named ones, right, front, up. \param found  per
/// feature of the model; null: missing
OwnAxes own_axes(const Model& model, std::span<const FittedShape* const> found, const Place& middle);

/// Probability that right, front and up are a right-handed system, as they are by the meaning of the words; nothing
/// where one of them is not known.
std::optional<double> right_handed(const OwnAxes& axes);

}  // namespace toposcope
