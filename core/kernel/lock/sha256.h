// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

namespace toposcope {

/// SHA-256 of a regular file in hexadecimal. \throw UsageError  it cannot be read
std::string sha256_of(const std::filesystem::path& file);

}  // namespace toposcope
