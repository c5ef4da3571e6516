// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Arrays of numbers as JSON: little-endian bytes in base64 (RFC 4648).

#include <cstdint>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "toposcope/types.h"

namespace toposcope {

std::string to_base64(std::string_view bytes);
/// \throw std::invalid_argument  it is none
std::string from_base64(std::string_view text);

using SceneJson = nlohmann::ordered_json;

/// "u16" where all values fit, else "u32".
SceneJson index_buffer(std::span<const Index> values);
SceneJson index_buffer(std::span<const Triangle> triangles);
SceneJson byte_buffer(std::span<const std::uint8_t> values);
/// "f32".
SceneJson point_buffer(std::span<const Vec3> points);
/// "q16": 16 bits for each coordinate, over the box of the points along x, y, z.
SceneJson quantised_buffer(std::span<const Vec3> points);

/// Each reads what the above write. \throw std::invalid_argument  says what is wrong
std::vector<Index> read_indices(const SceneJson& buffer);
std::vector<Triangle> read_triangles(const SceneJson& buffer);
std::vector<Vec3> read_points(const SceneJson& buffer);

}  // namespace toposcope
