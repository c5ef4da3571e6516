// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Relaxation labelling: weighted labels that constraints pull towards each other [Rosenfeld1976], [Hummel1983]. A
// weight is a degree of assignment, no posterior probability.

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "toposcope/labeling/local_search.h"

namespace toposcope {

/// How compatible labels are, from -1 (they forbid each other) to 1: r = clamp(-cost / saturation, -1, 1), -1 where the
/// cost is infinite or the candidates exclude each other. Labels are the allowed values (CostTables::allowed), those of
/// all variables in one row.
class Compatibilities {
 public:
  /// \param saturation  cost at which a compatibility saturates, nats; 0: the largest finite one of any constraint, or
  ///                    of a value above its variable's least
  /// \param lasting     what a value costs by itself supports it too: u = -min(cost - least, saturation) / saturation
  /// When the deadline is reached it stops early and is not `complete`.
  Compatibilities(const CostTables& tables, double saturation, bool lasting, Deadline& deadline);
  ~Compatibilities();
  Compatibilities(const Compatibilities&) = delete;
  Compatibilities& operator=(const Compatibilities&) = delete;

  /// False where the deadline came first.
  bool complete() const;
  /// As given or found, nats.
  double saturation() const;
  /// How many.
  Index variables() const;
  /// How many, of all variables.
  std::size_t labels() const;
  /// Of the variable's first label among all; `offset(variables())` is `labels()`.
  std::size_t offset(Index v) const;
  /// The most constraints, excluding variables and lasting costs that one variable has: no support is beyond +-degree.
  std::size_t degree() const;

  /// Support of each label, q_i(l) = u_i(l) + sum over i's constraints of the compatibility expected where i has l and
  /// every other variable is distributed as its weights say.
  /// \return average local consistency A(p) = sum of p_i(l) u_i(l) + sum over constraints of the expected
  ///         compatibility: each constraint once, so that q is the gradient of A whatever the number of variables in a
  ///         constraint (for pairs alone: half the sum of p_i(l) q_i(l)); nothing when stopped
  std::optional<double> support(std::span<const double> weights, std::span<double> support, Deadline& deadline);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Euclidean projection of each variable's numbers onto its simplex: weights of at least 0 that sum to 1.
void project_on_simplexes(const Compatibilities& compatibilities, std::span<double> weights);

/// Mean over the variables of -sum p log p, nats.
double mean_entropy(const Compatibilities& compatibilities, std::span<const double> weights);

/// How weights are changed, and when that ends.
struct RelaxationRules {
  bool projected_gradient = true;  ///< else Rosenfeld, Hummel and Zucker
  int iterations = 1000;           ///< at most
  double tolerance = 1e-6;         ///< of weights
};

/// What became of the weights.
struct Relaxed {
  std::vector<double> weights;   ///< per label
  int iterations = 0;            ///< made
  bool converged = false;        ///< else stopped, or the limit of iterations
  std::string criterion;         ///< why it ended
  double consistency_start = 0;  ///< A(p) at first
  double consistency = 0;        ///< A(p) at the end
};

/// Rosenfeld, Hummel and Zucker: p(l) <- p(l) (1 + q(l) / degree), normed; ends where no weight changes by more than
/// the tolerance. Projected gradient: p <- P(p + step q), P the projection on the simplexes, the step halved until A
/// rises by Armijo's rule and doubled after; ends where P(p + q) differs from p by at most the tolerance, where p is
/// consistent in the sense of Hummel and Zucker: sum of (v - p) q <= 0 for all weights v. Neither lets A(p) fall.
Relaxed relax(Compatibilities& compatibilities, std::vector<double> weights, const RelaxationRules& rules,
              Deadline& deadline);

}  // namespace toposcope
