// SPDX-License-Identifier: BSD-3-Clause
#include "toposcope/labeling/families.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <stdexcept>

#include "family_group.h"
#include "instance_entries.h"
#include "toposcope/labeling/tools.h"

namespace toposcope {
namespace {

constexpr double negligible = 1e-17;  // probability of a case

/// The problem that families leave to a labeler: single features, and for each group what its instances cost them.
class Remainder {
 public:
  explicit Remainder(const FamilyProblem& problem) : problem_(problem), groups_(groups_of(problem)) {
    std::vector<bool> single(problem.problem.variables.size(), true);
    for (const Family& family : problem.families) single[family.variable] = false;
    for (Index v = 0; v < single.size(); ++v)
      if (single[v]) singles_.push_back(v);
    joint_.resize(groups_.size());
  }

  const std::vector<FamilyGroup>& groups() const { return groups_; }
  const std::vector<Index>& singles() const { return singles_; }

  /// \param costs  per group and case
  LabelingProblem with(const std::vector<std::vector<double>>& costs) {
    LabelingProblem made;
    made.name = problem_.problem.name;
    made.constant = problem_.problem.constant;
    made.candidate_count = problem_.problem.candidate_count;
    made.conflict_bits = problem_.problem.conflict_bits;
    for (const Index v : singles_) made.variables.push_back(problem_.problem.variables[v]);
    for (const LabelingConstraint& constraint : problem_.problem.constraints)
      if (std::all_of(constraint.scope.begin(), constraint.scope.end(),
                      [&](Index v) { return place(v).has_value(); })) {
        LabelingConstraint& copy = made.constraints.emplace_back(constraint);
        for (Index& v : copy.scope) v = *place(v);
      }
    if (std::any_of(groups_.begin(), groups_.end(), [](const FamilyGroup& g) { return g.shared().size() > 1; }))
      make_missing_a_value(made);
    for (std::size_t g = 0; g < groups_.size(); ++g) add(groups_[g], costs[g], made, joint_[g]);
    return made;
  }

  /// Values of all variables, of those of the remainder.
  std::vector<Index> values_of(const std::vector<Index>& values) const {
    std::vector<Index> all(problem_.problem.variables.size(), 0);
    for (std::size_t i = 0; i < singles_.size(); ++i) all[singles_[i]] = values[i];
    return all;
  }

  /// Probabilities of a group's cases, by the posteriors of the remainder.
  std::vector<double> cases(std::size_t g, const std::vector<std::vector<double>>& posteriors) const {
    const FamilyGroup& group = groups_[g];
    if (group.shared().empty()) return {1};
    if (joint_[g]) return posteriors[*joint_[g]];
    std::vector<double> probabilities(group.cases(), 0);
    const std::vector<double>& of = posteriors[*place(group.shared()[0])];
    for (Index value = 0; value < of.size(); ++value) probabilities[group.part_of(0, value)] += of[value];
    return probabilities;
  }

 private:
  std::optional<Index> place(Index variable) const {
    const auto at = std::lower_bound(singles_.begin(), singles_.end(), variable);
    if (at == singles_.end() || *at != variable) return std::nullopt;
    return static_cast<Index>(at - singles_.begin());
  }

  /// *Missing* is a value like others, since the instances depend on it: a candidate that excludes nothing.
  static void make_missing_a_value(LabelingProblem& made) {
    const Index before = made.candidate_count;
    const std::size_t words = made.conflict_words();
    made.candidate_count += static_cast<Index>(made.variables.size());
    std::vector<std::uint64_t> bits(made.candidate_count * made.conflict_words(), 0);
    for (Index a = 0; a < before; ++a)
      std::copy_n(made.conflict_bits.begin() + static_cast<std::ptrdiff_t>(a * words), words,
                  bits.begin() + static_cast<std::ptrdiff_t>(a * made.conflict_words()));
    for (Index v = 0; v < made.variables.size(); ++v) {
      const Index own = before + v;
      bits[own * made.conflict_words() + own / 64] |= std::uint64_t{1} << (own % 64);
      LabelingVariable& variable = made.variables[v];
      if (!variable.optional) continue;
      variable.optional = false;
      if (!variable.candidates.empty()) variable.candidates.insert(variable.candidates.begin(), own);
    }
    made.conflict_bits = std::move(bits);
  }

