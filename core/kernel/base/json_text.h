// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace toposcope {

/// The one place where JSON of a file becomes a document.
/// \tparam Json  nlohmann::json or nlohmann::ordered_json
/// \param owner  the file, for messages
/// \throw UsageError  "owner:line:column: ..." of one line: no JSON, a number beyond doubles, or nested more than 500
///                    deep, which what walks through a document may not survive
template <class Json>
Json parse_json(std::string_view text, const std::string& owner);

extern template nlohmann::json parse_json(std::string_view, const std::string&);
extern template nlohmann::ordered_json parse_json(std::string_view, const std::string&);

/// What is wrong with a document, in one short line and without the library's own prefix.
std::string json_fault(const nlohmann::json::exception& error);

/// "line:column" of a byte, both from 1.
std::string line_and_column(std::string_view text, std::size_t at);

}  // namespace toposcope
