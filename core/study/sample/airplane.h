// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "sample/lifting_surface.h"
#include "sample/solid.h"

namespace toposcope {

/// An airplane's measures: its nose at the origin looks along +x, up is +z, port +y. Lengths along x count backwards
/// from the nose.
struct Airplane {
  explicit Airplane(const ParameterValues& parameters);

  double length, radius, nose, tail, tail_radius;
  double wing_position, wing_height;
  Planform wing, stabilizer, fin;
  bool t_tail;
  double stabilizer_position, fin_position;
  int engines;
  bool rear_engines;
  double engine_radius, engine_length, engine_station, engine_drop;
  double fillet;

  /// Radius of the fuselage at a distance behind the nose, where it is a cone or a cylinder.
  double fuselage_radius(double behind) const;
};

/// \throw UsageError
void check_airplane(const Airplane& airplane);

/// Middle of the engine on the port side of the fuselage, half way between wing and tail.
Vec3 rear_engine(const Airplane& airplane);

/// Least width of the gap between engines and what they hang on or stand beside.
double engine_gap(const Airplane& airplane);

/// Half of a pair of engines on the port side, with what holds it.
struct Engine {
  Implicit surface;
  Vec3 low, high;
  double thinnest;
};
std::vector<Engine> port_engines(const Airplane& airplane);

}  // namespace toposcope
