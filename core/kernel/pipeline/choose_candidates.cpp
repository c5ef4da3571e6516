// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/choose_candidates.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "pipeline/same_shape.h"
#include "toposcope/geometry/point_sets.h"

namespace toposcope {
namespace {

void count(CandidateCount& count, std::span<const Fate> fates) {
  count.groups += fates.size();
  for (Fate fate : fates) switch (fate) {
      case Fate::boxed_out:
        ++count.boxed_out;
        break;
      case Fate::unusable:
        ++count.unusable;
        break;
      case Fate::out_of_range:
        ++count.out_of_range;
        break;
      case Fate::poor_fit:
        ++count.poor_fit;
        break;
      case Fate::fitted:
        ++count.kept;
        break;
    }
}

/// Half of the greatest error that the model allows is a typical one; where it says nothing, the pipeline does.
double fit_error_sd(const ModelFeature& feature, const MeshView& mesh, const Box& worksets,
                    const ProbabilityModel& probability) {
  if (feature.max_fit_error)
    return positive_on_mesh(*feature.max_fit_error, {mesh.box, worksets}, feature.where, "max_fit_error") / 2;
  return probability.fit_error_scale * mesh.mean_edge;
}

/// A candidate there was, or behind them a group that may become one.
struct Choice {
  double cost;  ///< log of the number of choices less the evidence
  std::size_t place;
  const FittedShape* shape;
  std::span<const Index> sets;
  bool operator<(const Choice& other) const { return cost != other.cost ? cost < other.cost : place < other.place; }
};

/// Of the groups from `first` on, those in the same places with the same shape become one choice, the best: it gets the
/// sum of their likelihoods. Nested sets make many such groups, none of which would stand out by itself.
/// \param choices  ascending
void join_levels(std::vector<Choice>& choices, std::size_t first, const ShapeFitter& fitter, double same,
                 const BitMatrix& overlap) {
  std::vector<Choice> joined;
  for (const Choice& choice : choices) {
    const auto like = std::find_if(joined.begin(), joined.end(), [&](const Choice& other) {
      return choice.place >= first && same_places(overlap, choice.sets, other.sets) &&
             same_shape(fitter, *choice.shape, *other.shape, same);
    });
    if (like == joined.end())
      joined.push_back(choice);
    else
      like->cost -= std::log1p(std::exp(like->cost - choice.cost));
  }
  std::sort(joined.begin(), joined.end());
  choices = std::move(joined);
}

}  // namespace

void choose_candidates(const FitJob& job, const WorkingSetGroups& groups, const GroupFits& fits,
                       const FitGround& ground, const Choosing& choosing, ConstructedFeatures& out) {
  constexpr Index unmade = std::numeric_limits<Index>::max();
  std::vector<Index> made(groups.size(), unmade);  // into out.all
  std::vector<Choice> choices;
  GroupPoints at;
  for (std::size_t i = 0; i < job.features.size(); ++i) {
    const ModelFeature& feature = ground.model.features[job.features[i]];
    FeatureCandidates& candidates = out.of_feature[job.features[i]];
    count(candidates.count, fits.fates[i]);
    const FeatureCandidates old = candidates;
    const std::size_t before = old.constructed.size();
    const auto fitted = static_cast<double>(std::count(fits.fates[i].begin(), fits.fates[i].end(), Fate::fitted));
    const double tried = static_cast<double>(std::max<std::size_t>(1, groups.size()));
    const double ways =
        std::max(1.0, fitted * (choosing.chosen_from ? static_cast<double>(*choosing.chosen_from) / tried : 1));
    choices.clear();
    for (std::size_t c = 0; c < before; ++c) {
      const ConstructedFeature& constructed = out.all[old.constructed[c]];
      choices.push_back({std::log(old.ways[c]) - old.evidence[c], c, &constructed.shape, constructed.sets});
    }
    for (Index g = 0; g < groups.size(); ++g) {
      if (fits.fates[i][g] != Fate::fitted) continue;
      const FittedShape& shape = fits.shapes[g];
      const double evidence = fit_evidence(choosing.probability, shape,
                                           fit_error_sd(feature, ground.mesh, fits.boxes[g], choosing.probability));
      choices.push_back({std::log(ways) - evidence, before + g, &shape, groups[g]});
    }
    std::sort(choices.begin(), choices.end());
    const std::size_t all = choices.size();
    if (choosing.chosen_from) join_levels(choices, before, *job.fitter, ground.mesh.mean_edge, choosing.overlap);
    choices.resize(std::min(choices.size(), choosing.probability.max_candidates));
    candidates.count.beaten += all - choices.size();
    candidates.count.kept -= all - choices.size();
    candidates.constructed.clear();
    candidates.evidence.clear();
    candidates.ways.clear();
    for (const Choice& choice : choices) {
      const std::size_t place = choice.place;
      candidates.ways.push_back(place < before ? old.ways[place] : ways);
      candidates.evidence.push_back(std::log(candidates.ways.back()) - choice.cost);
      if (place < before) {
        candidates.constructed.push_back(old.constructed[place]);
        continue;
      }
      const Index g = static_cast<Index>(place - before);
      if (made[g] == unmade) {
        made[g] = static_cast<Index>(out.all.size());
        ConstructedFeature& constructed = out.all.emplace_back();
        constructed.sets.assign(groups[g].begin(), groups[g].end());
        constructed.shape = fits.shapes[g];
        at.gather(ground.mesh, ground.of_vertices, ground.sets, groups[g]);
        constructed.points = at.points;
        constructed.vertices = at.vertices;
        constructed.box = groups.arity() == 1 ? fits.boxes[g] : oriented_box(constructed.points);
      }
      candidates.constructed.push_back(made[g]);
    }
  }
}

}  // namespace toposcope
