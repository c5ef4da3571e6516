// SPDX-License-Identifier: BSD-3-Clause
// The dissertation's fit (4.4.1).

#include <cmath>
#include <nlopt.hpp>

#include "circle_fit.h"
#include "toposcope/geometry/point_sets.h"

namespace toposcope::circle {

Estimate fit_powell(std::span<const Vec3> points, const Box& box, double radius_limit) {
  Estimate estimate;
  const PrincipalAxes axes = principal_axes(points);
  estimate.summary.message = degeneracy(axes);
  estimate.summary.termination = Termination::degenerate;
  if (!estimate.summary.message.empty()) return estimate;

  struct Problem {
    std::vector<Vec3> points;  // along the plane's axes and its normal, unit = spread
    int evaluations = 0;
    double first = 0;
  } problem;
  const double unit = std::sqrt(axes.variance[0] + axes.variance[1] + axes.variance[2]);
  const auto in_plane = [&](const Vec3& p) -> Vec3 {
    const Vec3 arm = (p - axes.centroid) / unit;
    return {arm.dot(axes.axes[0]), arm.dot(axes.axes[1]), arm.dot(axes.axes[2])};
  };
  for (const Vec3& point : points) problem.points.push_back(in_plane(point));
  const nlopt::vfunc cost = [](const std::vector<double>& x, std::vector<double>&, void* data) {
    auto& self = *static_cast<Problem*>(data);
    double sum = 0;
    for (const Vec3& p : self.points) {
      const double radial = std::hypot(p.x() - x[0], p.y() - x[1]) - x[2];
      sum += radial * radial + p.z() * p.z();
    }
    if (self.evaluations++ == 0) self.first = sum / 2;
    return sum / 2;
  };

  const Vec3 center = in_plane(box.center);
  std::vector<double> x = {center.x(), center.y(), (box.a() + box.b()) / 4 / unit};
  double final_cost = 0;
  constexpr double exact = 1e-20;  // the points lie on the circle to 1e-10 of their spread
  try {
    nlopt::srand(1);  // PRAXIS draws at random: the same numbers for every fit, on every thread
    nlopt::opt praxis(nlopt::LN_PRAXIS, 3);
    praxis.set_min_objective(cost, &problem);
    praxis.set_xtol_rel(1e-9);
    praxis.set_ftol_rel(1e-14);
    praxis.set_stopval(exact);
    praxis.set_initial_step(0.1);  // of the spread; by default a coordinate that starts near 0 hardly moves
    praxis.set_maxeval(5000);
    const nlopt::result why = praxis.optimize(x, final_cost);
    // PRAXIS does not notice that it stands on the minimum already.
    const bool converged = why != nlopt::MAXEVAL_REACHED || final_cost < exact;
    estimate.summary = {converged ? Termination::converged : Termination::iteration_limit,
                        converged ? "converged" : "no convergence in 5000 evaluations", problem.evaluations,
                        problem.first * unit * unit, final_cost * unit * unit};
  } catch (const nlopt::roundoff_limited&) {
    estimate.summary = {Termination::converged, "converged to rounding", problem.evaluations,
                        problem.first * unit * unit, final_cost * unit * unit};
  }
  estimate.circle = {axes.centroid + unit * (x[0] * axes.axes[0] + x[1] * axes.axes[1]), axes.axes[2],
                     unit * std::abs(x[2])};
  check_radius(estimate, radius_limit);
  return estimate;
}

}  // namespace toposcope::circle
