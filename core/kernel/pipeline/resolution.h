// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>

#include "plugin/manifest.h"
#include "toposcope/options.h"

namespace toposcope {

/// How finely a mesh is looked at.
struct Resolution {
  std::size_t faces = 0;  ///< of a mesh of more than twice so many a coarse one is analysed; 0: every mesh itself
};

/// The kernel's own options: the `resolution` section of a pipeline manifest (docs/theory/resolution.md).
std::span<const OptionRow> resolution_option_table();

/// \pre checked against the table
Resolution resolution_of(const Options& options);

}  // namespace toposcope
