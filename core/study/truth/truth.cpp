// SPDX-License-Identifier: BSD-3-Clause
#include "truth/truth.h"

#include <algorithm>

namespace toposcope {

std::optional<TruthBand> TruthFeature::band() const {
  const auto values = [&](std::string_view wanted) -> const std::vector<double>* {
    for (const auto& [each, list] : parameters)
      if (each == wanted) return &list;
    return nullptr;
  };
  const std::vector<double>* radii = values("band");
  if (!radii) return std::nullopt;
  const auto [inner, outer] = std::minmax(radii->at(0), radii->at(1));
  return TruthBand{Vec3(values("center")->data()), Vec3(values("normal")->data()), inner, outer};
}

const TruthFeature* Truth::find(std::string_view name) const {
  for (const TruthFeature& feature : features)
    if (feature.name == name) return &feature;
  return nullptr;
}

}  // namespace toposcope
