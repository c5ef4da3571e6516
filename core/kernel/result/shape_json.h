// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "toposcope/shapes.h"

namespace toposcope {

/// The parameters of a shape as result.json has them.
nlohmann::ordered_json parameters_json(const std::vector<ShapeParameter>& parameters);

/// Read back. \throw nlohmann::json::exception  these are none
std::vector<ShapeParameter> parameters_from(const nlohmann::ordered_json& object);

}  // namespace toposcope
