// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/tell_apart.h"

#include <algorithm>

#include "pipeline/same_shape.h"

namespace toposcope {
namespace {

/// The places of one orbit: candidates of one shape together, each with the probability that some feature of the orbit
/// has it.
class OrbitPlaces {
 public:
  OrbitPlaces(const Interchange& interchange, const std::vector<Index>& orbit)
      : problem_(interchange.solved.problem),
        features_(interchange.features),
        mean_edge_(interchange.run.mesh.mean_edge) {
    for (const Index v : orbit) {
      const LabelingVariable& variable = problem_.variables[v];
      for (Index value = 1; value < variable.domain(); ++value)
        add(variable.candidates[value - 1], interchange.solved.outcome.posteriors[v][value]);
    }
    std::stable_sort(taken_.begin(), taken_.end(), [](const Taken& a, const Taken& b) { return a.by > b.by; });
  }

  /// What is left beside a candidate that has a feature already.
  void take(Index candidate) {
    std::erase_if(taken_, [&](const Taken& each) {
      return problem_.conflict(each.candidate, candidate) || same_place(each.candidate, candidate);
    });
  }

  /// The likeliest candidate of the likeliest place, where that is more likely than not; else `no_candidate`.
  Index likeliest() const {
    Index best = no_candidate;
    double most = 0.5, left = 0;
    for (const Taken& each : taken_) left += each.by;
    for (const Taken& each : taken_) {
      // A place that begins here has no more than what is left by then: earlier ones were looked at.
      if (left <= most) break;
      double sum = 0;
      for (const Taken& other : taken_)
        if (same_place(each.candidate, other.candidate)) sum += other.by;
      if (sum > most) most = sum, best = each.candidate;
      left -= each.by;
    }
    return best;
  }

 private:
  struct Taken {
    Index candidate;
    double by;  ///< probability, summed over the features
  };

  void add(Index candidate, double probability) {
    const auto at =
        std::find_if(taken_.begin(), taken_.end(), [&](const Taken& each) { return each.candidate == candidate; });
    if (at == taken_.end())
      taken_.push_back({candidate, probability});
    else
      at->by += probability;
  }

  bool same_place(Index a, Index b) const {
    return a == b || same_shape(features_.all[a], features_.all[b], mean_edge_);
  }

  const LabelingProblem& problem_;
  const ConstructedFeatures& features_;
  double mean_edge_;
  std::vector<Taken> taken_;
};

}  // namespace

std::vector<Index> own_places(const Interchange& interchange) {
  const auto& [solved, orbits, features, run] = interchange;
  std::vector<Index> places = solved.outcome.labelings.front().values;
  if (solved.outcome.posteriors.empty()) return places;
  for (Index v = 0; v < places.size(); ++v) {
    const std::vector<Index>& orbit = orbits[v];
    if (orbit.size() < 2 || orbit.front() != v) continue;
    if (std::all_of(orbit.begin(), orbit.end(), [&](Index w) { return places[w] > 0; })) continue;
    OrbitPlaces of_orbit(interchange, orbit);
    for (Index w = 0; w < places.size(); ++w)
      if (places[w] > 0) of_orbit.take(solved.problem.variables[w].candidate(places[w]));
    for (const Index w : orbit) {
      if (places[w] > 0) continue;
      const Index likeliest = of_orbit.likeliest();
      const std::vector<Index>& own = solved.problem.variables[w].candidates;
      const auto at = std::find(own.begin(), own.end(), likeliest);
      if (likeliest == no_candidate || at == own.end()) break;
      places[w] = static_cast<Index>(at - own.begin()) + 1;
      of_orbit.take(likeliest);
    }
  }
  return places;
}

std::vector<std::vector<Index>> told_apart(const Interchange& interchange, const std::vector<Index>& places) {
  const LabelingProblem& problem = interchange.solved.problem;
  const auto made = [&](Index variable, Index value) -> const ConstructedFeature& {
    return interchange.features.all[problem.variables[variable].candidates[value - 1]];
  };
  const auto distance = [&](const ConstructedFeature& a, const ConstructedFeature& b) {
    return (a.shape.centroid - b.shape.centroid).squaredNorm();
  };
  std::vector<std::vector<Index>> kept(places.size());
  for (Index v = 0; v < places.size(); ++v)
    for (Index value = 0; value < problem.variables[v].domain(); ++value) {
      bool own = true;
      if (value > 0)
        for (const Index w : interchange.orbits[v]) {
          if (w == v || places[w] == 0 || !own) continue;
          const ConstructedFeature& at = made(v, value);
          const ConstructedFeature& other = made(w, places[w]);
          own = places[v] > 0 ? distance(at, made(v, places[v])) <= distance(at, other)
                              : !same_shape(at, other, interchange.run.mesh.mean_edge);
        }
      if (own) kept[v].push_back(value);
    }
  return kept;
}

std::vector<std::vector<double>> summed_over_names(const Interchange& interchange, const std::vector<Index>& places,
                                                   const std::vector<std::vector<Index>>& kept) {
  const auto& [solved, orbits, features, run] = interchange;
  const std::vector<LabelingVariable>& variables = solved.problem.variables;
  std::vector<std::vector<double>> sums(kept.size());
  for (Index v = 0; v < kept.size(); ++v) {
    const auto sharing = std::count_if(orbits[v].begin(), orbits[v].end(), [&](Index w) { return places[w] == 0; });
    sums[v].assign(kept[v].size(), 0);
    double own = 0, others = 0;
    std::vector<bool> at_place(kept[v].size(), false);
    for (std::size_t i = 0; i < kept[v].size(); ++i) {
      if (kept[v][i] == 0) continue;
      const Index candidate = variables[v].candidates[kept[v][i] - 1];
      for (const Index w : orbits[v]) {
        const std::vector<Index>& of_w = variables[w].candidates;
        const auto at = std::find(of_w.begin(), of_w.end(), candidate);
        if (at != of_w.end())
          sums[v][i] += solved.outcome.posteriors[w][static_cast<std::size_t>(at - of_w.begin()) + 1];
      }
      // What has no place of its own is whichever feature has none.
      if (places[v] == 0) sums[v][i] /= static_cast<double>(sharing);
      at_place[i] =
          places[v] > 0 &&
          same_shape(features.all[candidate], features.all[variables[v].candidates[places[v] - 1]], run.mesh.mean_edge);
      (at_place[i] ? own : others) += sums[v][i];
    }
    const double own_scale = own > 1 ? 1 / own : 1, left = std::max(0.0, 1 - own);
    const double scale = others > left ? left / others : 1;
    for (std::size_t i = 0; i < kept[v].size(); ++i) sums[v][i] *= at_place[i] ? own_scale : scale;
    sums[v][0] = std::max(0.0, left - others * scale);  // missing is always kept, and first
  }
  return sums;
}

}  // namespace toposcope
