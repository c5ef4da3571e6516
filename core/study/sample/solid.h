// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// What a kind of parametric object gives to make_sample: its exact surface and its truth.

#include <algorithm>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "sample/implicit.h"
#include "sample/parameters.h"

namespace toposcope {

/// The faces of a solid as a program for CAD exports them, each with its part.
struct TessellatedSolid {
  TriangleSoup mesh;
  std::vector<std::uint8_t> face_part;
};

struct Solid {
  Implicit surface;                                       ///< none where it is tessellated
  std::function<TessellatedSolid(bool fine)> tessellate;  ///< as exported, or as finely as a scan wants it; else none
  Vec3 low = Vec3::Zero(), high = Vec3::Zero();           ///< contain the solid
  double thinnest = 0;                 ///< least thickness of material or gap: no cell of the grid may reach across it
  std::string thinnest_parameter;      ///< the parameter that sets it
  double gap = 0;                      ///< least width of the gaps between parts; not more than it is
  std::vector<TruthFeature> features;  ///< without `vertices`
  bool typical = true;                 ///< of the class that the kind's model describes; `--random` draws no others
  std::vector<std::string> part_names;
  std::function<std::size_t(const Vec3&)> part_of;  ///< part of a point on the surface
};

/// How far outside the surface its net is laid: thin material comes out whole on a coarser grid there, and gaps become
/// narrower.
inline double net_level(const Solid& solid) {
  return std::clamp((solid.gap - solid.thinnest) / 4, 0.0, 1.25 * solid.thinnest);
}

/// Values of all parameters for a request: given, of its preset, drawn, default. \throw UsageError  as make_sample does
ParameterValues requested_parameters(const SampleRequest& request);

/// Builds the exact solid of a kind. \throw UsageError  parameters that contradict each other
Solid make_solid(const std::string& kind, const ParameterValues& parameters);

/// The error of a request. Where a constraint fails of a parameter that the request does not give, the message names
/// what it gives: the one that makes the difference, if one alone does.
UsageError blaming_what_was_given(const SampleRequest& request, const ParameterError& error);

SampleKind cup_kind();
Solid make_cup(const ParameterValues& parameters);
SampleKind tee_kind();
Solid make_tee(const ParameterValues& parameters);
SampleKind cross_kind();
Solid make_cross(const ParameterValues& parameters);
SampleKind wye_kind();
Solid make_wye(const ParameterValues& parameters);
SampleKind elbow_kind();
Solid make_elbow(const ParameterValues& parameters);
SampleKind tricorner_kind();
Solid make_tricorner(const ParameterValues& parameters);
SampleKind airplane_kind();
Solid make_airplane(const ParameterValues& parameters);
SampleKind plate_kind();
Solid make_plate(const ParameterValues& parameters);
SampleKind flange_kind();
Solid make_flange(const ParameterValues& parameters);

/// For each point of a feature the nearest vertex; points whose vertex is taken already are dropped.
void mark_vertices(TruthFeature& feature, const std::vector<Vec3>& positions);

/// Truth of a circle: its parameters and `count` points on it.
TruthFeature circle_feature(const std::string& name, const Vec3& center, const Vec3& normal, double radius,
                            std::size_t count = 48);

}  // namespace toposcope
