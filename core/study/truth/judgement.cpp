// SPDX-License-Identifier: BSD-3-Clause
#include "truth/judgement.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "pipeline/classes.h"

namespace toposcope {
namespace {

/// The marks moved, in the band's plane, to the radius of the labelled circle as far as the band allows.
std::vector<Vec3> in_band(const std::vector<Vec3>& marks, const TruthBand& band, const FittedShape& shape) {
  const ShapeParameter* radius = shape.parameter("radius");
  if (!radius) return marks;
  const double wanted = std::clamp(radius->values[0], band.inner, band.outer);
  std::vector<Vec3> moved;
  for (const Vec3& mark : marks) {
    const Vec3 arm = mark - band.center;
    const double height = arm.dot(band.normal);
    const Vec3 radial = arm - height * band.normal;
    if (!(radial.norm() > 0)) return marks;
    moved.push_back(band.center + height * band.normal + wanted * radial.normalized());
  }
  return moved;
}

double mean_distance(const std::vector<Vec3>& points, const FittedShape& shape, const ShapeFitter& fitter) {
  double sum = 0;
  for (const Vec3& point : points) sum += fitter.distance(shape, point);
  return sum / static_cast<double>(points.size());
}

/// From points spread along the shape to the nearest mark.
double mean_distance_back(const FittedShape& shape, const std::vector<Vec3>& marks) {
  double sum = 0;
  for (const Vec3& point : shape.outline) {
    double least = std::numeric_limits<double>::infinity();
    for (const Vec3& mark : marks) least = std::min(least, (point - mark).squaredNorm());
    sum += std::sqrt(least);
  }
  return sum / static_cast<double>(std::max<std::size_t>(1, shape.outline.size()));
}

/// The farther of two ends from its group's centroid, the groups taken in the better order.
double ends_distance(const FittedShape& shape, const std::vector<TruthGroup>& groups) {
  const ShapeParameter* ends = shape.parameter("endpoints");
  if (!ends || ends->values.size() < 6 || groups.size() != 2) return std::numeric_limits<double>::infinity();
  const Vec3 first(ends->values.data()), last(ends->values.data() + ends->values.size() - 3);
  const auto farther = [&](const Vec3& a, const Vec3& b) { return std::max((first - a).norm(), (last - b).norm()); };
  return std::min(farther(groups[0].centroid, groups[1].centroid), farther(groups[1].centroid, groups[0].centroid));
}

/// `leg[2]` of the family `leg`.
bool is_instance(const std::string& name, const ModelFeature& feature) {
  return feature.count.family() && name.starts_with(feature.name + "[");
}

class Judge {
 public:
  Judge(const Limits& limits, const Judgement& scale) : limits_(limits), scale_(scale) {}

  /// \param fitter  of the reported shape
  FeatureJudgement feature(const FeatureReport& report, const ShapeFitter& fitter, const TruthFeature& truth) const {
    FeatureJudgement judged;
    judged.feature = truth.name;
    judged.probability = report.probability;
    if (!truth.exists()) {
      judged.verdict = report.present ? Verdict::spurious : Verdict::absent;
    } else if (!report.present) {
      judged.verdict = Verdict::missed;
    } else {
      measure(report.shape, fitter, truth, judged);
      judged.verdict = judged.excess <= 1 ? Verdict::right : Verdict::wrong;
    }
    return judged;
  }

  /// Instances have no names of their own: each of the truth's is compared with the nearest that was found and is free,
  /// the nearest of all first. What is left was missed, or is not there.
  void instances(const std::vector<const FeatureReport*>& found, const std::vector<const ShapeFitter*>& fitters,
                 const std::vector<const TruthFeature*>& known, std::vector<FeatureJudgement>& judged) const {
    struct Match {
      double excess;
      std::size_t truth, instance;
      auto operator<=>(const Match&) const = default;  // NOLINT(modernize-use-nullptr): the check misreads <=>
    };
    std::vector<Match> matches;
    for (std::size_t t = 0; t < known.size(); ++t)
      for (std::size_t i = 0; i < found.size(); ++i)
        if (const double excess = feature(*found[i], *fitters[i], *known[t]).excess; std::isfinite(excess))
          matches.push_back({excess, t, i});
    std::sort(matches.begin(), matches.end());
    std::vector<bool> free(found.size(), true);
    std::vector<const FeatureReport*> match_of(known.size(), nullptr);
    for (const Match& match : matches) {
      if (match_of[match.truth] || !free[match.instance]) continue;
      free[match.instance] = false;
      match_of[match.truth] = found[match.instance];
      judged.push_back(feature(*found[match.instance], *fitters[match.instance], *known[match.truth]));
    }
    for (std::size_t t = 0; t < known.size(); ++t)
      if (!match_of[t]) judged.push_back({.feature = known[t]->name, .verdict = Verdict::missed});
    for (std::size_t i = 0; i < found.size(); ++i)
      if (free[i])
        judged.push_back(
            {.feature = found[i]->name, .verdict = Verdict::spurious, .probability = found[i]->probability});
  }

