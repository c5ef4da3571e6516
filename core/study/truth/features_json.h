// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "truth/truth.h"

namespace toposcope {

/// The member `features` of a truth file, by name; read_truth reads it back.
nlohmann::ordered_json features_json(const std::vector<TruthFeature>& features);

/// A point or direction as three numbers.
nlohmann::ordered_json triple_json(const Vec3& v);

}  // namespace toposcope
