// SPDX-License-Identifier: BSD-3-Clause
#include "probability/symmetry.h"

#include <algorithm>
#include <numeric>
#include <set>
#include <string>

namespace toposcope {
namespace {

/// All that tells features apart but their names.
std::string signature(const ModelFeature& feature, bool by_detectability) {
  std::string text = feature.shape.plugin;
  if (by_detectability) text += "|" + std::to_string(feature.detectability);
  for (const auto& [name, value] : feature.shape.arguments) text += "|" + name + "=" + value;
  for (const std::string& type : feature.worksets) text += "|" + type;
  for (const Range& range : feature.ranges)
    text +=
        "|" + (range.low ? range.low->text() : "") + "<" + range.measure + "<" + (range.high ? range.high->text() : "");
  if (feature.max_fit_error) text += "|" + feature.max_fit_error->text();
  return text;
}

struct Question {
  const Model& model;
  const std::vector<Index>& features;
  const std::vector<Index>& relationships;
  const std::vector<bool>& ordered;

  /// The relationships under a renaming of positions, as a set.
  std::multiset<std::string> under(const std::vector<Index>& renamed) const {
    std::multiset<std::string> all;
    for (Index r : relationships) {
      const Relationship& relationship = model.relationships[r];
      std::vector<Index> scope;
      for (Index f : relationship.features)
        scope.push_back(
            renamed[static_cast<std::size_t>(std::find(features.begin(), features.end(), f) - features.begin())]);
      if (!ordered[r]) std::sort(scope.begin(), scope.end());
      std::string text = relationship.plugin;
      for (Index position : scope) text += "|" + std::to_string(position);
      for (const auto& [name, value] : relationship.arguments) text += "|" + name + "=" + value.text();
      if (relationship.tolerance) text += "|" + relationship.tolerance->text();
      all.insert(std::move(text));
    }
    return all;
  }
};

/// Tries every renaming among features of one signature.
class Renamings {
 public:
  Renamings(const Question& question, std::vector<std::string> signatures)
      : question_(question),
        signatures_(std::move(signatures)),
        renamed_(signatures_.size()),
        taken_(signatures_.size(), false),
        orbits(signatures_.size()) {
    std::iota(renamed_.begin(), renamed_.end(), 0);
    original_ = question.under(renamed_);
    extend(0);
    // Beyond the limit only the trivial renaming is considered.
    if (tried_ > most_renamings)
      for (std::set<Index>& orbit : orbits) orbit.clear();
    for (Index f = 0; f < orbits.size(); ++f) orbits[f].insert(f);
  }

 private:
  static constexpr std::size_t most_renamings = 50'000;

  void extend(Index f) {
    if (tried_ > most_renamings) return;
    if (f == renamed_.size()) {
      ++tried_;
      if (question_.under(renamed_) == original_)
        for (Index g = 0; g < f; ++g) orbits[g].insert(renamed_[g]);
      return;
    }
    for (Index g = 0; g < renamed_.size(); ++g) {
      if (taken_[g] || signatures_[f] != signatures_[g]) continue;
      taken_[g] = true;
      renamed_[f] = g;
      extend(f + 1);
      taken_[g] = false;
    }
  }

  const Question& question_;
  std::vector<std::string> signatures_;
  std::vector<Index> renamed_;
  std::vector<bool> taken_;
  std::multiset<std::string> original_;
  std::size_t tried_ = 0;

 public:
  std::vector<std::set<Index>> orbits;
};

}  // namespace

std::vector<std::vector<Index>> interchangeable_features(const Model& model, const std::vector<Index>& features,
                                                         const std::vector<Index>& relationships,
                                                         const std::vector<bool>& ordered, bool by_detectability) {
  std::vector<std::string> signatures;
  for (Index f : features) signatures.push_back(signature(model.features[f], by_detectability));
  const Question question{model, features, relationships, ordered};
  std::vector<std::vector<Index>> result;
  for (const std::set<Index>& orbit : Renamings(question, std::move(signatures)).orbits)
    result.emplace_back(orbit.begin(), orbit.end());
  return result;
}

}  // namespace toposcope
