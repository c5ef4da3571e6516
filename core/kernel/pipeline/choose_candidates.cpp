// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/choose_candidates.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "model/model_words.h"
#include "pipeline/same_shape.h"
#include "probability/likelihood.h"
#include "toposcope/geometry/point_sets.h"

namespace toposcope {
namespace {

/// How far a value misses its limit, for the choice of the nearest; a value that is none misses most.
double miss(double value, double limit) {
  return std::isfinite(value) ? std::abs(value - limit) / std::max(std::abs(limit), 1e-300)
                              : std::numeric_limits<double>::infinity();
}

void add_bound(const ModelFeature& feature, const GroupVerdict& verdict, std::vector<BoundCount>& bounds) {
  auto place = std::lower_bound(bounds.begin(), bounds.end(), verdict.bound,
                                [](const BoundCount& each, Index bound) { return each.bound < bound; });
  if (place == bounds.end() || place->bound != verdict.bound)
    place =
        bounds.insert(place, {verdict.bound, bound_in_words(feature, verdict.bound), 0, verdict.value, verdict.limit});
  ++place->groups;
  if (miss(verdict.value, verdict.limit) >= miss(place->nearest, place->limit)) return;
  place->nearest = verdict.value;
  place->limit = verdict.limit;
}

void add(std::span<const GroupVerdict> verdicts, const ModelFeature& feature, CandidateCount& count) {
  count.groups += verdicts.size();
  for (const GroupVerdict& verdict : verdicts) {
    switch (verdict.status) {
      case GroupStatus::boxed_out:
        ++count.boxed_out;
        break;
      case GroupStatus::unusable:
        ++count.unusable;
        break;
      case GroupStatus::out_of_range:
        ++count.out_of_range;
        break;
      case GroupStatus::poor_fit:
        ++count.poor_fit;
        break;
      case GroupStatus::fitted:
        ++count.kept;
        break;
    }
    if (verdict.status != GroupStatus::fitted && verdict.status != GroupStatus::unusable)
      add_bound(feature, verdict, count.bounds);
  }
}

/// Half of the greatest error that the model allows is a typical one; where it says nothing, the pipeline does.
double fit_error_sd(const ModelFeature& feature, const MeshView& mesh, const Box& working_sets,
                    const ProbabilityModel& probability) {
  if (feature.max_fit_error)
    return positive_on_mesh(*feature.max_fit_error, {mesh.box, working_sets}, feature.where, "max_fit_error") / 2;
  return probability.fit_error_scale * mesh.mean_edge;
}

/// A candidate there was, or a group that may become one.
struct Choice {
  double cost;         ///< log of the number of choices less the evidence
  std::size_t number;  ///< the candidates there were come first, then the groups
  const FittedShape* shape;
  std::span<const Index> sets;
  bool operator<(const Choice& other) const { return cost != other.cost ? cost < other.cost : number < other.number; }
};

/// Chooses among the fits of one job for each of its features.
class Chooser {
 public:
  Chooser(const FitJob& job, const GroupFits& fits, const ModelRun& run, const MeasuredWorkingSets& sets,
          ConstructedFeatures& features)
      : job_(job),
        fits_(fits),
        run_(run),
        sets_(sets),
        features_(features),
        constructed_(fits.groups.size(), not_constructed) {}

  /// \param i  of the job's features
  void choose(std::size_t i) {
    FeatureCandidates& candidates = features_.of_feature[job_.features[i]];
    const FeatureCandidates old = candidates;
    const std::size_t before = old.constructed.size();
    const double ways = ways_of(i);
    std::vector<Choice> choices = choices_of(i, old, ways);
    std::sort(choices.begin(), choices.end());
    const std::size_t all = choices.size();
    if (job_.second_look) join_alike(choices, before);
    choices.resize(std::min(choices.size(), most_candidates(i)));
    add(fits_.verdicts[i], run_.model.features[job_.features[i]], candidates.count);
    candidates.count.beaten += all - choices.size();
    candidates.count.kept -= all - choices.size();
    candidates.constructed.clear();
    candidates.evidence.clear();
    candidates.ways.clear();
    for (const Choice& choice : choices) {
      const bool is_old = choice.number < before;
      candidates.ways.push_back(is_old ? old.ways[choice.number] : ways);
      candidates.evidence.push_back(std::log(candidates.ways.back()) - choice.cost);
      candidates.constructed.push_back(is_old ? old.constructed[choice.number] : constructed(choice.number - before));
    }
  }

 private:
  static constexpr Index not_constructed = std::numeric_limits<Index>::max();

