// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Whether what the program writes keeps to a published schema.

#include <filesystem>
#include <string>

namespace toposcope::test {

/// What a JSON document breaks of schemas/<name>.schema.json, one fault a line; empty: nothing.
std::string schema_faults(const std::string& name, const std::string& document);

/// The same of a schema in any file.
std::string schema_file_faults(const std::filesystem::path& schema, const std::string& document);

}  // namespace toposcope::test
