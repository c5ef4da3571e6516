// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "model/model.h"

namespace toposcope {

/// The name of a link read backwards: bounded-by and boundary-of, has-part and part-of, up and down, front and back,
/// right and left; adjacent-to is its own inverse (dissertation 3.2). "" for an unknown name.
std::string_view inverse_of(std::string_view kind);

/// Everything that the three networks say of one object: the links that start at it as written, and the inverses of
/// those that end there. Topology first, then parts, then associations.
std::vector<Link> links_from(const AbstractModel& model, Index object);

/// The first cycle of directed links in the order of the file, as the objects along it (the first is not repeated);
/// empty when there is none.
std::vector<Index> find_cycle(Index object_count, const std::vector<Link>& links);

}  // namespace toposcope
