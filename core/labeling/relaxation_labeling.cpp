// SPDX-License-Identifier: BSD-3-Clause
#include "toposcope/labeling/relaxation_labeling.h"

#include <algorithm>
#include <cmath>

namespace toposcope {
namespace {

// Threshold t such that the sum of max(0, y - t) is 1: from below, dropping what is under it (Michelot 1986). Numbers
// are taken below the greatest, so that t < 0; the count must fall, so that rounding among equal ones cannot go round
// in circles.
double simplex_threshold(std::span<const double> y) {
  const double greatest = *std::max_element(y.begin(), y.end());
  double threshold = -forbidden;
  for (std::size_t kept = y.size() + 1;;) {
    double sum = 0;
    std::size_t count = 0;
    for (const double x : y)
      if (x - greatest > threshold) {
        sum += x - greatest;
        ++count;
      }
    if (count >= kept) return greatest + threshold;
    kept = count;
    threshold = (sum - 1) / static_cast<double>(count);
  }
}

class Relaxation {
 public:
  Relaxation(Compatibilities& compatibilities, const RelaxationRules& rules, Deadline& deadline, Relaxed& relaxed)
      : compatibilities_(compatibilities),
        rules_(rules),
        deadline_(deadline),
        relaxed_(relaxed),
        support_(relaxed.weights.size()),
        trial_(relaxed.weights.size()),
        trial_support_(relaxed.weights.size()) {}

  void run() {
    const auto start = compatibilities_.support(relaxed_.weights, support_, deadline_);
    relaxed_.criterion = "stopped before the first iteration";
    if (!start) return;
    relaxed_.consistency_start = relaxed_.consistency = *start;
    step_ = 1 / static_cast<double>(std::max<std::size_t>(compatibilities_.degree(), 1));
    relaxed_.criterion = "the limit of iterations";
    while (!relaxed_.converged && relaxed_.iterations < rules_.iterations)
      if (!(rules_.projected_gradient ? climb() : update())) return;
  }

 private:
  // p + step q, projected.
  void try_step(double step) {
    for (std::size_t l = 0; l < trial_.size(); ++l) trial_[l] = relaxed_.weights[l] + step * support_[l];
    project_on_simplexes(compatibilities_, trial_);
  }

  double largest_change() const {
    double largest = 0;
    for (std::size_t l = 0; l < trial_.size(); ++l)
      largest = std::max(largest, std::abs(trial_[l] - relaxed_.weights[l]));
    return largest;
  }

  bool end(const char* criterion, bool converged) {
    relaxed_.criterion = criterion;
    relaxed_.converged = converged;
    return converged;
  }

  // False when stopped.
  bool take_trial(double consistency) {
    std::swap(relaxed_.weights, trial_);
    std::swap(support_, trial_support_);
    relaxed_.consistency = consistency;
    ++relaxed_.iterations;
    return true;
  }

  bool climb() {
    try_step(1);
    if (largest_change() <= rules_.tolerance) return end("stationary: P(p + q) = p within the tolerance", true);
    for (; step_ > 1e-15; step_ /= 2) {
      try_step(step_);
      double squares = 0;
      for (std::size_t l = 0; l < trial_.size(); ++l) {
        const double change = trial_[l] - relaxed_.weights[l];
        squares += change * change;
      }
      const auto consistency = compatibilities_.support(trial_, trial_support_, deadline_);
      if (!consistency) return end("out of time", false);
      // Armijo's rule along the projected path (Bertsekas 1976).
      if (*consistency < relaxed_.consistency + 1e-4 / step_ * squares) continue;
      step_ = std::min(2 * step_, 1e4);
      return take_trial(*consistency);
    }
    return end("no step raises A beyond rounding", true);
  }

  bool update() {
    const double degree = static_cast<double>(std::max<std::size_t>(compatibilities_.degree(), 1));
    for (Index v = 0; v < compatibilities_.variables(); ++v) {
      const std::size_t first = compatibilities_.offset(v), last = compatibilities_.offset(v + 1);
      double sum = 0;
      for (std::size_t l = first; l < last; ++l) {
        trial_[l] = relaxed_.weights[l] * std::max(0.0, 1 + support_[l] / degree);
        sum += trial_[l];
      }
      // All of no support at all: as it was.
      for (std::size_t l = first; l < last; ++l) trial_[l] = sum > 0 ? trial_[l] / sum : relaxed_.weights[l];
    }
    const double change = largest_change();
    const auto consistency = compatibilities_.support(trial_, trial_support_, deadline_);
    if (!consistency) return end("out of time", false);
    take_trial(*consistency);
    if (change <= rules_.tolerance) end("no weight changes by more than the tolerance", true);
    return true;
  }

  Compatibilities& compatibilities_;
  const RelaxationRules& rules_;
  Deadline& deadline_;
  Relaxed& relaxed_;
  std::vector<double> support_, trial_, trial_support_;
  double step_ = 1;
};

}  // namespace

void project_on_simplexes(const Compatibilities& compatibilities, std::span<double> weights) {
  for (Index v = 0; v < compatibilities.variables(); ++v) {
    const std::size_t first = compatibilities.offset(v);
    const std::span<double> own = weights.subspan(first, compatibilities.offset(v + 1) - first);
    const double threshold = simplex_threshold(own);
    double sum = 0;
    for (double& weight : own) sum += weight = std::max(0.0, weight - threshold);
    for (double& weight : own) weight /= sum;  // what rounding made of 1
  }
}

double mean_entropy(const Compatibilities& compatibilities, std::span<const double> weights) {
  double sum = 0;
  for (const double weight : weights) sum -= weight > 0 ? weight * std::log(weight) : 0;
  return sum / std::max<double>(compatibilities.variables(), 1);
}

Relaxed relax(Compatibilities& compatibilities, std::vector<double> weights, const RelaxationRules& rules,
              Deadline& deadline) {
  Relaxed relaxed;
  relaxed.weights = std::move(weights);
  Relaxation(compatibilities, rules, deadline, relaxed).run();
  return relaxed;
}

}  // namespace toposcope
