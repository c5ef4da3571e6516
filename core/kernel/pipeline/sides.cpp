// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/sides.h"

#include <algorithm>
#include <string_view>
#include <utility>

namespace toposcope {
namespace {

using Renaming = std::vector<Index>;

/// The values that a labelling's candidates have under other names; nothing where a feature does not have one of them.
std::optional<std::vector<Index>> renamed_values(const LabelingProblem& problem, const std::vector<Index>& values,
                                                 const Renaming& renaming) {
  std::vector<Index> renamed(values.size(), 0);
  for (Index v = 0; v < values.size(); ++v) {
    if (values[v] == 0) continue;
    const std::vector<Index>& offered = problem.variables[renaming[v]].candidates;
    const auto at = std::find(offered.begin(), offered.end(), problem.variables[v].candidates[values[v] - 1]);
    if (at == offered.end()) return std::nullopt;
    renamed[renaming[v]] = static_cast<Index>(at - offered.begin()) + 1;
  }
  return renamed;
}

/// Tells right from left: names exchangeable features of the best labelling so that its directions are right-handed.
class SideTeller {
 public:
  SideTeller(const ClassOutcome& posed, const ConstructedFeatures& features, const ModelRun& run)
      : posed_(posed), features_(features), run_(run), useful_(posed.renamings.size() > 1 && names_all(run.model)) {
    if (useful_) middle_ = middle_of(run.mesh);
  }

  /// \param values  of the best labelling; renamed where that tells sides
  std::optional<Sides> tell(std::vector<Index>& values) const {
    if (!useful_) return std::nullopt;
    const std::optional<OwnAxes> as_it_is = axes_of(values);
    if (!as_it_is) return std::nullopt;
    Sides sides{*as_it_is, right_handed(*as_it_is).value_or(0), std::vector<bool>(values.size(), false)};
    std::vector<Index> best = values;
    for (const Renaming& renaming : posed_.renamings) {
      const auto renamed = renamed_values(posed_.problem, values, renaming);
      const auto axes = renamed ? axes_of(*renamed) : std::nullopt;
      if (!axes || !(*right_handed(*axes) > sides.probability + least_gain)) continue;
      sides.axes = *axes;
      sides.probability = *right_handed(*axes);
      best = *renamed;
    }
    if (!(sides.probability > 0.5 + least_gain)) return std::nullopt;
    values = std::move(best);
    return sides;
  }

  /// The renamings that leave the sides as they are; what the others move hangs on the sides.
  std::vector<Renaming> keeping(Sides& sides, const std::vector<Index>& values) const {
    std::vector<Renaming> kept;
    for (const Renaming& renaming : posed_.renamings) {
      const auto renamed = renamed_values(posed_.problem, values, renaming);
      const auto axes = renamed ? axes_of(*renamed) : std::nullopt;
      if (axes && *right_handed(*axes) > 0.5)
        kept.push_back(renaming);
      else
        for (Index v = 0; v < renaming.size(); ++v) sides.named[v] = sides.named[v] || renaming[v] != v;
    }
    return kept;
  }

 private:
  static constexpr double least_gain = 1e-9;  ///< rounding

  /// Whether there are associations of every direction.
  static bool names_all(const Model& model) {
    const auto any = [&](std::string_view one, std::string_view other) {
      return std::any_of(model.abstract.associations.begin(), model.abstract.associations.end(),
                         [&](const Link& link) { return link.kind == one || link.kind == other; });
    };
    return any("up", "down") && any("front", "back") && any("right", "left");
  }

  /// Of a labelling; nothing where they do not tell a hand.
  std::optional<OwnAxes> axes_of(const std::vector<Index>& values) const {
    std::vector<const FittedShape*> found(run_.model.features.size(), nullptr);
    for (Index v = 0; v < values.size(); ++v)
      if (values[v] > 0)
        found[posed_.features[v]] = &features_.all[posed_.problem.variables[v].candidates[values[v] - 1]].shape;
    const OwnAxes axes = own_axes(run_.model, found, middle_);
    return right_handed(axes) ? std::optional(axes) : std::nullopt;
  }

  const ClassOutcome& posed_;
  const ConstructedFeatures& features_;
  const ModelRun& run_;
  bool useful_;
  Place middle_;
};

}  // namespace

std::optional<Sides> tell_sides(ClassOutcome& posed, std::vector<Index>& places, const ConstructedFeatures& features,
                                const ModelRun& run) {
  const SideTeller teller(posed, features, run);
  std::optional<Sides> sides = teller.tell(places);
  if (sides) posed.renamings = teller.keeping(*sides, places);
  return sides;
}

}  // namespace toposcope