  /// Least excess over all candidates of a feature.
  double best_candidate(const Analysis& analysis, const Model& model, const TruthFeature& truth) const {
    double best = std::numeric_limits<double>::infinity();
    for (Index f = 0; f < model.features.size() && f < analysis.problem.variables.size(); ++f) {
      if (model.features[f].name != truth.name && !is_instance(truth.name, model.features[f])) continue;
      for (const Index candidate : analysis.problem.variables[f].candidates) {
        FeatureJudgement judged;
        const ConstructedFeature& made = analysis.features.all[candidate];
        measure(made.shape, *made.fitter, truth, judged);
        best = std::min(best, judged.excess);
      }
    }
    return best;
  }

  /// What a shape is off, and by how much of what is allowed.
  void measure(const FittedShape& shape, const ShapeFitter& fitter, const TruthFeature& truth,
               FeatureJudgement& judged) const {
    if (!truth.groups.empty()) {
      judged.distance = ends_distance(shape, truth.groups);
      judged.excess = judged.distance / (limits_.ends_diagonal * scale_.diagonal);
      return;
    }
    const std::optional<TruthBand> band = truth.band();
    const std::vector<Vec3> marks = band ? in_band(truth.points, *band, shape) : truth.points;
    judged.distance = mean_distance(marks, shape, fitter);
    if (shape.parameter("endpoints"))
      judged.excess =
          std::max(judged.distance, mean_distance_back(shape, marks)) / (limits_.lines_diagonal * scale_.diagonal);
    else
      judged.excess = judged.distance / (limits_.shape_edges * scale_.mean_edge);
  }

 private:
  const Limits& limits_;
  const Judgement& scale_;
};

}  // namespace

std::string_view to_string(Verdict verdict) {
  switch (verdict) {
    case Verdict::right:
      return "right";
    case Verdict::wrong:
      return "wrong";
    case Verdict::missed:
      return "missed";
    case Verdict::absent:
      return "absent";
    case Verdict::spurious:
      return "spurious";
  }
  return "";
}

std::size_t Judgement::right() const {
  return static_cast<std::size_t>(
      std::count_if(features.begin(), features.end(), [](const FeatureJudgement& f) { return is_right(f.verdict); }));
}

double excess_of(const FittedShape& shape, const ShapeFitter& fitter, const TruthFeature& truth, const Judgement& scale,
                 const Limits& limits) {
  FeatureJudgement judged;
  Judge(limits, scale).measure(shape, fitter, truth, judged);
  return judged.excess;
}

Judgement judge(const Result& result, const Analysis& analysis, const Model& given_model,
                const Stations& given_stations, const Truth& truth, const Limits& limits) {
  const Model& model = analysis.written_out(given_model);
  const Stations& stations = analysis.written_out(given_stations);
  const ClassOutcome& posed = analysis.classes[analysis.best];
  Judgement scale;
  scale.mean_edge = truth.mean_edge.value_or(result.mean_edge);
  scale.diagonal = truth.diagonal.value_or(result.box.diagonal());
  const Judge judge(limits, scale);

  // A renaming is of the posed features alone; all others keep their names.
  Judgement best;
  double best_excess = std::numeric_limits<double>::infinity();
  const auto names = posed.renamings.empty() ? renamings_of(posed, model, stations) : posed.renamings;
  for (const std::vector<Index>& renamed : names) {
    std::vector<Index> name_of(model.features.size());
    std::iota(name_of.begin(), name_of.end(), 0);
    for (Index i = 0; i < renamed.size(); ++i) name_of[posed.features[i]] = posed.features[renamed[i]];
    Judgement judged = scale;
    double excess = 0;
    for (Index f = 0; f < model.features.size(); ++f) {
      if (given_model.features[analysis.origin(f)].count.family()) continue;
      const TruthFeature* known = truth.find(model.features[f].name);
      if (!known) continue;
      const FeatureReport& report = result.features[name_of[f]];
      const ShapeStation& made = stations.features[name_of[f]].of_plugin(report.shape_plugin);
      judged.features.push_back(judge.feature(report, *made.fitter, *known));
      const FeatureJudgement& last = judged.features.back();
      if (std::isfinite(last.excess)) excess += last.excess;
    }
    if (best.features.empty() || judged.right() > best.right() ||
        (judged.right() == best.right() && excess < best_excess)) {
      best = std::move(judged);
      best_excess = excess;
    }
  }
  for (Index family = 0; family < given_model.features.size(); ++family) {
    std::vector<const TruthFeature*> known;
    for (const TruthFeature& each : truth.features)
      if (is_instance(each.name, given_model.features[family]) && each.exists()) known.push_back(&each);
    if (known.empty()) continue;
    std::vector<const FeatureReport*> found;
    std::vector<const ShapeFitter*> fitters;
    for (Index f = 0; f < model.features.size(); ++f)
      if (analysis.origin(f) == family && result.features[f].present) {
        found.push_back(&result.features[f]);
        fitters.push_back(stations.features[f].of_plugin(result.features[f].shape_plugin).fitter.get());
      }
    judge.instances(found, fitters, known, best.features);
  }
  for (FeatureJudgement& judged : best.features)
    if (judged.verdict == Verdict::wrong || judged.verdict == Verdict::missed)
      judged.offered = judge.best_candidate(analysis, given_model, *truth.find(judged.feature));
  best.mean_edge = scale.mean_edge;
  best.diagonal = scale.diagonal;
  return best;
}

}  // namespace toposcope