  void add(const FamilyGroup& group, const std::vector<double>& costs, LabelingProblem& made,
           std::optional<Index>& joint) const {
    joint.reset();
    if (group.shared().empty()) {
      made.constant += costs[0];
    } else if (group.shared().size() == 1) {
      std::vector<double>& unary = made.variables[*place(group.shared()[0])].costs;
      for (Index value = 0; value < unary.size(); ++value) unary[value] += costs[group.part_of(0, value)];
    } else {
      joint = static_cast<Index>(made.variables.size());
      LabelingVariable& variable = made.variables.emplace_back();
      variable.name =
          "instances of " + problem_.problem.variables[problem_.families[group.families()[0]].variable].name;
      variable.optional = false;
      variable.costs = costs;
      for (std::size_t s = 0; s < group.shared().size(); ++s) {
        const Index other = *place(group.shared()[s]), domain = made.variables[other].domain();
        LabelingConstraint& same = made.constraints.emplace_back();
        same.name = variable.name + " and " + made.variables[other].name;
        same.scope = {*joint, other};
        for (Index number = 0; number < group.cases(); ++number)
          for (Index value = 0; value < domain; ++value)
            same.costs.push_back(group.part_of(s, value) == group.part_of_case(s, number) ? 0 : forbidden);
      }
    }
  }

