// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/second_look.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "pipeline/bound_relation.h"
#include "pipeline/construct_features.h"
#include "probability/likelihood.h"

namespace toposcope {
namespace {

constexpr std::size_t most_fits = 500;  // of a feature
constexpr double near_violation = 2;    // in tolerances: a box tells centroid and direction of a shape but roughly
constexpr std::size_t grain = 32;

/// Which groups to fit for one feature.
class SecondLook {
 public:
  SecondLook(const ModelRun& run, const MeasuredWorkingSets& sets, std::span<const std::optional<Index>> labelled,
             const ConstructedFeatures& features, Index feature)
      : run_(run), sets_(sets), labelled_(labelled), features_(features), feature_(feature) {
    for (Index r = 0; r < run.model.relationships.size(); ++r) {
      const std::vector<Index>& scope = run.model.relationships[r].features;
      const bool known = std::all_of(scope.begin(), scope.end(), [&](Index f) { return f == feature || labelled[f]; });
      if (known && std::find(scope.begin(), scope.end(), feature) != scope.end()) relationships_.push_back(r);
    }
    const std::vector<Index>& fitted = features.of_feature[feature].constructed;
    if (!fitted.empty()) orientation_ = features.all[fitted.front()].shape.orientation;
  }

  std::vector<bool> free_sets() const {
    std::vector<bool> free(sets_.size(), true);
    for (Index other = 0; other < labelled_.size(); ++other) {
      if (other == feature_ || !labelled_[other]) continue;
      for (Index taken : features_.all[*labelled_[other]].sets)
        for (Index s = 0; s < sets_.size(); ++s)
          if (sets_.overlap.get(taken, s)) free[s] = false;
    }
    return free;
  }

  /// Those that the relationships with labelled features favour most, ascending.
  std::vector<std::size_t> worth_a_fit(const WorkingSetGroups& groups) const {
    std::vector<Worth> worth(groups.size());
    run_.context.parallel_for(groups.size(), grain, [&](std::size_t first, std::size_t last) {
      for (std::size_t g = first; g < last && !run_.context.cancelled(); ++g) worth[g] = worth_of(groups[g]);
    });
    std::vector<std::size_t> kept;
    for (std::size_t g = 0; g < groups.size(); ++g)
      if (worth[g].possible) kept.push_back(g);
    if (kept.size() > most_fits) {
      std::stable_sort(kept.begin(), kept.end(), [&](std::size_t a, std::size_t b) { return worth[b] < worth[a]; });
      kept.resize(most_fits);
      std::sort(kept.begin(), kept.end());
    }
    return kept;
  }

 private:
  struct Worth {
    bool possible = true;
    double evidence = 0;  ///< of the relationships, in nats
    double saliency = 0;  ///< of its sets, weighted by the root of their size
    bool operator<(const Worth& other) const {
      return evidence != other.evidence ? evidence < other.evidence : saliency < other.saliency;
    }
  };

  Worth worth_of(std::span<const Index> group) const {
    Worth worth;
    for (const Index s : group) worth.saliency += sets_.saliency[s] * std::sqrt(static_cast<double>(sets_[s].size()));
    if (relationships_.empty()) return worth;
    const ConstructedFeature box = box_of(group);
    std::vector<const ConstructedFeature*> operands;
    for (const Index r : relationships_) {
      operands.clear();
      for (const Index f : run_.model.relationships[r].features)
        operands.push_back(f == feature_ ? &box : &features_.all[*labelled_[f]]);
      const RelationResult result = test_relationship(run_, r, operands);
      worth.evidence += relation_evidence(run_.stations.probability, result);
      worth.possible = !result.applicable || violation(result) <= near_violation;
      if (!worth.possible) break;
    }
    return worth;
  }

  /// A group's box in the place of the shape that is not fitted yet.
  ConstructedFeature box_of(std::span<const Index> group) const {
    ConstructedFeature box;
    for (const Index s : group)
      for (const Index v : sets_[s]) {
        box.points.push_back(run_.mesh.positions[v]);
        box.vertices.push_back(v);
      }
    box.box = principal_box(box.points);
    box.shape.orientation = orientation_;
    box.shape.direction = box.box.axes[orientation_ == Orientation::line_like ? 0 : 2];
    box.shape.centroid = box.box.center;
    box.shape.outline = box.points;
    return box;
  }

  const ModelRun& run_;
  const MeasuredWorkingSets& sets_;
  std::span<const std::optional<Index>> labelled_;
  const ConstructedFeatures& features_;
  Index feature_;
  std::vector<Index> relationships_;  ///< with features that are labelled
  Orientation orientation_ = Orientation::none;
};

}  // namespace

bool has_second_look(const Model& model) {
  return std::any_of(model.features.begin(), model.features.end(),
                     [](const ModelFeature& feature) { return !feature.second_look.empty(); });
}

bool look_again(const ModelRun& run, const MeasuredWorkingSets& sets, std::span<const std::optional<Index>> labelled,
                ConstructedFeatures& features) {
  const std::size_t before = features.all.size();
  for (Index f = 0; f < run.model.features.size(); ++f) {
    const ModelFeature& feature = run.model.features[f];
    if (feature.second_look.empty()) continue;
    const SecondLook look(run, sets, labelled, features, f);
    WorkingSetGroups groups(feature, feature.second_look, sets, look.free_sets());
    groups.keep(look.worth_a_fit(groups));
    construct_more(run, sets, f, std::move(groups), features);
  }
  return features.all.size() > before;
}

}  // namespace toposcope
