// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// A labelling from marginals: the surest variable first, its most probable value that nothing assigned forbids.

#include <vector>

#include "toposcope/labeling/factor_graph.h"
#include "toposcope/labeling/watch.h"

namespace toposcope::posterior {

using namespace factors;

/// Positions among the graph's values, of finite cost; empty where none was found in `most_steps`.
/// \throw OutOfTime
std::vector<Index> decode(const FactorGraph& graph, const std::vector<std::vector<double>>& marginals,
                          std::size_t most_steps, Watch& watch);

}  // namespace toposcope::posterior
