// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>

#include "toposcope/context.h"
#include "toposcope/mesh_view.h"
#include "toposcope/options.h"
#include "toposcope/shapes.h"

namespace toposcope {

/// A constructed feature as a relation sees it.
struct RelationOperand {
  const FittedShape* shape = nullptr;    ///< what was fitted
  std::span<const Vec3> points;          ///< of its working sets
  Box box;                               ///< bb(w)
  std::span<const Index> vertices = {};  ///< of `RelationInput::mesh`, one per point; empty: not known
};

/// What a relation is tested on.
struct RelationInput {
  std::span<const RelationOperand> features;  ///< in the order of the model, as many as the relation takes
  Box object_box;                             ///< bb(O)
  double mean_edge = 0;                       ///< mesh unit
  const MeshView* mesh = nullptr;             ///< what the features are features of; null: not known
};

/// How far a relation is from holding, and what the kernel needs to weigh it (docs/theory/probabilities.md). The unit u
/// of its numbers is rad where the descriptor's unit is "deg", mesh unit where it is "length".
struct RelationResult {
  bool applicable = true;      ///< false: these shapes cannot stand in this relation; `why` says so
  std::string why;             ///< one line, where it is not applicable
  double residual = 0;         ///< u, >= 0
  double tolerance = 0;        ///< u, > 0; crisp form: satisfied when residual <= tolerance
  double sd = 0;               ///< u; standard deviation of the residual, from the fits' own uncertainty
  int dof = 1;                 ///< independent components that the residual sums up: 1 an angle from a right angle or a
                               ///< distance beyond a range, 2 an offset between axes or an angle between directions
  double slack = 0;            ///< u; width of the set of values at which the residual is 0 (a range's max - min)
  double clutter_density = 0;  ///< u^-dof, > 0; density of the residual for unrelated features, divided by
                               ///< residual^(dof - 1), so that it does not vanish with it; within the slack, density
                               ///< of the value itself
  double samples = 1;          ///< independent comparisons that the residual summarises (rms over so many)
};

/// Tests one relationship between constructed features (dissertation 4.6), or of one to the mesh. Thread-safe.
class RelationTester {
 public:
  virtual ~RelationTester() = default;
  /// \param arguments  the model's parameters of the relationship (`max` of a centroid distance), evaluated
  /// \throw std::invalid_argument  arguments that make no sense together; what cannot be compared is not `applicable`
  virtual RelationResult test(const RelationInput& input, const Options& arguments, Context& context) const = 0;
};

}  // namespace toposcope
