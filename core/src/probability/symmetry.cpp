// SPDX-License-Identifier: BSD-3-Clause
#include "probability/symmetry.h"

#include <algorithm>
#include <numeric>
#include <set>
#include <string>

namespace toposcope {
namespace {

/// All that tells features apart but their names.
std::string signature(const ModelFeature& feature) {
  std::string text = feature.shape.plugin + "|" + std::to_string(feature.detectability);
  for (const auto& [name, value] : feature.shape.arguments) text += "|" + name + "=" + value;
  for (const std::string& type : feature.worksets) text += "|" + type;
  for (const Range& range : feature.ranges)
    text +=
        "|" + (range.low ? range.low->text() : "") + "<" + range.measure + "<" + (range.high ? range.high->text() : "");
  if (feature.max_fit_error) text += "|" + feature.max_fit_error->text();
  return text;
}

/// The relationships under a renaming, as a set; two features of a relationship may stand in either order.
std::multiset<std::string> relationships_under(const Model& model, const std::vector<Index>& renamed) {
  std::multiset<std::string> all;
  for (const Relationship& relationship : model.relationships) {
    std::vector<Index> features;
    for (Index f : relationship.features) features.push_back(renamed[f]);
    if (features.size() == 2) std::sort(features.begin(), features.end());
    std::string text = relationship.plugin;
    for (Index f : features) text += "|" + std::to_string(f);
    for (const auto& [name, value] : relationship.arguments) text += "|" + name + "=" + value.text();
    if (relationship.tolerance) text += "|" + relationship.tolerance->text();
    all.insert(std::move(text));
  }
  return all;
}

}  // namespace

std::vector<std::vector<Index>> interchangeable_features(const Model& model) {
  const Index count = static_cast<Index>(model.features.size());
  std::vector<std::string> signatures;
  for (const ModelFeature& feature : model.features) signatures.push_back(signature(feature));
  std::vector<Index> renamed(count);
  std::iota(renamed.begin(), renamed.end(), 0);
  const std::multiset<std::string> original = relationships_under(model, renamed);

  std::vector<std::set<Index>> orbit(count);
  for (Index f = 0; f < count; ++f) orbit[f].insert(f);
  // Models are small; beyond this only the trivial renaming is considered.
  constexpr std::size_t most_renamings = 50'000;
  std::size_t tried = 0;
  std::vector<bool> taken(count, false);
  const auto extend = [&](auto&& self, Index f) -> void {
    if (tried > most_renamings) return;
    if (f == count) {
      ++tried;
      if (relationships_under(model, renamed) == original)
        for (Index g = 0; g < count; ++g) orbit[g].insert(renamed[g]);
      return;
    }
    for (Index g = 0; g < count; ++g) {
      if (taken[g] || signatures[f] != signatures[g]) continue;
      taken[g] = true;
      renamed[f] = g;
      self(self, f + 1);
      taken[g] = false;
    }
  };
  extend(extend, 0);
  std::vector<std::vector<Index>> result;
  for (const auto& features : orbit) result.emplace_back(features.begin(), features.end());
  return result;
}

}  // namespace toposcope
