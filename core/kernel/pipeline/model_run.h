// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "model/model.h"
#include "pipeline/stations.h"
#include "toposcope/context.h"
#include "toposcope/mesh_view.h"

namespace toposcope {

/// A model at work on a mesh: what every station after the filters is told.
struct ModelRun {
  const MeshView& mesh;  ///< as the filters left it
  const Model& model;
  const Stations& stations;  ///< made for this model
  Context& context;
};

}  // namespace toposcope
