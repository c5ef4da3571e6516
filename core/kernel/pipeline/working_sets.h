// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>
#include <vector>

#include "pipeline/stations.h"
#include "toposcope/worksets.h"

namespace toposcope {

/// The working sets of a mesh, in compressed rows; possibly overlapping.
struct WorkingSets {
  std::vector<std::string> type_names;
  std::vector<Index> types;      ///< one per set, into `type_names`
  std::vector<double> saliency;  ///< one per set
  std::vector<Index> offsets = {0};
  std::vector<Index> vertices;

  std::size_t size() const { return types.size(); }
  std::span<const Index> operator[](std::size_t set) const {
    return std::span(vertices).subspan(offsets[set], offsets[set + 1] - offsets[set]);
  }
};

/// The station *classify*: runs the classifier and checks what it gives: known types, vertices in range, no repeats,
/// connected.
/// \throw PluginError
WorkingSets classify_mesh(const MeshView& mesh, const WorkingSetStation& station, Context& context);

}  // namespace toposcope
