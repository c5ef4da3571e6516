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

  /// Least excess over all candidates of a feature.
  double best_candidate(const Analysis& analysis, const Model& model, const TruthFeature& truth) const {
    double best = std::numeric_limits<double>::infinity();
    for (Index f = 0; f < model.features.size() && f < analysis.problem.variables.size(); ++f) {
      if (model.features[f].name != truth.name) continue;
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

Judgement judge(const Result& result, const Analysis& analysis, const Model& model, const Stations& stations,
                const Truth& truth, const Limits& limits) {
  const ClassOutcome& posed = analysis.classes[analysis.best];
  Judgement scale;
  scale.mean_edge = truth.mean_edge.value_or(result.mean_edge);
  scale.diagonal = truth.diagonal.value_or(result.box.diagonal());
  const Judge judge(limits, scale);

  // A renaming is of the posed features alone; all others keep their names.
  Judgement best;
  double best_excess = std::numeric_limits<double>::infinity();
  for (const std::vector<Index>& renamed : renamings_of(posed, model, stations)) {
    std::vector<Index> name_of(model.features.size());
    std::iota(name_of.begin(), name_of.end(), 0);
    for (Index i = 0; i < renamed.size(); ++i) name_of[posed.features[i]] = posed.features[renamed[i]];
    Judgement judged = scale;
    double excess = 0;
    for (Index f = 0; f < model.features.size(); ++f) {
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
  for (FeatureJudgement& judged : best.features)
    if (judged.verdict == Verdict::wrong || judged.verdict == Verdict::missed)
      judged.offered = judge.best_candidate(analysis, model, *truth.find(judged.feature));
  best.mean_edge = scale.mean_edge;
  best.diagonal = scale.diagonal;
  return best;
}

}  // namespace toposcope
