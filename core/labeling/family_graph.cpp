// SPDX-License-Identifier: BSD-3-Clause
// Which candidates of a group of families depend on each other, and the circuit over them.

#include <algorithm>

#include "family_group.h"
#include "instance_entries.h"
#include "toposcope/labeling/tools.h"

namespace toposcope {
namespace {

constexpr std::size_t most_nodes = 100'000;  // of a circuit: some milliseconds for each evaluation

}  // namespace

InstanceGraph FamilyGroup::graph_of(const std::vector<Member>& members) const {
  const LabelingProblem& problem = problem_.problem;
  std::vector<Index> colors;
  for (const Member& member : members) colors.push_back(static_cast<Index>(member.family));
  InstanceGraph graph(std::move(colors));
  for (const Index f : families_) {
    const std::size_t most = problem_.families[f].number_costs.size() - 1;
    graph.most.push_back(static_cast<Index>(std::min<std::size_t>(most, members.size())));
  }
  for (std::size_t a = 0; a < members.size(); ++a)
    for (std::size_t b = 0; b < members.size(); ++b)
      if (a != b && exclude(problem, variable(members[a]), members[a].value, variable(members[b]), members[b].value))
        graph.excluded[a * members.size() + b] = 1;
  // A pair has a weight where any case gives it one, and is excluded where all forbid it.
  for (std::size_t f = 0; f < families_.size(); ++f)
    for (const Index c : pairs_[f]) {
      const LabelingConstraint& constraint = problem.constraints[c];
      std::vector<char> finite(members.size() * members.size(), 0), weighs(finite.size(), 0);
      std::vector<Index> place(problem.variables[problem_.families[families_[f]].variable].domain(), graph.size());
      for (Index a = 0; a < members.size(); ++a)
        if (members[a].family == f) place[members[a].value] = a;
      std::vector<Index> digits(constraint.scope.size(), 0);
      std::size_t entry = 0;
      do {
        std::vector<Index> pair;
        for (std::size_t i = 0; i < digits.size(); ++i)
          if (constraint.scope[i] == problem_.families[families_[f]].variable) pair.push_back(place[digits[i]]);
        const double cost = constraint.costs[entry++];
        if (pair[0] >= pair[1] || pair[1] == graph.size()) continue;
        const std::size_t at = pair[0] * members.size() + pair[1];
        finite[at] = finite[at] || cost < forbidden;
        weighs[at] = weighs[at] || cost != 0;
      } while (next_entry(problem, constraint, digits));
      for (std::size_t a = 0; a < members.size(); ++a)
        for (std::size_t b = a + 1; b < members.size(); ++b) {
          const std::size_t at = a * members.size() + b, mirrored = b * members.size() + a;
          if (members[a].family != f || members[b].family != f) continue;
          if (!finite[at]) graph.excluded[at] = graph.excluded[mirrored] = 1;
          if (weighs[at]) graph.paired[at] = graph.paired[mirrored] = 1;
        }
    }
  for (std::size_t at = 0; at < graph.excluded.size(); ++at)
    if (graph.excluded[at]) graph.paired[at] = 0;
  return graph;
}

/// The least that a candidate may cost.
double FamilyGroup::optimism(const Member& member) const {
  double cost = problem_.problem.variables[variable(member)].costs[member.value];
  for (const Index c : each_[member.family]) {
    const LabelingConstraint& constraint = problem_.problem.constraints[c];
    const auto place = static_cast<std::size_t>(
        std::find(constraint.scope.begin(), constraint.scope.end(), variable(member)) - constraint.scope.begin());
    double least = forbidden;
    std::vector<Index> digits(constraint.scope.size(), 0);
    std::size_t entry = 0;
    do {
      if (digits[place] == member.value) least = std::min(least, constraint.costs[entry]);
      ++entry;
    } while (next_entry(problem_.problem, constraint, digits));
    cost += least;
  }
  return cost;
}

/// Of as many candidates as it can have, the best first.
void FamilyGroup::make_circuit() {
  circuit_ = InstanceCircuit::make(graph_of(members_), most_nodes);
  if (!circuit_) {
    std::vector<std::pair<double, std::size_t>> order;
    for (std::size_t i = 0; i < members_.size(); ++i) order.emplace_back(optimism(members_[i]), i);
    std::sort(order.begin(), order.end());
    const auto best = [&](std::size_t count) {
      std::vector<std::size_t> kept;
      for (std::size_t i = 0; i < count; ++i) kept.push_back(order[i].second);
      std::sort(kept.begin(), kept.end());
      std::vector<Member> members;
      for (const std::size_t i : kept) members.push_back(members_[i]);
      return members;
    };
    std::size_t can = 0, cannot = members_.size();
    while (cannot - can > 1) {
      const std::size_t middle = (can + cannot) / 2;
      (InstanceCircuit::make(graph_of(best(middle)), most_nodes) ? can : cannot) = middle;
    }
    left_out_ = members_.size() - can;
    members_ = best(can);
    circuit_ = InstanceCircuit::make(graph_of(members_), most_nodes);
  }
  const InstanceCircuit::Node& root = circuit_->nodes().back();
  for (Index entry = 0; entry < root.entries; ++entry) {
    const std::vector<Index> numbers = numbers_of(root.shape, entry);
    double cost = 0;
    for (std::size_t f = 0; f < numbers.size(); ++f) cost += problem_.families[families_[f]].number_costs[numbers[f]];
    number_weight_logs_.push_back(-cost);
  }
}

}  // namespace toposcope
