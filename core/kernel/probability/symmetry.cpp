// SPDX-License-Identifier: BSD-3-Clause
#include "probability/symmetry.h"

#include <algorithm>
#include <numeric>
#include <set>
#include <string>

#include "model/model_words.h"

namespace toposcope {
namespace {

/// All that tells features apart but their names.
std::string signature(const ModelFeature& feature, bool by_detectability) {
  std::string text;
  const auto add_shape = [&](const ShapeSpec& shape) {
    text += "|shape " + shape.plugin;
    for (const auto& [name, value] : shape.arguments) text += "|" + name + "=" + value;
  };
  add_shape(feature.shape);
  for (const ShapeSpec& other : feature.other_shapes) add_shape(other);
  text += "|count " + count_in_words(feature.count);
  if (by_detectability) text += "|" + std::to_string(feature.detectability);
  for (const std::string& type : feature.worksets) text += "|" + type;
  for (const std::string& type : feature.second_look) text += "|again " + type;
  for (const Range& range : feature.ranges)
    text +=
        "|" + (range.low ? range.low->text() : "") + "<" + range.measure + "<" + (range.high ? range.high->text() : "");
  if (feature.max_fit_error) text += "|" + feature.max_fit_error->text();
  return text;
}

/// The question's relationships under a renaming of positions, as a set.
std::multiset<std::string> relationships_under(const Question& question, const std::vector<Index>& renamed) {
  std::multiset<std::string> all;
  const std::vector<Index>& features = question.features;
  for (Index r : question.relationships) {
    const Relationship& relationship = question.model.relationships[r];
    std::vector<Index> scope;
    for (Index f : relationship.features)
      scope.push_back(
          renamed[static_cast<std::size_t>(std::find(features.begin(), features.end(), f) - features.begin())]);
    if (!question.ordered[r]) std::sort(scope.begin(), scope.end());
    std::string text = relationship.plugin;
    for (Index position : scope) text += "|" + std::to_string(position);
    for (const auto& [name, value] : relationship.arguments) text += "|" + name + "=" + value.text();
    for (const auto& [name, value] : relationship.words) text += "|" + name + "=" + value;
    if (relationship.tolerance) text += "|" + relationship.tolerance->text();
    all.insert(std::move(text));
  }
  return all;
}

/// Tries every renaming among features of one signature; the identity comes first.
class Renamings {
 public:
  explicit Renamings(const Question& question)
      : question_(question), renamed_(question.features.size()), taken_(question.features.size(), false) {
    for (Index f : question.features)
      signatures_.push_back(signature(question.model.features[f], question.by_detectability));
    std::iota(renamed_.begin(), renamed_.end(), 0);
    original_ = relationships_under(question, renamed_);
    extend(0);
    if (tried_ > most_renamings) found.resize(1);
  }

  std::vector<std::vector<Index>> found;

 private:
  static constexpr std::size_t most_renamings = 50'000;

  void extend(Index f) {
    if (tried_ > most_renamings) return;
    if (f == renamed_.size()) {
      ++tried_;
      if (relationships_under(question_, renamed_) == original_) found.push_back(renamed_);
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
};

}  // namespace

std::vector<std::vector<Index>> renamings(const Question& question) {
  return Renamings(question).found;
}

std::vector<std::vector<Index>> orbits_of(const std::vector<std::vector<Index>>& renamings) {
  std::vector<std::vector<Index>> orbits(renamings.front().size());
  for (const std::vector<Index>& renamed : renamings)
    for (Index f = 0; f < renamed.size(); ++f) orbits[f].push_back(renamed[f]);
  for (std::vector<Index>& orbit : orbits) {
    std::sort(orbit.begin(), orbit.end());
    orbit.erase(std::unique(orbit.begin(), orbit.end()), orbit.end());
  }
  return orbits;
}

}  // namespace toposcope
