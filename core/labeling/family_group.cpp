// SPDX-License-Identifier: BSD-3-Clause
#include "family_group.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include "instance_entries.h"
#include "toposcope/labeling/tools.h"

namespace toposcope {
namespace {

constexpr std::size_t most_cases = 50'000;

std::ptrdiff_t times_named(const LabelingConstraint& constraint, Index variable) {
  return std::count(constraint.scope.begin(), constraint.scope.end(), variable);
}

bool is_family(const FamilyProblem& problem, Index variable) {
  return std::any_of(problem.families.begin(), problem.families.end(),
                     [&](const Family& family) { return family.variable == variable; });
}

bool any_excluded(const LabelingProblem& problem, Index v, Index w) {
  for (Index a = 0; a < problem.variables[v].domain(); ++a)
    for (Index b = 0; b < problem.variables[w].domain(); ++b)
      if (exclude(problem, v, a, w, b)) return true;
  return false;
}

void append(std::string& signature, double number) {
  signature.append(reinterpret_cast<const char*>(&number), sizeof number);
}

}  // namespace

FamilyGroup::FamilyGroup(const FamilyProblem& problem, std::vector<Index> families)
    : problem_(problem), families_(std::move(families)) {
  for (std::size_t f = 0; f < families_.size(); ++f)
    for (Index value = 1; value < problem.problem.variables[problem.families[families_[f]].variable].domain(); ++value)
      members_.push_back({f, value});
  find_constraints();
  find_shared();
  find_cases();
  std::erase_if(members_, [&](const Member& member) { return optimism(member) == forbidden; });
  make_circuit();
}

void FamilyGroup::find_constraints() {
  each_.resize(families_.size());
  pairs_.resize(families_.size());
  for (std::size_t f = 0; f < families_.size(); ++f)
    for (Index c = 0; c < problem_.problem.constraints.size(); ++c) {
      const auto times = times_named(problem_.problem.constraints[c], problem_.families[families_[f]].variable);
      if (times > 2) throw std::invalid_argument("a constraint names a family more than twice");
      if (times == 1) each_[f].push_back(c);
      if (times == 2) pairs_[f].push_back(c);
    }
}

void FamilyGroup::find_shared() {
  const LabelingProblem& problem = problem_.problem;
  for (Index s = 0; s < problem.variables.size(); ++s) {
    if (is_family(problem_, s)) continue;
    bool shares = false;
    for (std::size_t f = 0; f < families_.size() && !shares; ++f) {
      const Index v = problem_.families[families_[f]].variable;
      for (const auto* constraints : {&each_[f], &pairs_[f]})
        for (const Index c : *constraints) shares = shares || times_named(problem.constraints[c], s) > 0;
      shares = shares || any_excluded(problem, s, v);
    }
    if (shares) shared_.push_back(s);
  }
}

/// Values that mean the same to all instances are one part.
void FamilyGroup::find_cases() {
  const LabelingProblem& problem = problem_.problem;
  std::size_t cases = 1;
  for (const Index s : shared_) {
    std::vector<std::string> signatures(problem.variables[s].domain());
    for (Index value = 0; value < signatures.size(); ++value)
      for (const Member& member : members_)
        signatures[value].push_back(exclude(problem, s, value, variable(member), member.value) ? '1' : '0');
    for (std::size_t f = 0; f < families_.size(); ++f)
      for (const auto* constraints : {&each_[f], &pairs_[f]})
        for (const Index c : *constraints) {
          const LabelingConstraint& constraint = problem.constraints[c];
          const auto place = std::find(constraint.scope.begin(), constraint.scope.end(), s) - constraint.scope.begin();
          if (place == std::ssize(constraint.scope)) continue;
          std::vector<Index> digits(constraint.scope.size(), 0);
          std::size_t entry = 0;
          do append(signatures[digits[static_cast<std::size_t>(place)]], constraint.costs[entry++]);
          while (next_entry(problem, constraint, digits));
        }
    std::map<std::string, Index> parts;
    std::vector<Index>& part_of = part_of_.emplace_back();
    std::vector<Index>& first_of = first_of_.emplace_back();
    for (Index value = 0; value < signatures.size(); ++value) {
      const auto [part, is_new] = parts.emplace(std::move(signatures[value]), static_cast<Index>(parts.size()));
      if (is_new) first_of.push_back(value);
      part_of.push_back(part->second);
    }
    cases *= first_of.size();
    if (cases > most_cases)
      throw std::runtime_error("the instances of '" + problem.variables[problem_.families[families_[0]].variable].name +
                               "' depend on so many features together that over " + std::to_string(most_cases) +
                               " cases would have to be told apart; lower probability.max_candidates, or relate them "
                               "to fewer features");
  }
  cases_ = static_cast<Index>(cases);
  for (Index c = 0; c < problem.constraints.size(); ++c)
    if (std::all_of(problem.constraints[c].scope.begin(), problem.constraints[c].scope.end(),
                    [&](Index v) { return std::binary_search(shared_.begin(), shared_.end(), v); }))
      among_shared_.push_back(c);
}

Index FamilyGroup::case_of(const std::vector<Index>& values) const {
  Index number = 0;
  for (std::size_t s = 0; s < shared_.size(); ++s)
    number = number * static_cast<Index>(first_of_[s].size()) + part_of_[s][values[shared_[s]]];
  return number;
}

Index FamilyGroup::part_of_case(std::size_t s, Index number) const {
  for (std::size_t after = shared_.size(); after-- > s + 1;) number /= static_cast<Index>(first_of_[after].size());
  return number % static_cast<Index>(first_of_[s].size());
}

double FamilyGroup::pair_cost(const LabelingConstraint& constraint, const Member& first, const Member& second,
                              std::vector<Index>& values) const {
  std::size_t entry = 0;
  bool named = false;
  for (const Index v : constraint.scope) {
    Index value = values[v];
    if (v == variable(first)) {
      value = named ? std::max(first.value, second.value) : std::min(first.value, second.value);
      named = true;
    }
    entry = entry * problem_.problem.variables[v].domain() + value;
  }
  return constraint.costs[entry];
}

std::vector<Index> FamilyGroup::values_of(Index case_number) const {
  std::vector<Index> values(problem_.problem.variables.size(), 0);
  for (std::size_t s = 0; s < shared_.size(); ++s) values[shared_[s]] = first_of_[s][part_of_case(s, case_number)];
  return values;
}

bool FamilyGroup::possible(Index case_number) const {
  for (std::size_t s = 0; s < shared_.size(); ++s)  // a part of several values is not looked into
    if (first_of_[s].size() < part_of_[s].size()) return true;
  const std::vector<Index> values = values_of(case_number);
  return meets_exclusions(problem_.problem, values) &&
         std::all_of(among_shared_.begin(), among_shared_.end(), [&](Index c) {
           const LabelingConstraint& constraint = problem_.problem.constraints[c];
           return constraint.costs[table_entry(problem_.problem, constraint, values)] < forbidden;
         });
}

InstanceWeights FamilyGroup::weights(Index case_number) const {
  const LabelingProblem& problem = problem_.problem;
  std::vector<Index> values = values_of(case_number);
  InstanceWeights weights;
  for (const Member& member : members_) {
    double cost = problem.variables[variable(member)].costs[member.value];
    values[variable(member)] = member.value;
    for (const Index c : each_[member.family])
      cost += problem.constraints[c].costs[table_entry(problem, problem.constraints[c], values)];
    values[variable(member)] = 0;
    for (const Index s : shared_)
      if (exclude(problem, s, values[s], variable(member), member.value)) cost = forbidden;
    weights.single.push_back(-cost);
  }
  const InstanceGraph& graph = circuit_->graph();
  if (std::all_of(pairs_.begin(), pairs_.end(), [](const auto& constraints) { return constraints.empty(); }))
    return weights;
  weights.pair.assign(graph.paired.size(), 0);
  for (Index a = 0; a < graph.size(); ++a)
    for (Index b = a + 1; b < graph.size(); ++b) {
      if (!graph.pairs(a, b)) continue;
      double cost = 0;
      for (const Index c : pairs_[members_[a].family])
        cost += pair_cost(problem.constraints[c], members_[a], members_[b], values);
      weights.pair[a * graph.size() + b] = weights.pair[b * graph.size() + a] = -cost;
    }
  return weights;
}

std::vector<FamilyGroup> groups_of(const FamilyProblem& problem) {
  std::vector<FamilyGroup> groups;
  std::vector<bool> grouped(problem.families.size(), false);
  for (Index first = 0; first < grouped.size(); ++first) {
    if (grouped[first]) continue;
    std::vector<Index> together = {first};
    grouped[first] = true;
    for (std::size_t i = 0; i < together.size(); ++i)
      for (Index other = 0; other < grouped.size(); ++other)
        if (!grouped[other] &&
            any_excluded(problem.problem, problem.families[together[i]].variable, problem.families[other].variable)) {
          grouped[other] = true;
          together.push_back(other);
        }
    groups.emplace_back(problem, std::move(together));
  }
  return groups;
}

}  // namespace toposcope
