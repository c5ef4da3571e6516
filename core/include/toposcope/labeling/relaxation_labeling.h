// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Relaxation labelling: weighted labels that constraints pull towards each other [Rosenfeld1976], [Hummel1983]. A
// weight is a degree of assignment, no posterior probability.

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "toposcope/labeling/conditional_costs.h"

namespace toposcope {

/// How compatible labels are, from -1 (they forbid each other) to 1: r = clamp(-cost / saturation, -1, 1), -1 where the
/// cost is infinite or the candidates exclude each other. Labels are the allowed values (CostTables::allowed), those of
/// all variables in one row.
class Compatibilities {
 public:
  /// \param saturation  cost at which a compatibility saturates; 0: the largest finite one of any constraint, or of a
  /// value
  ///                    above its variable's least
  /// \param lasting     what a value costs by itself supports it too: u = -min(cost - least, saturation) / saturation
  /// When the deadline is reached it stops early and is not `complete`.
  Compatibilities(const CostTables& tables, double saturation, bool lasting, Deadline& deadline);

  bool complete() const { return complete_; }
  double saturation() const { return saturation_; }
  Index variables() const { return static_cast<Index>(offsets_.size() - 1); }
  std::size_t labels() const { return offsets_.back(); }
  std::size_t offset(Index v) const { return offsets_[v]; }
  /// The most constraints, excluding variables and lasting costs that one variable has: no support is beyond +-degree.
  std::size_t degree() const { return degree_; }

  /// Support of each label, q_i(l) = u_i(l) + sum over i's constraints of the compatibility expected where i has l and
  /// every other variable is distributed as its weights say.
  /// \return average local consistency A(p) = sum of p_i(l) u_i(l) + sum over constraints of the expected
  ///         compatibility: each constraint once, so that q is the gradient of A whatever the number of variables in a
  ///         constraint (for pairs alone: half the sum of p_i(l) q_i(l)); nothing when stopped
  std::optional<double> support(std::span<const double> weights, std::span<double> support, Deadline& deadline);

 private:
  struct Place {
    std::size_t first, count;  ///< labels of a variable
  };
  struct Table {
    std::size_t first_place, places, entry;
  };

  bool read(const CostTables& tables, Deadline& deadline);
  bool read_exclusions(const CostTables& tables, Deadline& deadline);
  double pair(const Table& table, std::span<const double> weights, std::span<double> support) const;
  double wide(const Table& table, std::span<const double> weights, std::span<double> support);
  double exclusions(std::span<const double> weights, std::span<double> support);

  bool complete_ = false;
  double saturation_;
  std::size_t degree_ = 0;
  std::vector<std::size_t> offsets_;
  std::vector<float> own_;      ///< by label: u and constraints over the variable alone
  std::vector<float> entries_;  ///< compatibilities, table after table, last place fastest
  std::vector<Place> places_;
  std::vector<Table> tables_;
  // Exclusions, by candidate: what is used, and what excludes it; own ones by label do not count.
  std::vector<Index> candidates_;
  std::vector<std::size_t> conflict_offsets_, own_conflict_offsets_;
  std::vector<Index> conflicts_;
  std::vector<std::uint32_t> own_conflicts_;
  std::vector<double> used_, excluding_;
  // Of `wide`.
  std::vector<std::size_t> digits_;
  std::vector<double> products_;
};

/// Euclidean projection of each variable's numbers onto its simplex: weights of at least 0 that sum to 1.
void project_on_simplexes(const Compatibilities& compatibilities, std::span<double> weights);

/// Mean over the variables of -sum p log p, nats.
double mean_entropy(const Compatibilities& compatibilities, std::span<const double> weights);

struct RelaxationRules {
  bool projected_gradient = true;  ///< else Rosenfeld, Hummel and Zucker
  int iterations = 1000;
  double tolerance = 1e-6;
};

struct Relaxed {
  std::vector<double> weights;
  int iterations = 0;
  bool converged = false;
  std::string criterion;                          ///< why it ended
  double consistency_start = 0, consistency = 0;  ///< A(p)
};

/// Rosenfeld, Hummel and Zucker: p(l) <- p(l) (1 + q(l) / degree), normed; ends where no weight changes by more than
/// the tolerance. Projected gradient: p <- P(p + step q), P the projection on the simplexes, the step halved until A
/// rises by Armijo's rule and doubled after; ends where P(p + q) differs from p by at most the tolerance, where p is
/// consistent in the sense of Hummel and Zucker: sum of (v - p) q <= 0 for all weights v. Neither lets A(p) fall.
Relaxed relax(Compatibilities& compatibilities, std::vector<double> weights, const RelaxationRules& rules,
              Deadline& deadline);

}  // namespace toposcope
