// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/same_shape.h"

namespace toposcope {
namespace {

bool lies_on(const ShapeFitter& fitter, const FittedShape& from, const FittedShape& to, double limit) {
  const double most = limit * static_cast<double>(from.outline.size());
  double sum = 0;
  for (const Vec3& p : from.outline)
    if ((sum += fitter.distance(to, p)) > most) return false;
  return true;
}

}  // namespace

bool same_shape(const ShapeFitter& fitter, const FittedShape& a, const FittedShape& b, double limit) {
  return lies_on(fitter, a, b, limit) && lies_on(fitter, b, a, limit);
}

}  // namespace toposcope
