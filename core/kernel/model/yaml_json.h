// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <yaml-cpp/yaml.h>

#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "model/error_list.h"

namespace toposcope {

/// The keys and indices that lead from the root to a value.
using JsonPath = std::vector<std::string>;

/// A YAML document read as JSON, which remembers where in the file each value and each key stands.
struct LocatedJson {
  nlohmann::json value;
  std::map<JsonPath, SourceLocation> values;
  std::map<JsonPath, SourceLocation> keys;
};

/// Plain scalars become null, booleans and numbers as in YAML's core schema; quoted ones stay strings.
LocatedJson yaml_to_json(const YAML::Node& root, const std::string& file, ErrorList& errors);

}  // namespace toposcope
