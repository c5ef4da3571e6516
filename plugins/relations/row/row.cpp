// SPDX-License-Identifier: BSD-3-Clause
// Three or more features stand in a straight row at equal distances.

#include <algorithm>
#include <vector>

#include "toposcope/geometry/patterns.h"
#include "toposcope/plugin.h"

namespace {

using namespace toposcope;

class Row final : public RelationTester {
 public:
  explicit Row(const Options& options) : tolerance_rel_(options.real("tolerance_rel")) {}

  RelationResult test(const RelationInput& input, const Options& arguments, Context& /*context*/) const override {
    std::vector<Vec3> points;
    for (const RelationOperand& each : input.features) points.push_back(each.shape->centroid);
    const bool equal = arguments.boolean("equal");
    const std::optional<PointRow> row = point_row(points, equal);
    RelationResult result;
    if (!row || !(row->spacing > 0)) {
      result.applicable = false;
      result.why = "the centroids lie in one place: no row goes through them";
      return result;
    }
    const double excess = std::max({0.0, arguments.real("min") - row->spacing, row->spacing - arguments.real("max")});
    const int count = static_cast<int>(points.size());
    measure_pattern(result, input, row->rms, equal ? 6 : 4 + count, excess);
    result.tolerance = tolerance_rel_ * row->spacing;
    return result;
  }

 private:
  double tolerance_rel_;  // of the distance of neighbours
};

constexpr OptionSpec options[] = {
    {"tolerance_rel", OptionType::real, "", "0.05", "0.000001", "1",
     "how far from their places the features may be (root mean square), as part of the distance of neighbours"},
};
constexpr OptionSpec arguments[] = {
    {"equal", OptionType::boolean, "", "true", "", "", "at equal distances; false: on one line, at any distances"},
    {"min", OptionType::real, "length", "0", "0", "", "least distance of neighbours", "", "max"},
    {"max", OptionType::real, "length", "1e30", "0", "", "greatest distance of neighbours"},
};

}  // namespace

TOPOSCOPE_PLUGIN(RelationTester, Row,
                 {.id = "row",
                  .version = "1.0.0",
                  .summary = "Three or more features stand in a straight row at equal distances",
                  .unit = "length",
                  .min_arity = 3,
                  .max_arity = 0,
                  .options = options,
                  .arguments = arguments})
