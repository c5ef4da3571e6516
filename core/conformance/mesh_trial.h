// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>

#include "inputs.h"

namespace toposcope {

enum class Poison { none, one_vertex, all };

/// What trials of classifiers and filters share: a mesh, possibly with positions that are not numbers.
class MeshTrial : public Trial {
 public:
  MeshTrial(std::string called, TriangleSoup soup, Poison poison);
  const MeshView& view() const { return view_; }

 protected:
  const TriangleSoup& soup() const { return soup_; }
  /// Old index of each vertex of the input moved by `motion`; empty where the order is the same.
  std::vector<Index> vertex_order(const Motion& motion) const;

 private:
  TriangleSoup soup_;
  Mesh mesh_;
  std::vector<Vec3> poisoned_;
  MeshView view_;
};

TrialSet mesh_trials(const std::function<std::unique_ptr<Trial>(std::string, TriangleSoup, Poison)>& make);

}  // namespace toposcope
