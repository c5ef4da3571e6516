// SPDX-License-Identifier: BSD-3-Clause
// The compiled network against the problem's tables, arc consistency against its definition, and explanations by trying
// them.

#include "crisp_propagation.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/run_context.h"
#include "support/labeling_problems.h"
#include "support/random.h"

namespace toposcope {
namespace {

/// None may be missing and much is forbidden, so that assignments come to dead ends.
LabelingProblem tight_problem(std::uint64_t seed) {
  test::RandomKind kind{.variables = 5, .domain = 4, .arity = 3, .constraints = 6};
  kind.optional = 0;
  kind.forbidden_entries = 0.2;
  kind.forbidden_unary = 0.02;
  return test::random_problem(kind, seed);
}

using Values = std::vector<Index>;
using Domains = std::vector<std::vector<bool>>;

template <class Body>
void for_each_assignment(const LabelingProblem& problem, const std::vector<Index>& scope, const Body& body) {
  Values values(scope.size(), 0);
  for (std::size_t k = 0; k < values.size();) {
    body(values);
    for (k = 0; k < values.size() && ++values[k] == problem.variables[scope[k]].domain(); ++k) values[k] = 0;
  }
}

/// What binds these variables and no others allows the values: met together for two, each table by itself for more.
bool stands(const LabelingProblem& problem, const std::vector<Index>& scope, const Values& values,
            const LabelingConstraint* only = nullptr) {
  for (const LabelingConstraint& constraint : problem.constraints) {
    if (only != nullptr && only != &constraint) continue;
    if (!std::is_permutation(scope.begin(), scope.end(), constraint.scope.begin(), constraint.scope.end())) continue;
    std::size_t entry = 0;
    for (const Index v : constraint.scope) {
      const auto at = static_cast<std::size_t>(std::find(scope.begin(), scope.end(), v) - scope.begin());
      entry = entry * problem.variables[v].domain() + values[at];
    }
    if (!allowed(constraint, entry)) return false;
  }
  return scope.size() != 2 || !excluded(problem, scope[0], values[0], scope[1], values[1]);
}

struct Bound {
  std::vector<Index> scope;
  const LabelingConstraint* only = nullptr;
};

std::vector<Bound> all_bound(const LabelingProblem& problem) {
  std::vector<Bound> all;
  for (Index a = 0; a < problem.variables.size(); ++a) {
    all.push_back({{a}});
    for (Index b = a + 1; b < problem.variables.size(); ++b) all.push_back({{a, b}});
  }
  for (const LabelingConstraint& constraint : problem.constraints)
    if (constraint.scope.size() > 2) all.push_back({constraint.scope, &constraint});
  return all;
}

/// Strikes what nothing left of the others can stand with, until no more goes.
void relax_by_definition(const LabelingProblem& problem, Domains& domains) {
  for (bool changed = true; changed;) {
    changed = false;
    for (const auto& [scope, only] : all_bound(problem)) {
      Domains supported(scope.size());
      for (std::size_t k = 0; k < scope.size(); ++k) supported[k].assign(domains[scope[k]].size(), false);
      for_each_assignment(problem, scope, [&](const Values& values) {
        for (std::size_t k = 0; k < scope.size(); ++k)
          if (!domains[scope[k]][values[k]]) return;
        if (!stands(problem, scope, values, only)) return;
        for (std::size_t k = 0; k < scope.size(); ++k) supported[k][values[k]] = true;
      });
      for (std::size_t k = 0; k < scope.size(); ++k) {
        changed = changed || domains[scope[k]] != supported[k];
        domains[scope[k]] = supported[k];
      }
    }
  }
}

bool any_empty(const Domains& domains) {
  return std::any_of(domains.begin(), domains.end(), [](const std::vector<bool>& domain) {
    return std::find(domain.begin(), domain.end(), true) == domain.end();
  });
}

Domains finite_values(const LabelingProblem& problem) {
  Domains domains;
  for (const LabelingVariable& variable : problem.variables) {
    domains.emplace_back();
    for (const double cost : variable.costs) domains.back().push_back(cost < forbidden);
  }
  return domains;
}

Domains domains_of(const Propagation& propagation) {
  Domains domains(propagation.network().variables());
  for (Index v = 0; v < domains.size(); ++v)
    for (Index value = 0; value < propagation.network().domain(v); ++value)
      domains[v].push_back(propagation.contains(v, value));
  return domains;
}

/// A problem with some values assigned one after the other, as far as the domains stay open.
struct Dive {
  Propagation propagation;
  Domains expected;
  std::vector<std::pair<Index, Index>> decisions = {};
  bool open = false;

