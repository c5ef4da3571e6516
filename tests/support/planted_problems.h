// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Labelling problems of any size shaped like those of meshes: features x candidates, missing allowed, one-to-one over a
// shared pool of candidates, soft costs between half of the pairs of features.

#include <cstdint>
#include <vector>

#include "toposcope/labeling.h"

namespace toposcope::test {

struct PlantedKind {
  Index features = 8, candidates = 20;  ///< candidates per feature
  double density = 0.5;                 ///< part of the pairs of features that have a relationship
  bool structured = true;  ///< candidates are places, relationships distances, one labelling is true; else all costs
                           ///< are drawn alike, which no bound sees through
};

/// \param truth  receives the planted labelling
LabelingProblem planted_problem(const PlantedKind& kind, std::uint64_t seed, std::vector<Index>* truth = nullptr);

}  // namespace toposcope::test
