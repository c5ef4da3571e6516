// SPDX-License-Identifier: BSD-3-Clause
#include "result/shape_json.h"

namespace toposcope {

using Json = nlohmann::ordered_json;

Json parameters_json(const std::vector<ShapeParameter>& parameters) {
  Json object = Json::object();
  for (const ShapeParameter& parameter : parameters) {
    if (parameter.name == "closed") {
      object[parameter.name] = parameter.values.front() != 0;
      continue;
    }
    Json rows = Json::array();
    const std::size_t columns = static_cast<std::size_t>(parameter.columns);
    for (std::size_t i = 0; i < parameter.values.size(); i += columns) {
      Json row = Json::array();
      for (std::size_t k = i; k < i + columns; ++k) row.push_back(parameter.values[k]);
      rows.push_back(columns == 1 ? row[0] : row);
    }
    const bool list = parameter.name == "endpoints";
    object[parameter.name] = list ? rows : rows[0];
  }
  return object;
}

std::vector<ShapeParameter> parameters_from(const Json& object) {
  std::vector<ShapeParameter> parameters;
  for (const auto& [name, value] : object.items()) {
    ShapeParameter& parameter = parameters.emplace_back();
    parameter.name = name;
    if (value.is_boolean()) {
      parameter.values = {value.get<bool>() ? 1.0 : 0.0};
    } else if (value.is_number()) {
      parameter.values = {value.get<double>()};
    } else {
      parameter.columns = 3;
      for (const Json& row : value)
        for (const Json& x : row.is_array() ? row : Json::array({row})) parameter.values.push_back(x.get<double>());
    }
  }
  return parameters;
}

}  // namespace toposcope