  Dive(const CompiledNetwork& network, const LabelingProblem& problem, Deadline& deadline)
      : propagation(network, deadline), expected(finite_values(problem)) {
    relax_by_definition(problem, expected);
    open = propagation.relax();
    propagation.set_root();
  }
};

TEST(CrispNetwork, PairsAndTablesAllowWhatTheProblemAllows) {
  const RunContext context;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE(seed);
    const LabelingProblem problem = tight_problem(seed);
    Deadline deadline(60, context);
    const CompiledNetwork network(problem, deadline);
    ASSERT_TRUE(network.complete());
    const auto bit = [&](std::size_t offset, Index value) {
      return (network.bits(offset)[value / 64] >> (value % 64) & 1U) != 0;
    };
    for (const CrispPair& pair : network.pairs())
      for_each_assignment(problem, {pair.first, pair.second}, [&](const Values& values) {
        const bool wanted = stands(problem, {pair.first, pair.second}, values);
        EXPECT_EQ(bit(pair.from_first + values[0] * network.words(pair.second), values[1]), wanted);
        EXPECT_EQ(bit(pair.from_second + values[1] * network.words(pair.first), values[0]), wanted);
      });
    for (const CrispTable& table : network.tables())
      for_each_assignment(problem, table.scope, [&](const Values& values) {
        std::size_t prefix = 0;
        for (std::size_t k = 0; k + 1 < values.size(); ++k) prefix += values[k] * table.strides[k];
        const LabelingConstraint& constraint = problem.constraints[table.constraint];
        std::size_t entry = 0;
        for (std::size_t k = 0; k < values.size(); ++k)
          entry = entry * problem.variables[table.scope[k]].domain() + values[k];
        EXPECT_EQ(bit(table.rows + prefix * network.words(table.scope.back()), values.back()),
                  allowed(constraint, entry));
      });
  }
}

TEST(CrispPropagation, IsArcConsistentByDefinitionAndExplainsItsFailures) {
  const RunContext context;
  std::size_t failures = 0, spared = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    const LabelingProblem problem = tight_problem(seed);
    Deadline deadline(60, context);
    const CompiledNetwork network(problem, deadline);
    Dive dive(network, problem, deadline);
    ASSERT_EQ(dive.open, !any_empty(dive.expected));
    test::Random random(seed);
    while (dive.open) {
      ASSERT_EQ(domains_of(dive.propagation), dive.expected);
      std::vector<std::pair<Index, Index>> left;
      for (Index v = 0; v < dive.expected.size(); ++v)
        for (Index value = 0; value < dive.expected[v].size() && !dive.propagation.assigned(v); ++value)
          if (dive.expected[v][value]) left.emplace_back(v, value);
      if (left.empty()) break;
      const auto [variable, value] = left[random.below(left.size())];
      dive.decisions.emplace_back(variable, value);
      dive.propagation.assign(variable, value);
      dive.expected[variable].assign(dive.expected[variable].size(), false);
      dive.expected[variable][value] = true;
      relax_by_definition(problem, dive.expected);
      dive.open = dive.propagation.relax();
      ASSERT_EQ(dive.open, !any_empty(dive.expected));
    }
    if (dive.open || dive.decisions.empty()) continue;
    ++failures;
    VariableSet blamed((problem.variables.size() + 63) / 64, 0);
    dive.propagation.explain_failure(blamed);
    // The decisions that are blamed fail by themselves.
    Domains alone = finite_values(problem);
    for (const auto& [variable, value] : dive.decisions) {
      const bool is_blamed = (blamed[variable / 64] >> (variable % 64) & 1U) != 0;
      spared += !is_blamed;
      if (!is_blamed) continue;
      alone[variable].assign(alone[variable].size(), false);
      alone[variable][value] = true;
    }
    relax_by_definition(problem, alone);
    EXPECT_TRUE(any_empty(alone));
  }
  EXPECT_GT(failures, 10U);
  EXPECT_GT(spared, 0U);
}

TEST(CrispPropagation, UndoGivesBackWhatWasThere) {
  const RunContext context;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(seed);
    const LabelingProblem problem = tight_problem(seed);
    Deadline deadline(60, context);
    const CompiledNetwork network(problem, deadline);
    Propagation propagation(network, deadline);
    if (!propagation.relax()) continue;
    const Domains before = domains_of(propagation);
    for (Index v = 0; v < before.size(); ++v)
      for (Index value = 0; value < before[v].size(); ++value) {
        if (!before[v][value]) continue;
        const Propagation::Mark mark = propagation.mark();
        propagation.assign(v, value);
        propagation.relax();
        propagation.undo(mark);
        ASSERT_EQ(domains_of(propagation), before);
      }
  }
}

}  // namespace
}  // namespace toposcope
