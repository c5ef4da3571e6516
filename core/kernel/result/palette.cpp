// SPDX-License-Identifier: BSD-3-Clause
#include "result/palette.h"

#include <fmt/format.h>

#include <iterator>

namespace toposcope {
namespace {

constexpr Rgb features[] = {{0, 158, 115}, {204, 121, 167}, {86, 180, 233}, {230, 159, 0},
                            {0, 114, 178}, {213, 94, 0},    {240, 228, 66}, {90, 90, 90}};

struct TypeColor {
  std::string_view type;
  Rgb color;
};
constexpr TypeColor types[] = {
    {"convex", {213, 94, 0}}, {"concave", {0, 114, 178}}, {"planar", {0, 158, 115}}, {"other", {240, 228, 66}}};
constexpr Rgb other_types[] = {{204, 121, 167}, {86, 180, 233}, {230, 159, 0}, {90, 90, 90}};

}  // namespace

Rgb feature_color(std::size_t feature) {
  return features[feature % std::size(features)];
}

Rgb working_set_color(std::string_view type, std::size_t index) {
  for (const TypeColor& each : types)
    if (each.type == type) return each.color;
  return other_types[index % std::size(other_types)];
}

std::string hex(const Rgb& color) {
  return fmt::format("#{:02x}{:02x}{:02x}", color[0], color[1], color[2]);
}

}  // namespace toposcope
