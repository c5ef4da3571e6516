// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace toposcope::cli {

/// Two meshes of one stem would write over each other in one folder.
/// \param option  that names the folder, for the message
/// \throw UsageError
void refuse_same_stem(const std::vector<std::filesystem::path>& meshes, const std::string& option);

/// \throw UsageError  it cannot be made
void make_folder(const std::filesystem::path& folder, const std::string& option);

}  // namespace toposcope::cli
