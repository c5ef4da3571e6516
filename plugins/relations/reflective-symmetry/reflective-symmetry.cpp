// SPDX-License-Identifier: BSD-3-Clause
// Reflective symmetry of two features (dissertation 4.6): is there a plane that mirrors one onto the other?

#include <algorithm>
#include <cmath>

#include "mirror.h"
#include "toposcope/geometry/point_sets.h"
#include "toposcope/plugin.h"

namespace {

using namespace toposcope;

constexpr std::size_t coarse_limit = 64;  // points of a feature at first: most pairs are hopeless
constexpr std::size_t query_limit = 128;  // points of a feature that are mirrored in the end
constexpr int refinement_steps = 20;
constexpr double promising = 2;  // tolerances: beyond it the residual among thinned points is answer enough

std::string parameter_names(const FittedShape& shape) {
  std::string names;
  for (const ShapeParameter& parameter : shape.parameters) names += (names.empty() ? "" : ", ") + parameter.name;
  return names;
}

bool same_kind(const FittedShape& first, const FittedShape& second) {
  if (first.orientation != second.orientation || first.parameters.size() != second.parameters.size()) return false;
  return std::equal(first.parameters.begin(), first.parameters.end(), second.parameters.begin(),
                    [](const ShapeParameter& a, const ShapeParameter& b) { return a.name == b.name; });
}

// The largest difference of like sides of the boxes where they differ by more than a factor of two and beyond doubt.
double side_mismatch(const Box& first, const Box& second, double tolerance) {
  double largest = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto [low, high] = std::minmax(first.sides[i], second.sides[i]);
    if (high > 2 * low && high - low > 2 * tolerance) largest = std::max(largest, high - low);
  }
  return largest;
}

// Planes to begin with: between the centroids; where these (nearly) coincide, across the principal axes of all points.
std::vector<mirror::Plane> initial_planes(std::span<const Vec3> first, std::span<const Vec3> second, double tolerance) {
  const Vec3 from = mirror::mean(first), to = mirror::mean(second);
  const Vec3 middle = (from + to) / 2;
  const double apart = (to - from).norm();
  std::vector<mirror::Plane> planes;
  if (apart > 0) planes.push_back({(to - from) / apart, middle});
  if (apart <= tolerance) {
    std::vector<Vec3> all(first.begin(), first.end());
    all.insert(all.end(), second.begin(), second.end());
    for (const Vec3& axis : principal_axes(all).axes) planes.push_back({axis, middle});
  }
  return planes;
}

double residual(const RelationOperand& a, const RelationOperand& b, double tolerance) {
  // Along the principal axis: smooth in the points, where a box's axes may jump.
  const mirror::SortedPoints first_all(a.points, principal_axes(a.points).axes[0]);
  const mirror::SortedPoints second_all(b.points, principal_axes(b.points).axes[0]);
  const mirror::SortedPoints first = first_all.thinned(coarse_limit, 0.5);
  const mirror::SortedPoints second = second_all.thinned(coarse_limit, 0.5);
  mirror::Refined best;
  for (const mirror::Plane& plane : initial_planes(a.points, b.points, tolerance)) {
    const mirror::Refined refined = mirror::refine(plane, {first, first}, {second, second}, refinement_steps);
    if (refined.mean_squared < best.mean_squared) best = refined;
  }
  const double coarse = std::sqrt(best.mean_squared);
  if (first.size() == first_all.size() && second.size() == second_all.size()) return coarse;
  // Thinned sets are sparse, and that reads as distance: as much as another sample of the same set is away.
  const double sparseness = std::sqrt(std::max(mirror::mean_squared(first_all.thinned(coarse_limit, 0), first),
                                               mirror::mean_squared(second_all.thinned(coarse_limit, 0), second)));
  if (coarse > promising * tolerance + 1.5 * sparseness) return coarse;
  const mirror::SortedPoints first_fine = first_all.thinned(query_limit, 0.5);
  const mirror::SortedPoints second_fine = second_all.thinned(query_limit, 0.5);
  return std::sqrt(
      mirror::refine(best.plane, {first_fine, first_all}, {second_fine, second_all}, refinement_steps).mean_squared);
}

class ReflectiveSymmetry final : public RelationTester {
 public:
  explicit ReflectiveSymmetry(const Options& options) : tolerance_(options.real("tolerance")) {}

  RelationResult test(const RelationInput& input, const Options& /*arguments*/, Context& /*context*/) const override {
    const RelationOperand &a = input.features[0], &b = input.features[1];
    RelationResult result;
    result.applicable = false;
    if (!same_kind(*a.shape, *b.shape)) {
      result.why = "shapes of different kinds do not mirror each other: (" + parameter_names(*a.shape) + ") against (" +
                   parameter_names(*b.shape) + ")";
      return result;
    }
    if (a.points.empty() || b.points.empty()) {
      result.why = "a feature without points mirrors nothing";
      return result;
    }
    result.applicable = true;
    result.tolerance = tolerance_ * input.mean_edge;
    const double mismatch = side_mismatch(a.box, b.box, result.tolerance);
    result.residual = mismatch > 0 ? mismatch : residual(a, b, result.tolerance);
    // The points themselves are compared, not the fitted shapes: the fits' uncertainty plays no part.
    result.sd = 0;
    result.samples = std::max(1.0, std::min(a.shape->explained, b.shape->explained));
    result.clutter_density = 4 / input.object_box.diagonal();
    return result;
  }

 private:
  double tolerance_;  // mean edges
};

constexpr OptionSpec options[] = {
    {"tolerance", OptionType::real, "mean-edges", "2", "0.001", "1000",
     "largest rms distance between one feature and the mirror image of the other"},
};

}  // namespace

TOPOSCOPE_PLUGIN(RelationTester, ReflectiveSymmetry,
                 {.id = "reflective-symmetry",
                  .version = "1.0.0",
                  .summary = "A plane mirrors one feature onto the other",
                  .citation = "Neal 1999, section 4.6",
                  .unit = "length",
                  .min_arity = 2,
                  .max_arity = 2,
                  .options = options})
