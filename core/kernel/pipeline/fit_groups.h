// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "model/model.h"
#include "pipeline/stations.h"
#include "pipeline/working_set_groups.h"
#include "pipeline/working_sets.h"
#include "toposcope/shapes.h"

namespace toposcope {

/// Features that ask for the same shape of the same types share their fits.
struct FitJob {
  const ModelFeature* feature;  ///< the first of them
  const std::vector<std::string>* types;
  const std::vector<OptionValue>* arguments;
  const ShapeFitter* fitter;
  std::vector<Index> features;
};

/// What the fits of all jobs draw on.
struct FitGround {
  const MeshView& mesh;
  const Model& model;
  const WorkingSets& sets;
  std::span<const Box> set_boxes;  ///< of the sets whose type a feature asks for
  const VertexMeasures& of_vertices;
};

/// What becomes of a group for one feature.
enum class Fate : std::uint8_t { boxed_out, unusable, out_of_range, poor_fit, fitted };

/// The fits of one job, one per group.
struct GroupFits {
  std::vector<FittedShape> shapes;
  std::vector<Box> boxes;                ///< bb(w)
  std::vector<std::vector<Fate>> fates;  ///< per feature of the job, per group
};

/// Fits, in parallel, the groups that may meet the ranges of some feature of the job.
GroupFits fit_groups(const FitJob& job, const WorkingSetGroups& groups, const FitGround& ground, Context& context);

}  // namespace toposcope
