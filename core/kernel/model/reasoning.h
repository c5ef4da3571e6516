// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "model/model.h"

namespace toposcope {

/// Something that follows for an object: `chain` are the written links that it follows from, in the order in which
/// they are walked, each in the direction of the walk; one link of the relation itself: it is written.
struct Consequence {
  Index object = 0;
  std::vector<Link> chain;
};

/// All o for which "subject relation o" follows from the networks of an abstract model, each once and with a shortest
/// chain, nearest first. The relation is one of the links or of their inverses (inverse_of). What follows:
/// - has-part, part-of, and each direction are transitive;
/// - what bounds the boundary of an object, or is part of it, bounds the object too (an edge of one of its surfaces);
/// - adjacent-to holds both ways, and between objects that one boundary bounds; a whole is adjacent to what its part
///   is adjacent to, unless that is in the whole.
/// A direction of an object says nothing of its parts: they may reach past each other.
std::vector<Consequence> consequences(const AbstractModel& model, Index subject, std::string_view relation);

}  // namespace toposcope