  /// Ten instances have as many candidates as ten features.
  std::size_t most_candidates(std::size_t i) const {
    const InstanceCount& count = run_.model.features[job_.features[i]].count;
    constexpr Index most_times = 10;  // tables of pairs grow with the square
    return run_.stations.probability.max_candidates * std::min(count.most.value_or(most_times), most_times);
  }

  /// How many groups there would be to choose from, had all been tried.
  double ways_of(std::size_t i) const {
    const auto fitted =
        static_cast<double>(std::count_if(fits_.verdicts[i].begin(), fits_.verdicts[i].end(),
                                          [](const GroupVerdict& v) { return v.status == GroupStatus::fitted; }));
    const double tried = static_cast<double>(std::max<std::size_t>(1, fits_.groups.size()));
    // Alternatives too are choices.
    const double shapes = static_cast<double>(run_.stations.features[job_.features[i]].shape_count());
    return std::max(1.0, shapes * fitted * (static_cast<double>(fits_.groups.chosen_from()) / tried));
  }

  std::vector<Choice> choices_of(std::size_t i, const FeatureCandidates& old, double ways) const {
    const ProbabilityModel& probability = run_.stations.probability;
    const ModelFeature& feature = run_.model.features[job_.features[i]];
    std::vector<Choice> choices;
    for (std::size_t c = 0; c < old.constructed.size(); ++c) {
      const ConstructedFeature& each = features_.all[old.constructed[c]];
      choices.push_back({std::log(old.ways[c]) - old.evidence[c], c, &each.shape, each.sets});
    }
    for (std::size_t g = 0; g < fits_.groups.size(); ++g) {
      if (fits_.verdicts[i][g].status != GroupStatus::fitted) continue;
      const FittedShape& shape = fits_.shapes[g];
      const double evidence =
          fit_evidence(probability, shape, fit_error_sd(feature, run_.mesh, fits_.boxes[g], probability));
      choices.push_back({std::log(ways) - evidence, old.constructed.size() + g, &shape, fits_.groups[g]});
    }
    return choices;
  }

  /// Of the groups, numbered from `first` on, those whose sets overlap and whose shape is the same become one choice,
  /// the best: it gets the sum of their likelihoods. Nested sets make many such groups, none of which would stand out
  /// by itself.
  /// \param choices  ascending
  void join_alike(std::vector<Choice>& choices, std::size_t first) const {
    const ShapeFitter& fitter = *job_.station(run_.stations).fitter;
    std::vector<Choice> joined;
    for (const Choice& choice : choices) {
      const auto like = std::find_if(joined.begin(), joined.end(), [&](const Choice& other) {
        return choice.number >= first && overlap_pairwise(sets_.overlap, choice.sets, other.sets) &&
               same_shape(fitter, *choice.shape, *other.shape, run_.mesh.mean_edge);
      });
      if (like == joined.end())
        joined.push_back(choice);
      else
        like->cost -= std::log1p(std::exp(like->cost - choice.cost));
    }
    std::sort(joined.begin(), joined.end());
    choices = std::move(joined);
  }

  /// The constructed feature of a group, made when the first feature of the job wants it.
  Index constructed(std::size_t g) {
    if (constructed_[g] != not_constructed) return constructed_[g];
    constructed_[g] = static_cast<Index>(features_.all.size());
    ConstructedFeature& made = features_.all.emplace_back();
    made.sets.assign(fits_.groups[g].begin(), fits_.groups[g].end());
    made.shape = fits_.shapes[g];
    made.fitter = job_.station(run_.stations).fitter.get();
    made.plugin = job_.station(run_.stations).plugin;
    made.dimension = job_.station(run_.stations).dimension;
    points_.gather(run_.mesh, sets_, fits_.groups[g]);
    made.points = points_.points;
    made.vertices = points_.vertices;
    made.box = fits_.groups.arity() == 1 ? fits_.boxes[g] : oriented_box(made.points);
    return constructed_[g];
  }

  const FitJob& job_;
  const GroupFits& fits_;
  const ModelRun& run_;
  const MeasuredWorkingSets& sets_;
  ConstructedFeatures& features_;
  std::vector<Index> constructed_;  ///< per group, into `features_.all`
  GroupPoints points_;
};

}  // namespace

void choose_candidates(const FitJob& job, const GroupFits& fits, const ModelRun& run, const MeasuredWorkingSets& sets,
                       ConstructedFeatures& features) {
  Chooser chooser(job, fits, run, sets, features);
  for (std::size_t i = 0; i < job.features.size(); ++i) chooser.choose(i);
}

}  // namespace toposcope
