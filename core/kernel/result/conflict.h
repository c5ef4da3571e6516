// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "toposcope/context.h"
#include "toposcope/labeling.h"

namespace toposcope {

/// What together forbids every candidate of a missing feature, all other features as labelled: each candidate breaks
/// one of the relationships beyond its tolerance or shares its place with one of the features.
struct ConflictReport {
  std::vector<std::string> relations = {};
  std::vector<std::string> exclusions = {};  ///< features
  bool smallest = false;                     ///< proven: no smaller set of these does
};

/// \return nothing where a candidate breaks no relationship and shares no vertex, so that its cost alone speaks against
/// it
std::optional<ConflictReport> conflict_of_missing(const LabelingProblem& problem, const Labeling& labeling,
                                                  Index variable, const Context& context);

/// "every candidate breaks r1 or r4 or shares its place with bottom"
std::string in_words(const ConflictReport& conflict);

}  // namespace toposcope
