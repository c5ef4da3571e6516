// SPDX-License-Identifier: BSD-3-Clause
#include "reading/problem_builder.h"

#include <algorithm>
#include <cmath>

#include "toposcope/labeling/tools.h"

namespace toposcope {
namespace {

double least_below_zero(const std::vector<double>& costs) {
  return std::min(0.0, *std::min_element(costs.begin(), costs.end()));
}

}  // namespace

void ProblemBuilder::add_variable(const ProblemToken& at, std::string name, std::int64_t domain,
                                  std::vector<std::string> value_names) {
  if (domain < 1)
    text_.fail(at, "variable '" + name + "' has " + std::to_string(domain) + " values; it needs at least one");
  if (static_cast<std::size_t>(domain) > most_table_entries)
    text_.fail(at, "variable '" + name + "' has " + std::to_string(domain) + " values; at most " +
                       std::to_string(most_table_entries) + " are held in memory");
  take(at, static_cast<std::size_t>(domain));
  LabelingVariable& variable = problem().variables.emplace_back();
  variable.name = std::move(name);
  variable.optional = false;
  variable.costs.assign(static_cast<std::size_t>(domain), 0);
  variable.value_names = std::move(value_names);
}

void ProblemBuilder::take(const ProblemToken& at, std::size_t entries) {
  const std::uint64_t bytes = std::uint64_t{entries} * sizeof(double);
  if (bytes > memory_budget_ - taken_)
    text_.fail(at, "the tables up to here need " + std::to_string(taken_ + bytes) + " bytes, and a problem may take " +
                       std::to_string(memory_budget_) + "; split functions into ones of fewer variables");
  taken_ += bytes;
}

void ProblemBuilder::check_scope(const ProblemToken& at, std::span<const Index> scope) const {
  for (std::size_t i = 0; i < scope.size(); ++i)
    if (std::find(scope.begin() + static_cast<std::ptrdiff_t>(i) + 1, scope.end(), scope[i]) != scope.end())
      text_.fail(at, "the scope names variable '" + file_.problem.variables[scope[i]].name +
                         "' twice; a function is over different variables");
}

std::size_t ProblemBuilder::table_size(const ProblemToken& at, std::span<const Index> scope, std::size_t most) {
  std::size_t entries = 1;
  for (const Index v : scope) {
    entries *= domain(v);
    if (entries > most)
      text_.fail(at, "the function over " + std::to_string(scope.size()) + " variables needs a table of more than " +
                         std::to_string(most) +
                         " entries, which is the most that is held; split it into functions of fewer variables");
  }
  take(at, entries);
  return entries;
}

void ProblemBuilder::add_table(const ProblemToken& at, std::string name, std::vector<Index> scope,
                               std::vector<double> costs) {
  check_scope(at, scope);
  if (scope.size() < 2) taken_ -= costs.size() * sizeof(double);  // added to what is there
  if (scope.empty()) {
    problem().constant += costs[0];
    if (!std::isfinite(problem().constant))
      text_.fail(at, "the functions without variables forbid every labelling; remove this one, or give it a cost");
  } else if (scope.size() == 1) {
    std::vector<double>& own = problem().variables[scope[0]].costs;
    for (std::size_t value = 0; value < own.size(); ++value) own[value] += costs[value];
  } else {
    problem().constraints.push_back({std::move(name), std::move(scope), std::move(costs), {}});
  }
}

void ProblemBuilder::tabulate(const ProblemToken& at, std::string name, std::vector<Index> scope,
                              const CostFunction& function) {
  check_scope(at, scope);
  std::vector<double> costs(table_size(at, scope, most_tabulated_entries));
  std::vector<Index> values(scope.size(), 0);
  for (double& entry : costs) {
    entry = function(values);
    for (std::size_t k = values.size(); k-- > 0;) {
      if (++values[k] < domain(scope[k])) break;
      values[k] = 0;
    }
  }
  add_table(at, std::move(name), std::move(scope), std::move(costs));
}

void ProblemBuilder::tabulate_pairs(const ProblemToken& at, const std::string& name, std::span<const Index> scope,
                                    const CostFunction& function) {
  check_scope(at, scope);
  for (std::size_t i = 0; i < scope.size(); ++i)
    for (std::size_t j = i + 1; j < scope.size(); ++j)
      tabulate(at, name + "_" + std::to_string(i) + "_" + std::to_string(j), {scope[i], scope[j]}, function);
}

// The bound, less the least that all functions together may give.
void ProblemBuilder::find_threshold() {
  threshold_ = file_.top - std::min(0.0, problem().constant);
  for (const LabelingVariable& variable : problem().variables) threshold_ -= least_below_zero(variable.costs);
  for (const LabelingConstraint& constraint : problem().constraints) threshold_ -= least_below_zero(constraint.costs);
}

ProblemFile ProblemBuilder::finish() {
  for (const auto& add : first_) add();
  find_threshold();
  for (const auto& add : last_) add();
  find_threshold();
  const auto forbid = [this](std::vector<double>& costs) {
    const double reaches = threshold_ + least_below_zero(costs);  // with the least of all other functions
    for (double& cost : costs)
      if (cost >= reaches) cost = forbidden;
  };
  for (LabelingVariable& variable : problem().variables) forbid(variable.costs);
  for (LabelingConstraint& constraint : problem().constraints) forbid(constraint.costs);
  return std::move(file_);
}

}  // namespace toposcope
