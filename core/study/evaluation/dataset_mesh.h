// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "evaluation/dataset.h"
#include "mesh/mesh.h"
#include "mesh/repair.h"
#include "toposcope/context.h"
#include "truth/truth.h"

namespace toposcope {

class PluginHost;

struct KnownMesh {
  Mesh mesh;
  RepairReport repair;
  Truth truth = {};  ///< empty where none is known
};

/// Reads or makes a mesh of a data set. \throw MeshError, UsageError
KnownMesh load(const DatasetMesh& item, PluginHost& host, Context& context);

}  // namespace toposcope
