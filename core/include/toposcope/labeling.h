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

inline constexpr Index no_candidate = std::numeric_limits<Index>::max();

/// A model feature and the values that it may take. Of an optional variable value 0 is *missing*.
struct LabelingVariable {
  std::string name;                    ///< of the feature
  double detectability = 1;            ///< 0 to 1: that the feature is found where it is there; in `costs` already
  std::vector<Index> candidates = {};  ///< per value other than missing: a row of the problem's conflict table; empty:
                                       ///< the variable's values exclude nothing
  std::vector<double> costs = {};      ///< per value: minus log likelihood ratio, nats; infinite: forbidden
  bool optional = true;                ///< value 0 is *missing*; false: every value is a candidate
  std::vector<std::string> value_names = {};  ///< per value; empty: values are known by number

  /// How many values there are, *missing* too.
  Index domain() const { return static_cast<Index>(costs.size()); }
  /// Whether the value is *missing*.
  bool missing(Index value) const { return optional && value == 0; }
  /// Row of the conflict table; `no_candidate` for missing and where there are no candidates.
  Index candidate(Index value) const {
    return candidates.empty() || missing(value) ? no_candidate : candidates[value - (optional ? 1 : 0)];
  }
};

/// A relationship over one or more variables, as dense tables over their domains (row-major, last variable
/// fastest). Where any variable of the scope is missing the relationship says nothing: cost 0, satisfied.
struct LabelingConstraint {
  std::string name;                    ///< of the relationship
  std::vector<Index> scope;            ///< variables, each once
  std::vector<double> costs = {};      ///< minus log likelihood ratio of "holds" against unrelated, nats; infinite:
                                       ///< forbidden
  std::vector<float> violations = {};  ///< the crisp form, residual / tolerance, a number: satisfied where <= 1,
                                       ///< infinite where it cannot apply; empty: satisfied where the cost is finite
};

/// Variables, domains, constraints and exclusions; knows nothing of meshes (dissertation 3.4.2, "consistent
/// labeling problem"). `toposcope/labeling/tools.h` has what labelers ask of it.
struct LabelingProblem {
  std::string name;                             ///< of the model
  std::vector<LabelingVariable> variables;      ///< the features
  std::vector<LabelingConstraint> constraints;  ///< the relationships
  double constant = 0;                          ///< part of every labelling's cost, nats

  Index candidate_count = 0;                 ///< rows of the conflict table
  std::vector<std::uint64_t> conflict_bits;  ///< candidate_count rows of conflict_words() words; symmetric; a
                                             ///< candidate conflicts with itself
  /// Words in a row of `conflict_bits`.
  std::size_t conflict_words() const { return (candidate_count + 63) / 64; }
  /// True where two candidates may not both be used: they share a vertex.
  bool conflict(Index a, Index b) const { return (conflict_bits[a * conflict_words() + b / 64] >> (b % 64)) & 1U; }
};

/// What a labeler is asked for.
struct LabelingRequest {
  std::size_t k_best = 10;                                  ///< labellings at most; 0 asks for one
  double time_limit_s = 10;                                 ///< seconds from the call on
  double within = std::numeric_limits<double>::infinity();  ///< labellings costlier than the best by more are left out,
                                                            ///< nats
};

/// An assignment of one value to every variable.
struct Labeling {
  std::vector<Index> values;  ///< one per variable
  double cost = 0;            ///< nats, as `cost_of` sums it
};

/// A value that no consistent labelling can have, removed by propagation, and why.
struct RemovedValue {
  Index variable = 0;  ///< of the problem, from 0
  Index value = 0;     ///< of the variable, from 0
  std::string reason;  ///< a sentence that names what removed it
};

/// Something that a labeler has to tell beyond its labellings: its convergence, entropy, count of solutions.
struct LabelingFact {
  std::string name;   ///< as it is printed
  std::string value;  ///< likewise
};

/// What is promised of a sum over labellings.
enum class Exactness : std::uint32_t {
  none,        ///< there is no such number
  exact,       ///< but for rounding, by at most about 1e-9
  bound,       ///< proven to be off by no more than the outcome says
  approximate  ///< nothing is proven
};

/// What a labeler found, and what it promises of it.
struct LabelingOutcome {
  std::vector<Labeling> labelings;  ///< best first by the labeler's own rank, at most k_best; consistent with the
                                    ///< exclusions. Empty only where a variable that may not be missing stands in the
                                    ///< way: none exists (`optimal`), or none was found
  double lower_bound = -std::numeric_limits<double>::infinity();  ///< nats; no labelling costs less; infinite: none
                                                                  ///< exists
  bool optimal = false;  ///< the first labelling is proven best under the labeler's own rules
  double log_evidence = std::numeric_limits<double>::quiet_NaN();  ///< log of the sum over labellings of exp(-cost),
                                                                   ///< nats; not a number where the labeler makes none
  Exactness evidence_exactness = Exactness::none;                  ///< of `log_evidence`
  double evidence_error = 0;                        ///< where that is a `bound`: the true one is off by no more, nats
  std::vector<std::vector<double>> posteriors;      ///< per variable, per value: probabilities; empty where the labeler
                                                    ///< makes none
  Exactness posterior_exactness = Exactness::none;  ///< of all `posteriors` together
  double posterior_error = 0;                       ///< where they are a `bound`: no probability is off by more
  std::uint64_t nodes = 0;                          ///< of a search tree, or sweeps, or moves
  std::string guarantee;                            ///< one line: what the labeler promises of this outcome
  std::vector<RemovedValue> removed = {};           ///< in the order in which the values were removed
  std::vector<LabelingFact> facts = {};             ///< what else there is to tell
};

/// Solves labelling problems. Thread-safe: `solve` may be called from many threads at once.
class Labeler {
 public:
  virtual ~Labeler() = default;
  /// Cancelled or out of time it returns at once with its best answer, and says so in the guarantee.
  /// \pre tables fit their domains, every domain has a value, costs are finite or plus infinity: what
  ///      `check(problem)` of toposcope/labeling/tools.h looks at
  /// \throw std::invalid_argument  the precondition does not hold, where the labeler looks
  /// \throw std::exception  it cannot solve the problem at all: it would need more than `context.memory_budget()`, a
  ///        program that it runs is missing. That no labelling is allowed is an answer
  virtual LabelingOutcome solve(const LabelingProblem& problem, const LabelingRequest& request,
                                Context& context) const = 0;
};

}  // namespace toposcope
