// SPDX-License-Identifier: BSD-3-Clause
#include "toposcope/geometry/chords.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <cmath>
#include <numeric>

namespace toposcope {

std::vector<Vec3> ends_of_chords(const FitInput& input) {
  std::vector<Index> ends;
  const auto add = [&](Index v) {
    if (input.mesh->input_vertices.empty() || input.mesh->input_vertices[v] != no_vertex) ends.push_back(v);
  };
  for (std::size_t i = 0; input.mesh != nullptr && i < input.points.size(); ++i) {
    add(input.vertices[i]);
    if (was_read(input, i)) continue;
    for (const Index q : input.mesh->one_ring(input.vertices[i])) add(q);
  }
  std::sort(ends.begin(), ends.end());
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
  std::vector<Vec3> points;
  for (const Index v : ends) points.push_back(input.mesh->positions[v]);
  return points;
}

double typical_sagitta(std::vector<double> angles, double radius) {
  if (angles.size() < 2) return 0;
  std::sort(angles.begin(), angles.end());
  const double whole = 2 * pi - (angles.back() - angles.front());
  for (std::size_t i = 0; i + 1 < angles.size(); ++i) angles[i] = angles[i + 1] - angles[i];
  angles.back() = whole;
  std::sort(angles.begin(), angles.end());
  angles.pop_back();
  const double half = std::accumulate(angles.begin(), angles.end(), 0.0) / 2;
  double sum = 0, gap = 0;
  for (std::size_t i = 0; i < angles.size() && sum < half; ++i) sum += gap = angles[i];
  const double sine = std::sin(std::min(gap, pi) / 4);
  return 2 * radius * sine * sine;
}

bool as_well_spread(const Eigen::MatrixXd& some, const Eigen::MatrixXd& all) {
  constexpr double least = 0.1;
  const Eigen::LLT<Eigen::MatrixXd> factor(all);
  if (factor.info() != Eigen::Success) return false;
  const Eigen::MatrixXd half = factor.matrixL().solve(some);
  const Eigen::MatrixXd ratio = factor.matrixL().solve(half.transpose());
  if (!ratio.allFinite()) return false;
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(ratio, Eigen::EigenvaluesOnly).eigenvalues()[0] >= least;
}

}  // namespace toposcope
