// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "model/model.h"

namespace toposcope {

/// A question to a model: its features and relationships.
struct Question {
  const Model& model;
  const std::vector<Index>& features;       ///< of the model
  const std::vector<Index>& relationships;  ///< of the model, among these features
  const std::vector<bool>& ordered;         ///< per relationship of the model: it matters which feature comes first
  bool by_detectability = true;  ///< it tells features apart (not in a class, whose features all belong to it)
};

/// All renamings (for each position in `features` the position whose name it takes) that leave the question as it is,
/// the identity first. An airplane's port and starboard features change places where no relationship names a direction.
/// Of a question with more than 50,000 to try the identity alone.
std::vector<std::vector<Index>> renamings(const Question& question);

/// Which features cannot be told apart: for each the positions (its own included, ascending) that some renaming maps it
/// to.
std::vector<std::vector<Index>> orbits_of(const std::vector<std::vector<Index>>& renamings);

}  // namespace toposcope
