// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

namespace toposcope {

/// Lower-case words of letters and digits, joined by '-'.
bool is_plugin_id(std::string_view id);

}  // namespace toposcope
