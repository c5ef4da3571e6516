// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "plugin/manifest.h"

namespace toposcope {

/// A plugin's documentation page with its tables as the manifest has them. A table stands between the lines
/// `<!-- table: options -->` (or arguments, provides) and `<!-- end of table -->`; all else is left as it is.
/// \throw UsageError  unknown or unfinished block; a table of options or arguments that has no block
std::string with_tables(const std::string& page, const PluginManifest& plugin);

}  // namespace toposcope
