// SPDX-License-Identifier: BSD-3-Clause
// What an object that has a left and a right has in the middle: a fin between two stabilisers.

#include <algorithm>
#include <cmath>

#include "toposcope/plugin.h"

namespace {

using namespace toposcope;

constexpr std::size_t most_points = 16;  // of an outline: the tables of three features are large

class MirrorPlane final : public RelationTester {
 public:
  explicit MirrorPlane(const Options& options) : tolerance_rel_(options.real("tolerance_rel")) {}

  RelationResult test(const RelationInput& input, const Options& /*arguments*/, Context& /*context*/) const override {
    RelationResult best;
    for (std::size_t middle = 0; middle < 3; ++middle) {
      const RelationResult result =
          midway(input, *input.features[middle].shape, *input.features[(middle + 1) % 3].shape,
                 *input.features[(middle + 2) % 3].shape);
      if (!result.applicable) return result;
      if (middle == 0 || result.residual * best.tolerance < best.residual * result.tolerance) best = result;
    }
    return best;
  }

 private:
  RelationResult midway(const RelationInput& input, const FittedShape& self, const FittedShape& left,
                        const FittedShape& right) const {
    const Vec3 across = right.centroid - left.centroid, middle = (left.centroid + right.centroid) / 2;
    const double between = across.norm();
    RelationResult result;
    result.applicable = between > 0;
    if (!result.applicable) {
      result.why = "two of the features have one centroid: no plane lies between them";
      return result;
    }
    const auto squared = [&](const Vec3& point) {
      const double off = (point - middle).dot(across) / between;
      return off * off;
    };
    double sum = squared(self.centroid);
    std::size_t count = 1;
    const std::size_t stride = self.outline.size() / most_points + 1;
    for (std::size_t i = 0; i < self.outline.size(); i += stride, ++count) sum += squared(self.outline[i]);
    result.residual = std::sqrt(sum / static_cast<double>(count));
    result.tolerance = tolerance_rel_ * between;
    result.sd = std::hypot(self.centroid_sd, left.centroid_sd / 2, right.centroid_sd / 2);
    result.dof = 1;
    result.clutter_density = 2 / input.object_box.b();
    return result;
  }

  double tolerance_rel_;  // of the distance between the two that mirror each other
};

constexpr OptionSpec options[] = {
    {"tolerance_rel", OptionType::real, "", "0.1", "0.000001", "1",
     "how far from the plane the one may lie (root mean square), as part of the distance between the other two"},
};

}  // namespace

TOPOSCOPE_PLUGIN(RelationTester, MirrorPlane,
                 {.id = "mirror-plane",
                  .version = "1.0.0",
                  .summary = "One of three features lies in the plane midway between the other two",
                  .unit = "length",
                  .min_arity = 3,
                  .max_arity = 3,
                  .options = options})
