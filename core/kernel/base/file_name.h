// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace toposcope {

/// The name of one file or folder made of any text, so that what a file says never leads out of its folder: what
/// separates folders, means something to a shell, an address or another system, or cannot be seen becomes '_', and so
/// does a '.' at the beginning. Never empty; at most 200 bytes, so that an extension still fits. Letters of every
/// language and spaces within stay.
std::string file_name(std::string_view text);

}  // namespace toposcope
