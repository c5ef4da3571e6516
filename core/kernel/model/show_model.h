// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "model/model.h"

namespace toposcope {

/// The model for reading in a terminal: every object with all that the networks say of it, inverses included; then
/// features, relationships and classes.
std::string model_as_text(const Model& model);

/// The model as a Graphviz graph: one cluster for each of the three networks, the features tied to the objects that
/// they realise, the relationships as boxes between the features.
std::string model_as_dot(const Model& model);

}  // namespace toposcope
