// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

namespace toposcope {

// The JSON Schemas of folder schemas/, compiled in: files are checked without a data folder.

std::string_view dataset_schema();
std::string_view model_schema();
std::string_view pipeline_schema();
std::string_view plugin_schema();

}  // namespace toposcope
