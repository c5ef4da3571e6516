// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "toposcope/context.h"
#include "toposcope/types.h"

namespace toposcope {

/// A model feature and the values that it may take. Value 0 is *missing*; value k >= 1 is a candidate.
struct LabelingVariable {
  std::string name;
  double detectability = 1;
  std::vector<Index> candidates;  ///< for value k >= 1: candidates[k - 1], an id in the problem's conflict table
  std::vector<double> costs;      ///< size candidates + 1: minus log likelihood ratio; costs[0] is that of missing

  std::size_t domain() const { return costs.size(); }
};

/// A relationship over two or more variables, as dense tables over their domains (row-major, last variable
/// fastest). Where any variable of the scope is missing the relationship says nothing: cost 0, satisfied.
struct LabelingConstraint {
  std::string name;
  std::vector<Index> scope;
  std::vector<float> costs;       ///< minus log likelihood ratio of "holds" against unrelated features
  std::vector<float> violations;  ///< residual / tolerance: satisfied where <= 1, infinite where it cannot apply; 0
                                  ///< where a variable is missing
};

/// Variables, domains, constraints and exclusions; knows nothing of meshes (dissertation 3.4.2, "consistent
/// labeling problem").
struct LabelingProblem {
  std::string name;
  std::vector<LabelingVariable> variables;
  std::vector<LabelingConstraint> constraints;

  Index candidate_count = 0;
  std::vector<std::uint64_t> conflict_bits;  ///< candidate_count rows of conflict_words() words; symmetric; a
                                             ///< candidate conflicts with itself
  std::size_t conflict_words() const { return (candidate_count + 63) / 64; }
  /// True where two candidates may not both be used: they share a vertex.
  bool conflict(Index a, Index b) const { return (conflict_bits[a * conflict_words() + b / 64] >> (b % 64)) & 1U; }
};

struct LabelingRequest {
  std::size_t k_best = 10;
  double time_limit_s = 10;
};

struct Labeling {
  std::vector<Index> values;  ///< one per variable; 0 = missing
  double cost = 0;
};

struct LabelingOutcome {
  std::vector<Labeling> labelings;  ///< best first, at most k_best; never empty: all missing is a labelling
  double lower_bound = -std::numeric_limits<double>::infinity();
  bool optimal = false;                         ///< the first labelling is proven best under the labeler's own rules
  double log_evidence = 0;                      ///< log of the sum over labellings of exp(-cost)
  std::vector<std::vector<double>> posteriors;  ///< per variable, per value; empty where the labeler makes none
  std::uint64_t nodes = 0;
  std::string guarantee;  ///< one line: what the labeler promises of this outcome
};

/// Solves labelling problems. Keeps its best answer when cancelled or out of time.
class Labeler {
 public:
  virtual ~Labeler() = default;
  virtual LabelingOutcome solve(const LabelingProblem& problem, const LabelingRequest& request,
                                Context& context) const = 0;
};

}  // namespace toposcope
