// SPDX-License-Identifier: BSD-3-Clause
// Centroid_Distance(min, max) of the dissertation, 4.6.

#include <cmath>

#include "toposcope/geometry/residuals.h"
#include "toposcope/plugin.h"

namespace {

using namespace toposcope;

class CentroidDistance final : public RelationTester {
 public:
  explicit CentroidDistance(const Options& options) : tolerance_rel_(options.real("tolerance_rel")) {}

  RelationResult test(const RelationInput& input, const Options& arguments, Context& /*context*/) const override {
    const FittedShape& first = *input.features[0].shape;
    const FittedShape& second = *input.features[1].shape;
    const double low = arguments.real("min");
    const double high = arguments.real("max");
    const double distance = (second.centroid - first.centroid).norm();
    const double diagonal = input.object_box.diagonal();
    RelationResult result;
    measure_range(result, distance, low, high);
    result.tolerance = tolerance_rel_ * diagonal;
    result.sd = std::hypot(first.centroid_sd, second.centroid_sd);
    result.clutter_density = 1 / diagonal;
    return result;
  }

 private:
  double tolerance_rel_;  // of the object box's diagonal
};

constexpr OptionSpec options[] = {
    {"tolerance_rel", OptionType::real, "diagonals", "0.01", "0.000001", "1",
     "how far beyond the model's range the distance may lie"},
};
constexpr OptionSpec arguments[] = {
    {"min", OptionType::real, "length", "0", "0", "", "least distance of the centroids", "", "max"},
    {"max", OptionType::real, "length", "", "0", "", "greatest distance of the centroids"},
};

}  // namespace

TOPOSCOPE_PLUGIN(RelationTester, CentroidDistance,
                 {.id = "centroid-distance",
                  .version = "1.0.0",
                  .summary = "The centroids of two features are between min and max apart",
                  .citation = "Neal 1999, section 4.6",
                  .unit = "length",
                  .min_arity = 2,
                  .max_arity = 2,
                  .options = options,
                  .arguments = arguments})
