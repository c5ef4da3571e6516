// SPDX-License-Identifier: BSD-3-Clause
#include "learn/learn.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "learn/predictive.h"
#include "model/model_words.h"

namespace toposcope {
namespace {

/// Three significant digits, away from the middle: nothing that was within comes to lie outside.
std::string rounded(double value, bool up) {
  if (value == 0) return "0";
  const double step = std::pow(10, std::floor(std::log10(std::abs(value))) - 2);
  return fmt::format("{:.6g}", (up ? std::ceil(value / step) : std::floor(value / step)) * step);
}

double spread(const std::vector<double>& values) {
  double mean = 0, squares = 0;
  for (const double value : values) mean += std::log(value) / static_cast<double>(values.size());
  for (const double value : values) squares += std::pow(std::log(value) - mean, 2);
  return std::sqrt(squares);
}

class Learner {
 public:
  Learner(const Model& model, const std::vector<Observation>& observations, double coverage)
      : model_(model), observations_(observations), coverage_(coverage) {}

  Learned learn() {
    for (Index f = 0; f < model_.features.size(); ++f) learn_feature(f);
    for (Index r = 0; r < model_.relationships.size(); ++r) learn_tolerance(r);
    return std::move(learned_);
  }

 private:
  void learn_feature(Index f) {
    const ModelFeature& feature = model_.features[f];
    std::size_t marked = 0, offered = 0;
    for (const Observation& each : observations_) {
      const SeenFeature& seen = each.features[f];
      marked += seen.marked;
      offered += seen.offered;
      for (const std::string& bound : seen.broken)
        learned_.contradictions.push_back(each.source + ": '" + feature.name + "' breaks " + bound);
      if (seen.exists && !seen.offered && seen.broken.empty())
        learned_.contradictions.push_back(each.source + ": '" + feature.name +
                                          "' is marked, and no candidate is there; see toposcope model probe");
    }
    if (marked == 0) return;
    for (const Range& range : feature.ranges) learn_range(f, range);
    const double share = predict_share(offered, marked);
    learned_.lessons.push_back({{"features", feature.name, "detectability"},
                                fmt::format("{:.2g}", share),
                                number_in_words(feature.detectability)});
  }

  void learn_range(Index f, const Range& range) {
    std::vector<std::vector<double>> by_side(3);
    for (const Observation& each : observations_) {
      const auto seen = each.features[f].measures.find(range.measure);
      if (seen == each.features[f].measures.end()) continue;
      for (std::size_t side = 0; side < 3; ++side) by_side[side].push_back(seen->second[side]);
    }
    if (by_side[0].empty()) return;
    // Another side than the longest must be clearly better: of few meshes one of three is so by chance.
    constexpr double clearly = 0.7;
    std::size_t best = 0;
    for (std::size_t side = 1; side < 3; ++side)
      if (by_side[side].size() > 2 && spread(by_side[side]) < clearly * spread(by_side[best])) best = side;
    const int power = std::max(range.low ? range.low->dimension() : 0, range.high ? range.high->dimension() : 0);
    std::string unit;
    for (int k = 0; k < power; ++k) unit += std::string("*bb(O).") + static_cast<char>('a' + best);
    const PredictiveInterval next = predict(by_side[best], coverage_);
    std::string text = range.measure;
    if (range.low) text = rounded(next.low, false) + unit + " < " + text;
    if (range.high) text += " < " + rounded(next.high, true) + unit;
    learned_.lessons.push_back(
        {{"features", model_.features[f].name, "ranges", range.measure}, text, range_in_words(range)});
  }

  /// Wide enough for what was seen; a relation that holds better than it must is left as it is.
  void learn_tolerance(Index r) {
    const Relationship& relationship = model_.relationships[r];
    std::vector<double> residuals;
    double tolerance = 0;
    std::string unit;
    for (const Observation& each : observations_) {
      const SeenRelation& seen = each.relations[r];
      if (!seen.tested) continue;
      if (!seen.applicable || !seen.satisfied)
        learned_.contradictions.push_back(
            each.source + ": " + relationship.name + " " + relationship.plugin +
            (seen.applicable ? fmt::format(" does not hold: residual {:.3g}, tolerance {:.3g} {}", seen.residual,
                                           seen.tolerance, seen.unit == "deg" ? "deg" : "of bb(O).a")
                             : " does not apply to what is marked"));
      if (!seen.applicable) continue;
      residuals.push_back(seen.residual);
      tolerance = std::max(tolerance, seen.tolerance);
      unit = seen.unit;
    }
    if (residuals.empty()) return;
    const double wanted = predict_deviation(residuals, coverage_);
    if (wanted <= tolerance || !relationship.because.empty()) return;  // what follows is not in the file
    learned_.lessons.push_back({{"relationships", relationship.name, "tolerance"},
                                rounded(wanted, true) + (unit == "deg" ? "" : "*bb(O).a"),
                                relationship.tolerance ? relationship.tolerance->text() : ""});
  }

  const Model& model_;
  const std::vector<Observation>& observations_;
  double coverage_;
  Learned learned_;
};

}  // namespace

Learned learn(const Model& model, const std::vector<Observation>& observations, double coverage) {
  return Learner(model, observations, coverage).learn();
}

}  // namespace toposcope
