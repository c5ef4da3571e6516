// SPDX-License-Identifier: BSD-3-Clause
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

#include "polyline.h"

namespace toposcope::line_group {
namespace {

/// One working set as a patch of surface.
struct Patch {
  double area = 0;
  Vec3 centroid = Vec3::Zero();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< of the centroid

  Patch(const FitInput& input, Weight weight, std::size_t set) {
    const Index first = input.set_offsets[set], count = input.set_offsets[set + 1] - first;
    const std::span<const Vec3> points = input.points.subspan(first, count);
    std::vector<double> weights(input.areas.begin() + first, input.areas.begin() + first + count);
    area = std::accumulate(weights.begin(), weights.end(), 0.0);
    const double way = weight == Weight::concave ? -1 : weight == Weight::convex ? 1 : 0;
    const std::span<const double> curvature = input.integrated_mean_curvature;
    const auto bends = [&](Index i) { return curvature.empty() ? 0 : way * curvature[first + i]; };
    bool bent = false;  // a set that does not bend that way has its area's centroid
    for (Index i = 0; i < count; ++i) bent = bent || bends(i) > 0;
    for (Index i = 0; bent && i < count; ++i) weights[i] = std::max(0.0, bends(i));
    double total = 0, squares = 0;
    Vec3 moment = Vec3::Zero();
    for (Index i = 0; i < count; ++i) {
      total += weights[i];
      squares += weights[i] * weights[i];
      moment += weights[i] * (points[i] - points[0]);
    }
    centroid = points[0] + moment / total;
    for (Index i = 0; i < count; ++i)
      covariance += weights[i] / total * (points[i] - centroid) * (points[i] - centroid).transpose();
    // A patch of n vertices counts as sqrt(n) samples: where it ends is uncertain by whole rows. Where weights vanish
    // at its end, as so many of equal weight would.
    covariance /= bent ? total * total / squares : std::sqrt(static_cast<double>(count));
  }
};

}  // namespace

void describe_centroids(const FitInput& input, Weight weight, FittedShape& shape) {
  std::vector<Patch> patches;
  for (std::size_t k = 0; k + 1 < input.set_offsets.size(); ++k) patches.emplace_back(input, weight, k);
  const Patch &first = patches.front(), &last = patches.back();
  const Polyline polyline{{first.centroid, last.centroid}, false};
  if (!(polyline.length(0) > 1e-9 * input.box.diagonal())) {
    shape.summary = {Termination::degenerate, "the centroids of the first and the last working set coincide", 0, 0, 0};
    return;
  }
  double squares = 0;
  for (const Vec3& point : input.points) squares += nearest(polyline, point).squared;
  shape.rms = std::sqrt(squares / static_cast<double>(input.points.size()));
  shape.summary = {Termination::closed_form, "centroids of the working sets", 0, squares / 2, squares / 2};
  shape.coverage = 1;
  shape.explained = shape.unexplained = 0;
  for (const Patch& patch : patches) shape.explained += std::sqrt(patch.area) / input.mean_edge;

  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(6, 6);
  covariance.topLeftCorner<3, 3>() = first.covariance;
  covariance.bottomRightCorner<3, 3>() = last.covariance;
  set_shape(polyline, covariance, input.mean_edge, shape);
  const Ends measured(input.set_boxes.front(), input.set_boxes.back());
  shape.measures.push_back({"end_size", measured.size, input.mean_edge});
  shape.measures.push_back({"end_depth", measured.depth, 0});
}

Ends::Ends(const Box& first, const Box& last)
    : size(std::max(first.a(), last.a())), depth(std::min(first.c() / first.a(), last.c() / last.a())) {}

}  // namespace toposcope::line_group
