// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/same_shape.h"

#include <Eigen/Geometry>

namespace toposcope {
namespace {

/// Whether the boxes of two outlines meet within a limit: pieces of one plane or axis that lie apart are two shapes.
bool meet(const std::vector<Vec3>& a, const std::vector<Vec3>& b, double limit) {
  Eigen::AlignedBox3d first, second;
  for (const Vec3& p : a) first.extend(p);
  for (const Vec3& p : b) second.extend(p);
  return a.empty() || b.empty() || first.squaredExteriorDistance(second) <= limit * limit;
}

bool lies_on(const ShapeFitter& fitter, const FittedShape& from, const FittedShape& to, double limit) {
  const double most = limit * static_cast<double>(from.outline.size());
  double sum = 0;
  for (const Vec3& p : from.outline)
    if ((sum += fitter.distance(to, p)) > most) return false;
  return true;
}

}  // namespace

bool same_shape(const ShapeFitter& fitter, const FittedShape& a, const FittedShape& b, double limit) {
  return meet(a.outline, b.outline, limit) && lies_on(fitter, a, b, limit) && lies_on(fitter, b, a, limit);
}

bool same_shape(const ConstructedFeature& a, const ConstructedFeature& b, double limit) {
  return a.fitter && a.fitter == b.fitter && same_shape(*a.fitter, a.shape, b.shape, limit);
}

}  // namespace toposcope
