// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// What the readers of cost function files share: tables made of functions, the top cost, what several functions of one
// scope add up to.

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "problem/problem_io.h"
#include "toposcope/labeling_tools.h"

namespace toposcope {

using Tuple = std::span<const Index>;
/// Cost of the values of a function's scope.
using CostFunction = std::function<double(Tuple)>;

inline constexpr std::size_t most_entries = 4'000'000;

/// Entries of a table over the scope; nothing when there are more than `most_entries`.
std::optional<std::size_t> table_size(const LabelingProblem& problem, const std::vector<Index>& scope);

/// A variable that may not be missing, its values free of charge.
void add_variable(LabelingProblem& problem, std::string name, Index domain);

/// Adds a table to the problem: to the constant, a variable's costs, or as a constraint; what costs `top` is forbidden.
void add_table(ProblemFile& file, std::string name, std::vector<Index> scope, std::vector<double> costs);
/// \return the reason why it cannot be, empty when it was added
std::string add_function(ProblemFile& file, std::string name, std::vector<Index> scope, const CostFunction& cost);

/// A global cost function of toulbar2 by its name: `salldiff`, `sgcc`, `max`, `samong`, `wamong`, `ssame`, `sregular`,
/// `knapsack`, `wsum`, comparisons and disjunctions of two variables. The numbers follow the order of the .wcsp format.
struct GlobalArguments {
  std::string metric;  ///< var, dec, hard, lin, quad
  double cost = 0;
  std::vector<double> numbers = {};
  std::string comparator = {};
};
struct GlobalFunction {
  CostFunction cost;      ///< empty: not supported
  std::string why = {};   ///< then
  bool pairwise = false;  ///< a sum over pairs of `cost` on two values
};
GlobalFunction global_function(const std::string& name, const std::vector<Index>& scope, const GlobalArguments& given,
                               double top);
/// Tabulates a global function or, where it is one, adds the pairs. \return reason, as add_function
std::string add_global(ProblemFile& file, const std::string& name, const std::vector<Index>& scope,
                       const GlobalArguments& given);

}  // namespace toposcope
