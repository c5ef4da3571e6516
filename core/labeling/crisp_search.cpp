// SPDX-License-Identifier: BSD-3-Clause
#include "toposcope/labeling/crisp_search.h"

#include <algorithm>
#include <numeric>

#include "removed_values.h"
#include "toposcope/labeling/crisp_outcome.h"
#include "tree_search.h"

namespace toposcope {
namespace {

CrispPart part_of(const LabelingProblem& problem, bool all_present) {
  CrispPart part;
  if (all_present) part.present.assign(problem.variables.size(), true);
  return part;
}

}  // namespace

CrispNetwork::CrispNetwork(const LabelingProblem& problem, Deadline& deadline, bool all_present)
    : compiled_(std::make_unique<CompiledNetwork>(problem, deadline, part_of(problem, all_present))),
      offsets_(compiled_->offsets()) {}
CrispNetwork::~CrispNetwork() = default;

const LabelingProblem& CrispNetwork::problem() const {
  return compiled_->problem();
}

bool CrispNetwork::complete() const {
  return compiled_->complete();
}

bool CrispNetwork::by_cost_alone() const {
  return compiled_->by_cost_alone();
}

Index CrispNetwork::variables() const {
  return compiled_->variables();
}

struct ArcConsistency::State {
  State(const CompiledNetwork& network, Deadline& deadline) : propagation(network, deadline) {}
  Propagation propagation;
  CrispDomains domains = propagation.domains();
};

ArcConsistency::ArcConsistency(const CrispNetwork& network, Deadline& deadline)
    : state_(std::make_unique<State>(network.compiled(), deadline)) {}
ArcConsistency::~ArcConsistency() = default;

bool ArcConsistency::relax() {
  return state_->propagation.relax();
}

const CrispDomains& ArcConsistency::domains() const {
  return state_->domains;
}

std::vector<RemovedValue> ArcConsistency::removed() const {
  return removed_values(state_->propagation);
}

struct CrispSearch::State {
  State(const CompiledNetwork& network, const CrispRules& rules, CrispVisitor& visitor, Deadline& deadline)
      : search(network, rules, visitor, deadline) {}
  TreeSearch search;
  CrispDomains domains = search.propagation().domains();
};

CrispSearch::CrispSearch(const CrispNetwork& network, const CrispRules& rules, CrispVisitor& visitor,
                         Deadline& deadline)
    : state_(std::make_unique<State>(network.compiled(), rules, visitor, deadline)) {}
CrispSearch::~CrispSearch() = default;

CrispSearch::End CrispSearch::run() {
  return state_->search.run();
}

const CrispDomains& CrispSearch::domains() const {
  return state_->domains;
}

std::uint64_t CrispSearch::nodes() const {
  return state_->search.nodes();
}

std::vector<Index> detectability_order(const LabelingProblem& problem) {
  const auto by_detectability = [&](std::vector<Index> features) {
    std::stable_sort(features.begin(), features.end(), [&](Index a, Index b) {
      return problem.variables[a].detectability > problem.variables[b].detectability;
    });
    return features;
  };
  std::vector<double> detectability;
  for (const LabelingConstraint& constraint : problem.constraints) {
    double product = 1;
    for (const Index v : constraint.scope) product *= problem.variables[v].detectability;
    detectability.push_back(product);
  }
  std::vector<Index> ranked(problem.constraints.size());
  std::iota(ranked.begin(), ranked.end(), Index{0});
  std::stable_sort(ranked.begin(), ranked.end(), [&](Index a, Index b) { return detectability[a] > detectability[b]; });
  std::vector<bool> entered(problem.variables.size(), false);
  std::vector<Index> order;
  const auto enter = [&](const std::vector<Index>& features) {
    for (const Index v : by_detectability(features)) {
      if (!entered[v]) order.push_back(v);
      entered[v] = true;
    }
  };
  for (const Index c : ranked) enter(problem.constraints[c].scope);
  std::vector<Index> all(problem.variables.size());
  std::iota(all.begin(), all.end(), Index{0});
  enter(all);
  return order;
}

void order_by_cost(const LabelingVariable& variable, std::vector<Index>& values) {
  std::stable_sort(values.begin(), values.end(),
                   [&](Index a, Index b) { return variable.costs[a] < variable.costs[b]; });
}

FirstConsistent first_consistent(const CrispNetwork& network, CrispRules rules, bool fewest_missing,
                                 Deadline& deadline) {
  FirstConsistent made;
  rules.missing_last = fewest_missing;
  for (bool more = true; more;) {
    FirstFound visitor(network.problem(), made.values);
    TreeSearch search(network.compiled(), rules, visitor, deadline);
    const TreeSearch::End end = search.run();
    made.nodes += search.nodes();
    made.proven = end == TreeSearch::End::exhausted;
    more = end == TreeSearch::End::ended_by_visitor && fewest_missing;
    made.found = made.found || end == TreeSearch::End::ended_by_visitor;
    if (!more) break;
    const Index missing = count_missing(network.problem(), made.values);
    made.proven = missing == 0;
    more = missing > 0;
    rules.missing_limit = missing - 1;
  }
  return made;
}

}  // namespace toposcope
