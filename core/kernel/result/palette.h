// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

#include "io/mesh_io.h"

namespace toposcope {

/// Colours that people tell apart whatever kind of colour blindness they have (Okabe and Ito), the same in labels.ply,
/// page, pictures and exports.
inline constexpr Rgb no_label_color = {210, 210, 210};

/// Of the i-th feature of a result; they come again after eight.
Rgb feature_color(std::size_t feature);

/// Of a type of working sets; a type that is not known takes the colour of its index in the list of types.
Rgb working_set_color(std::string_view type, std::size_t index);

/// "#rrggbb"
std::string hex(const Rgb& color);

}  // namespace toposcope
