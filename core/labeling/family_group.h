// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Families that depend on each other through candidates that exclude each other, and the single features they share.

#include <optional>
#include <string>
#include <vector>

#include "instance_sets.h"
#include "toposcope/labeling/families.h"

namespace toposcope {

/// Whether two values may not both be taken; also of one variable.
inline bool exclude(const LabelingProblem& problem, Index variable, Index value, Index other, Index other_value) {
  const Index a = problem.variables[variable].candidate(value), b = problem.variables[other].candidate(other_value);
  return a != no_candidate && b != no_candidate && problem.conflict(a, b);
}

class FamilyGroup {
 public:
  /// \param families  of the problem, which must outlive the group
  /// \throw std::runtime_error  more joint values of shared features than can be told apart
  FamilyGroup(const FamilyProblem& problem, std::vector<Index> families);

  const std::vector<Index>& families() const { return families_; }
  /// The single features on which the instances depend.
  const std::vector<Index>& shared() const { return shared_; }

  /// Joint values of the shared features, as far as they make a difference to the instances: numbered from 0.
  Index cases() const { return cases_; }
  /// \param values  per variable of the problem
  Index case_of(const std::vector<Index>& values) const;
  /// Which case a value of shared feature `s` belongs to, of as many as `parts(s)`.
  Index part_of(std::size_t s, Index value) const { return part_of_[s][value]; }
  /// A case's part of shared feature `s`.
  Index part_of_case(std::size_t s, Index number) const;

  /// False where no labelling has the case: its features exclude each other, or a constraint among them forbids it.
  bool possible(Index case_number) const;

  InstanceWeights weights(Index case_number) const;
  const InstanceCircuit& circuit() const { return *circuit_; }
  /// Log weights of the circuit's entries: of the numbers of instances.
  const std::vector<double>& number_weight_logs() const { return number_weight_logs_; }

  struct Member {
    std::size_t family;  ///< place in `families()`
    Index value;         ///< of its variable
  };
  const Member& member(Index candidate) const { return members_[candidate]; }
  /// How many of the candidates there are the circuit could not take.
  std::size_t left_out() const { return left_out_; }

 private:
  Index variable(const Member& member) const { return problem_.families[families_[member.family]].variable; }
  void find_constraints();
  void find_shared();
  void find_cases();
  std::vector<Index> values_of(Index case_number) const;
  void make_circuit();
  InstanceGraph graph_of(const std::vector<Member>& members) const;
  double optimism(const Member& member) const;
  double pair_cost(const LabelingConstraint& constraint, const Member& first, const Member& second,
                   std::vector<Index>& values) const;

  const FamilyProblem& problem_;
  std::vector<Index> families_, shared_;
  std::vector<std::vector<Index>> each_, pairs_;  ///< per family of the group: constraints that name it once, and twice
  std::vector<std::vector<Index>> part_of_;       ///< per shared feature and value
  std::vector<std::vector<Index>> first_of_;      ///< per shared feature and part: a value
  std::vector<Index> among_shared_;               ///< constraints of shared features alone
  Index cases_ = 1;
  std::vector<Member> members_;
  std::optional<InstanceCircuit> circuit_;
  std::vector<double> number_weight_logs_;
  std::size_t left_out_ = 0;
};

/// The families of a problem, those together whose candidates exclude each other.
std::vector<FamilyGroup> groups_of(const FamilyProblem& problem);

}  // namespace toposcope
