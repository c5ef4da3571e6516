// SPDX-License-Identifier: BSD-3-Clause
// The dissertation's fit (4.4.2).

#include <nlopt.hpp>

#include "polyline.h"

namespace toposcope::line_group {
namespace {

constexpr int evaluation_limit = 20000;
constexpr double exact = 1e-16;  // cost at which the points lie on the polyline to about 1e-9 of their spread

struct Cost {
  const Problem* problem = nullptr;
  Polyline polyline;
  int evaluations = 0;

  double operator()() const {
    double sum = 0;
    for (const Vec3& point : problem->points) sum += nearest(polyline, point).squared;
    return sum / 2;
  }
  static double evaluate(const std::vector<double>& x, std::vector<double>&, void* data) {
    Cost& self = *static_cast<Cost*>(data);
    for (std::size_t i = 0; i < self.polyline.vertices.size(); ++i) self.polyline.vertices[i] = Vec3(&x[3 * i]);
    ++self.evaluations;
    return self();
  }
};

}  // namespace

Estimate fit_powell(const Problem& problem) {
  Cost cost{&problem, {}, 0};
  double least = std::numeric_limits<double>::infinity();
  for (const Polyline& start : starts(problem)) {
    const double value = two_sided_cost(problem, start);
    if (value < least) least = value, cost.polyline = start;
  }
  const double initial = cost();
  std::vector<double> x;
  for (const Vec3& vertex : cost.polyline.vertices) x.insert(x.end(), vertex.begin(), vertex.end());

  Estimate estimate;
  double final_cost = 0;
  bool converged = true;
  try {
    nlopt::srand(1);  // PRAXIS draws at random: the same numbers for every fit, on every thread
    nlopt::opt praxis(nlopt::LN_PRAXIS, static_cast<unsigned>(x.size()));
    praxis.set_min_objective(&Cost::evaluate, &cost);
    praxis.set_xtol_rel(1e-6);
    praxis.set_ftol_rel(1e-9);
    praxis.set_stopval(exact);
    praxis.set_initial_step(0.1);  // of the spread; by default a coordinate that starts near 0 hardly moves
    praxis.set_maxeval(evaluation_limit);
    converged = praxis.optimize(x, final_cost) != nlopt::MAXEVAL_REACHED || final_cost < exact;
  } catch (const nlopt::roundoff_limited&) {
    final_cost = Cost::evaluate(x, x, &cost);
  }
  estimate.summary = {
      converged ? Termination::converged : Termination::iteration_limit,
      converged ? "converged" : "no convergence in " + std::to_string(evaluation_limit) + " evaluations",
      cost.evaluations, initial, final_cost};
  estimate.polyline = cost.polyline;
  for (std::size_t i = 0; i < estimate.polyline.vertices.size(); ++i) estimate.polyline.vertices[i] = Vec3(&x[3 * i]);
  return estimate;
}

}  // namespace toposcope::line_group
