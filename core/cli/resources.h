// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace toposcope::cli {

/// A model or pipeline by file (ending in .yaml or .yml) or by name: `cup`, `neal-1999/cup`. Names are
/// looked up beside the executable (<folder>/../<kind>), in the install prefix (<folder>/../share/toposcope/<kind>)
/// and in the folders of TOPOSCOPE_DATA_PATH (separated by ':'); never in the working directory.
/// \param kind  "models" or "pipelines"
/// \throw UsageError  not found, with what there is
std::filesystem::path find_resource(const std::string& kind, const std::string& name);

/// The folder `name` of a kind, in the same places: find_resource_folder("templates", "shapes"). Empty where there is
/// none.
std::filesystem::path find_resource_folder(const std::string& kind, std::string_view name);

/// The models of a folder (with a '/' in its name), or of a list of names separated by commas.
std::vector<std::filesystem::path> find_models(const std::string& folder_or_list);

/// The page that shows results, web/report.html, looked up as models are. Empty: it is not there.
std::filesystem::path find_page();

/// Why there is no page, and what to do.
std::string page_missing();

}  // namespace toposcope::cli