  const FamilyProblem& problem_;
  std::vector<FamilyGroup> groups_;
  std::vector<Index> singles_;
  std::vector<std::optional<Index>> joint_;  ///< per group: the variable of its cases
};

LabelingOutcome solve_remainder(const LabelingProblem& remainder, const LabelingRequest& request,
                                const SolveProblem& solve) {
  if (!remainder.variables.empty()) return solve(remainder, request);
  LabelingOutcome outcome;
  outcome.labelings.push_back({{}, remainder.constant});
  outcome.lower_bound = remainder.constant;
  outcome.optimal = true;
  outcome.log_evidence = -remainder.constant;
  outcome.evidence_exactness = outcome.posterior_exactness = Exactness::exact;
  outcome.guarantee = "exact, in closed form: there are instances alone";
  return outcome;
}

/// Sets of instances of several groups together.
struct JointSet {
  double cost = 0;
  std::vector<std::vector<Index>> instances;  ///< per family of the problem
};

/// The best of all combinations.
std::vector<JointSet> combine(const std::vector<JointSet>& all, const FamilyGroup& group,
                              const std::vector<InstanceSet>& sets, std::size_t count) {
  std::vector<JointSet> combined;
  for (const JointSet& joint : all)
    for (const InstanceSet& set : sets) {
      JointSet& made = combined.emplace_back(joint);
      made.cost += set.cost;
      for (const Index candidate : set.candidates) {
        const FamilyGroup::Member& member = group.member(candidate);
        made.instances[group.families()[member.family]].push_back(member.value);
      }
    }
  std::stable_sort(combined.begin(), combined.end(),
                   [](const JointSet& a, const JointSet& b) { return a.cost < b.cost; });
  if (combined.size() > count) combined.resize(count);
  return combined;
}

std::string approximation_of(const FamilyProblem& problem, const std::vector<FamilyGroup>& groups) {
  std::string text;
  for (const FamilyGroup& group : groups)
    if (group.left_out() > 0)
      text += (text.empty() ? "" : "; ") + std::to_string(group.left_out()) + " of the candidates of '" +
              problem.problem.variables[problem.families[group.families()[0]].variable].name +
              "', the least likely ones, are left out: too many depend on each other in pairs";
  return text;
}

void say_approximate(LabelingOutcome& outcome) {
  outcome.optimal = false;
  outcome.lower_bound = -std::numeric_limits<double>::infinity();
  if (outcome.evidence_exactness != Exactness::none) outcome.evidence_exactness = Exactness::approximate;
  if (outcome.posterior_exactness != Exactness::none) outcome.posterior_exactness = Exactness::approximate;
}

void check_families(const FamilyProblem& problem) {
  for (const Family& family : problem.families)
    if (family.variable >= problem.problem.variables.size() || family.number_costs.empty() ||
        !problem.problem.variables[family.variable].optional)
      throw std::invalid_argument("a family is of a variable that may be missing, and has a cost for no instance");
}

}  // namespace

FamilyOutcome best_with_families(const FamilyProblem& problem, const LabelingRequest& request,
                                 const SolveProblem& solve) {
  check_families(problem);
  Remainder remainder(problem);
  const std::vector<FamilyGroup>& groups = remainder.groups();
  std::vector<std::vector<double>> costs(groups.size());
  for (std::size_t g = 0; g < groups.size(); ++g)
    for (Index number = 0; number < groups[g].cases(); ++number) {
      if (!groups[g].possible(number)) {
        costs[g].push_back(forbidden);
        continue;
      }
      const auto best = best_sets(groups[g].circuit(), groups[g].weights(number), groups[g].number_weight_logs(), 1);
      costs[g].push_back(best.empty() ? forbidden : best[0].cost);
    }
  FamilyOutcome found;
  found.outcome = solve_remainder(remainder.with(costs), request, solve);
  const std::size_t count = std::max<std::size_t>(request.k_best, 1);
  for (const Labeling& labeling : found.outcome.labelings) {
    const std::vector<Index> values = remainder.values_of(labeling.values);
    std::vector<JointSet> sets(1);
    sets[0].instances.resize(problem.families.size());
    for (const FamilyGroup& group : groups)
      sets = combine(
          sets, group,
          best_sets(group.circuit(), group.weights(group.case_of(values)), group.number_weight_logs(), count), count);
    for (JointSet& set : sets) {
      FamilyLabeling& made = found.labelings.emplace_back(FamilyLabeling{values, std::move(set.instances), 0});
      made.cost = cost_of(problem, made);
    }
  }
  std::stable_sort(found.labelings.begin(), found.labelings.end(),
                   [](const FamilyLabeling& a, const FamilyLabeling& b) { return a.cost < b.cost; });
  if (found.labelings.size() > count) found.labelings.resize(count);
  while (!found.labelings.empty() && found.labelings.back().cost > found.labelings.front().cost + request.within)
    found.labelings.pop_back();
  found.outcome.labelings.clear();
  found.approximation = approximation_of(problem, groups);
  if (!found.approximation.empty()) say_approximate(found.outcome);
  return found;
}

FamilyOutcome sum_with_families(const FamilyProblem& problem, const LabelingRequest& request,
                                const SolveProblem& solve) {
  check_families(problem);
  Remainder remainder(problem);
  const std::vector<FamilyGroup>& groups = remainder.groups();
  std::vector<InstanceSums> sums;
  std::vector<std::vector<double>> costs(groups.size());
  for (std::size_t g = 0; g < groups.size(); ++g) {
    sums.emplace_back(groups[g].circuit());
    for (Index number = 0; number < groups[g].cases(); ++number)
      costs[g].push_back(groups[g].possible(number)
                             ? -sums[g].sum(groups[g].weights(number), groups[g].number_weight_logs())
                             : forbidden);
  }
  LabelingRequest one = request;
  one.k_best = 1;
  FamilyOutcome found;
  found.outcome = solve_remainder(remainder.with(costs), one, solve);
  found.outcome.labelings.clear();
  found.approximation = approximation_of(problem, groups);
  if (!found.approximation.empty()) say_approximate(found.outcome);
  const std::vector<std::vector<double>> posteriors = std::move(found.outcome.posteriors);
  found.outcome.posteriors.clear();
  if (posteriors.empty() && !remainder.singles().empty()) return found;

  found.outcome.posteriors.resize(problem.problem.variables.size());
  for (std::size_t i = 0; i < remainder.singles().size(); ++i)
    found.outcome.posteriors[remainder.singles()[i]] = posteriors[i];
  for (const Family& family : problem.families)
    found.outcome.posteriors[family.variable].assign(problem.problem.variables[family.variable].domain(), 0);
  found.numbers.resize(problem.families.size());
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const FamilyGroup& group = groups[g];
    const InstanceCircuit::Node& root = group.circuit().nodes().back();
    for (std::size_t f = 0; f < group.families().size(); ++f)
      found.numbers[group.families()[f]].assign(root.shape[f] + 1, 0);
    const std::vector<double> cases = remainder.cases(g, posteriors);
    for (Index number = 0; number < cases.size(); ++number) {
      if (cases[number] < negligible) continue;
      sums[g].sum(group.weights(number), group.number_weight_logs());
      for (Index entry = 0; entry < root.entries; ++entry) {
        const std::vector<Index> numbers = numbers_of(root.shape, entry);
        for (std::size_t f = 0; f < numbers.size(); ++f)
          found.numbers[group.families()[f]][numbers[f]] += cases[number] * sums[g].numbers()[entry];
      }
      const std::vector<double>& marginals = sums[g].marginals();
      for (Index u = 0; u < marginals.size(); ++u) {
        const FamilyGroup::Member& member = group.member(u);
        found.outcome.posteriors[problem.families[group.families()[member.family]].variable][member.value] +=
            cases[number] * marginals[u];
      }
    }
    for (const Index f : group.families())
      found.outcome.posteriors[problem.families[f].variable][0] = found.numbers[f][0];
  }
  return found;
}

}  // namespace toposcope
