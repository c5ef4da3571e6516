// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Labelling problems in which some features have any number of interchangeable instances. Given the few single features
// that they share, instances are independent but for candidates that exclude each other, and sums and optima over them
// are products of small polynomials in the number of instances. What is left is a problem of single features, for a
// labeler.

#include <functional>
#include <string>
#include <vector>

#include "toposcope/labeling.h"

namespace toposcope {

/// Interchangeable instances of one feature: a labelling takes any set of the variable's values.
struct Family {
  Index variable = 0;                ///< of the problem; of its values 0 stands for none, and its cost is not asked for
  std::vector<double> number_costs;  ///< nats, of 0, 1, 2, ... instances; infinite: not so many. More are not allowed
};

/// A problem and its families. A constraint whose scope names a family once holds for each instance, and one that names
/// it twice for each pair, in ascending order of their values: its table is the same both ways. No constraint names two
/// families.
struct FamilyProblem {
  LabelingProblem problem;
  std::vector<Family> families;
};

/// Values of the single features, and sets of instances.
struct FamilyLabeling {
  std::vector<Index> values;                  ///< per variable of the problem; 0 of families
  std::vector<std::vector<Index>> instances;  ///< per family: values of its variable, ascending
  double cost = 0;                            ///< nats, as `cost_of` sums it
};

/// The cost of a labelling; infinite where instances or features exclude each other.
double cost_of(const FamilyProblem& problem, const FamilyLabeling& labeling);

/// What is known of a problem with families.
struct FamilyOutcome {
  std::vector<FamilyLabeling> labelings;  ///< best first, at most k_best
  /// All but labellings. The posterior of a family's value is that an instance has it, of value 0 that there are none.
  LabelingOutcome outcome;
  std::vector<std::vector<double>> numbers;  ///< per family: the probability of 0, 1, ... instances; empty without sums
  std::string approximation;                 ///< what was left out so that sums stay feasible; empty: nothing
};

/// A labeler at work.
using SolveProblem = std::function<LabelingOutcome(const LabelingProblem&, const LabelingRequest&)>;

/// The labellings of a problem with families, by a labeler for what families leave.
/// \throw std::invalid_argument  the problem is not as said above
/// \throw std::runtime_error  a family depends on more features together than can be told apart
FamilyOutcome best_with_families(const FamilyProblem& problem, const LabelingRequest& request,
                                 const SolveProblem& solve);

/// The sums over its labellings: evidence, posteriors and numbers; no labellings.
FamilyOutcome sum_with_families(const FamilyProblem& problem, const LabelingRequest& request,
                                const SolveProblem& solve);

}  // namespace toposcope
