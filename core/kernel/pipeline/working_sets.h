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
  std::vector<std::string> plugin_names;  ///< of the classifiers, each once
  std::vector<std::string> type_names;
  std::vector<Index> plugins;    ///< one per set, into `plugin_names`: who found it, of equal sets first
  std::vector<Index> types;      ///< one per set, into `type_names`
  std::vector<double> saliency;  ///< one per set
  std::vector<Index> offsets = {0};
  std::vector<Index> vertices;

  std::size_t size() const { return types.size(); }
  std::span<const Index> operator[](std::size_t set) const {
    return std::span(vertices).subspan(offsets[set], offsets[set + 1] - offsets[set]);
  }
};

/// The station *classify*: runs the classifiers, checks what each gives (known types, vertices in range, no repeats,
/// connected) and pools it. Of several classifiers sets of one type with the same vertices are kept once, at the
/// largest saliency.
/// \throw PluginError
WorkingSets classify_mesh(const MeshView& mesh, std::span<const WorkingSetStation> stations, Context& context);

}  // namespace toposcope
