// SPDX-License-Identifier: BSD-3-Clause
#include <stdexcept>

#include "centroid_shape.h"

namespace {
class ThrowsCreating : public CentroidShape {
 public:
  explicit ThrowsCreating(const toposcope::Options& options) : CentroidShape(options) {
    throw std::runtime_error("no table of centroids here");
  }
};
}  // namespace

TOPOSCOPE_PLUGIN(ShapeFitter, ThrowsCreating,
                 {.id = "throws-creating",
                  .version = "1.0.0",
                  .summary = "The centroid of the points",
                  .min_arity = 1,
                  .max_arity = 1,
                  .dimension = 0})
