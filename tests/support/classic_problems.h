// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Problems of operations research as labelling problems, drawn by a seed.

#include <cstdint>

#include "toposcope/labeling.h"

namespace toposcope::test {

/// Which of the bids of a combinatorial auction to take: each asks for two to five of the goods, and no good is sold
/// twice. A variable per bid, 1: taken; not to take it costs its price. Bids for one good exclude one another.
LabelingProblem auction(Index goods, Index bids, std::uint64_t seed);

/// Which warehouses to open and which of these serves each store, at what it costs to open and the distance.
LabelingProblem warehouses(Index warehouses, Index stores, std::uint64_t seed);

}  // namespace toposcope::test
