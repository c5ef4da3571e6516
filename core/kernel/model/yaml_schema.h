// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <yaml-cpp/yaml.h>

#include <string>
#include <string_view>

#include "model/error_list.h"
#include "model/source_location.h"

namespace toposcope {

/// The place of a node. Text in quotes begins behind the quote.
SourceLocation location_of(const YAML::Node& node, const std::string& file);

/// Reads one YAML document. \throw UsageError  `file:line:column` of what YAML does not allow
YAML::Node parse_yaml(const std::string& text, const std::string& file);

/// Checks a YAML document, read as JSON, against a JSON Schema (draft 7). Errors say which key or value, where,
/// and what the schema's description asks for. Also refuses what JSON does not have: a key given twice, a key that
/// is not a scalar, a document that aliases blow up.
void check_schema(const YAML::Node& root, std::string_view schema, const std::string& file, ErrorList& errors);

}  // namespace toposcope
