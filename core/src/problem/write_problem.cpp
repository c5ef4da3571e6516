// SPDX-License-Identifier: BSD-3-Clause
// Other solvers' formats: every exclusion as a pairwise function, what is forbidden at a cost that no solution reaches.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "base/errors.h"
#include "problem/problem_formats.h"
#include "toposcope/labeling_tools.h"

namespace toposcope {
namespace {

struct Function {
  std::vector<Index> scope;
  std::vector<double> costs;
};

/// Unary costs, constraints and exclusions as functions; several pairwise ones of the same pair become one.
std::vector<Function> functions_of(const LabelingProblem& problem) {
  std::vector<Function> functions;
  std::map<std::pair<Index, Index>, std::size_t> pairs;
  const auto pair = [&](Index v, Index w) -> Function& {
    const auto [at, made] = pairs.try_emplace({v, w}, functions.size());
    if (made)
      functions.push_back({{v, w},
                           std::vector<double>(static_cast<std::size_t>(problem.variables[v].domain()) *
                                               problem.variables[w].domain())});
    return functions[at->second];
  };
  for (Index v = 0; v < problem.variables.size(); ++v) functions.push_back({{v}, problem.variables[v].costs});
  for (const LabelingConstraint& constraint : problem.constraints) {
    if (constraint.scope.size() != 2) {
      functions.push_back({constraint.scope, constraint.costs});
      continue;
    }
    const Index v = std::min(constraint.scope[0], constraint.scope[1]);
    const Index w = std::max(constraint.scope[0], constraint.scope[1]);
    const std::size_t rows = problem.variables[v].domain(), columns = problem.variables[w].domain();
    Function& function = pair(v, w);
    for (std::size_t a = 0; a < rows; ++a)
      for (std::size_t b = 0; b < columns; ++b)
        function.costs[a * columns + b] +=
            constraint.scope[0] == v ? constraint.costs[a * columns + b] : constraint.costs[b * rows + a];
  }
  for (Index v = 0; v < problem.variables.size(); ++v)
    for (Index w = v + 1; w < problem.variables.size(); ++w)
      for (Index a = 0; a < problem.variables[v].domain(); ++a)
        for (Index b = 0; b < problem.variables[w].domain(); ++b)
          if (excluded(problem, v, a, w, b))
            pair(v, w).costs[static_cast<std::size_t>(a) * problem.variables[w].domain() + b] = forbidden;
  return functions;
}

/// Decimals that the costs need, at most six; the sum of all that a labelling can cost at most.
struct Scale {
  int decimals = 0;
  double sum = 1;
};
Scale scale_of(const LabelingProblem& problem, const std::vector<Function>& functions) {
  Scale scale;
  double factor = 1;
  const auto need = [&](double cost) {
    while (scale.decimals < 6 && std::abs(cost * factor - std::round(cost * factor)) > 1e-9 * std::max(1.0, factor)) {
      ++scale.decimals;
      factor *= 10;
    }
  };
  need(problem.constant);
  scale.sum += std::abs(problem.constant);
  for (const Function& function : functions) {
    double most = 0;
    for (const double cost : function.costs)
      if (cost < forbidden) {
        need(cost);
        most = std::max(most, std::abs(cost));
      }
    scale.sum += most;
  }
  return scale;
}

/// Costs that differ from the most frequent cheap description: 0, or what most entries have.
double most_frequent(const std::vector<double>& costs) {
  std::map<double, std::size_t> count;
  for (const double cost : costs) ++count[cost];
  return std::max_element(count.begin(), count.end(), [](const auto& a, const auto& b) { return a.second < b.second; })
      ->first;
}

std::string symbol(const std::string& name, Index number) {
  std::string made;
  for (const char c : name) made += std::isalnum(static_cast<unsigned char>(c)) || c == '_' ? c : '_';
  return fmt::format("v{}_{}", number, made);
}

}  // namespace

std::string cfn_text(const LabelingProblem& problem) {
  std::vector<Function> functions = functions_of(problem);
  const Scale scale = scale_of(problem, functions);
  const double top = std::ceil(2 * scale.sum) + 1;
  double constant = problem.constant;
  for (Function& function : functions) {
    if (function.scope.size() < 3) continue;  // toulbar2 1.1 counts the least cost of larger functions twice
    const double least = *std::min_element(function.costs.begin(), function.costs.end());
    if (least == forbidden) continue;
    constant += least;
    for (double& cost : function.costs) cost -= least;
  }
  const auto number = [&](double cost) { return fmt::format("{:.{}f}", std::min(cost, top), scale.decimals); };
  std::string text = fmt::format("{{\n\"problem\": {{\"name\": \"{}\", \"mustbe\": \"<{}\"}},\n\"variables\": {{",
                                 symbol(problem.name, 0), number(top));
  for (Index v = 0; v < problem.variables.size(); ++v)
    text +=
        fmt::format("{}\"{}\": {}", v ? ", " : "", symbol(problem.variables[v].name, v), problem.variables[v].domain());
  text += fmt::format("}},\n\"functions\": {{\n\"constant\": {{\"scope\": [], \"costs\": [{}]}}", number(constant));
  for (std::size_t f = 0; f < functions.size(); ++f) {
    text += fmt::format(",\n\"f{}\": {{\"scope\": [", f);
    for (std::size_t k = 0; k < functions[f].scope.size(); ++k)
      text += fmt::format("{}\"{}\"", k ? ", " : "",
                          symbol(problem.variables[functions[f].scope[k]].name, functions[f].scope[k]));
    text += "], \"costs\": [";
    for (std::size_t k = 0; k < functions[f].costs.size(); ++k) text += (k ? "," : "") + number(functions[f].costs[k]);
    text += "]}";
  }
  return text + "\n}\n}\n";
}

std::string wcsp_text(const LabelingProblem& problem) {
  std::vector<Function> functions = functions_of(problem);
  const Scale scale = scale_of(problem, functions);
  const double factor = std::pow(10, scale.decimals);
  double shift = problem.constant;  // no cost may be negative: the least of each function goes to the constant
  for (Function& function : functions) {
    const double least = std::min(0.0, *std::min_element(function.costs.begin(), function.costs.end()));
    shift += least;
    for (double& cost : function.costs) cost -= least;
  }
  const double top = std::ceil(2 * scale.sum * factor) + 1;
  if (top > 1e15)
    throw UsageError("the costs span too many digits for the whole numbers of .wcsp; write .cfn or .json");
  Index largest = 0;
  for (const LabelingVariable& variable : problem.variables) largest = std::max(largest, variable.domain());
  const bool constant = shift > 0;
  std::string text = fmt::format("{} {} {} {} {:.0f}\n", symbol(problem.name, 0), problem.variables.size(), largest,
                                 functions.size() + constant, top);
  for (const LabelingVariable& variable : problem.variables) text += fmt::format("{} ", variable.domain());
  text += "\n";
  if (constant) text += fmt::format("0 {:.0f} 0\n", shift * factor);
  for (const Function& function : functions) {
    const double base = most_frequent(function.costs);
    const auto number = [&](double cost) { return fmt::format("{:.0f}", std::min(std::round(cost * factor), top)); };
    text += fmt::format("{} {} {} {}\n", function.scope.size(), fmt::join(function.scope, " "), number(base),
                        function.costs.size() -
                            static_cast<std::size_t>(std::count(function.costs.begin(), function.costs.end(), base)));
    LabelingConstraint scope{"", function.scope};
    std::vector<Index> digits(function.scope.size(), 0);
    std::size_t entry = 0;
    do {
      if (function.costs[entry] != base)
        text += fmt::format("{} {}\n", fmt::join(digits, " "), number(function.costs[entry]));
      ++entry;
    } while (next_entry(problem, scope, digits));
  }
  return text;
}

std::string uai_text(const LabelingProblem& problem) {
  const std::vector<Function> functions = functions_of(problem);
  std::string text = fmt::format("MARKOV\n{}\n", problem.variables.size());
  for (const LabelingVariable& variable : problem.variables) text += fmt::format("{} ", variable.domain());
  text += fmt::format("\n{}\n", functions.size() + 1);
  for (const Function& function : functions)
    text += fmt::format("{} {}\n", function.scope.size(), fmt::join(function.scope, " "));
  text += "0\n";
  for (const Function& function : functions) {
    text += fmt::format("\n{}\n", function.costs.size());
    for (const double cost : function.costs) text += fmt::format("{} ", std::exp(-cost));
  }
  return text + fmt::format("\n1\n{}\n", std::exp(-problem.constant));
}

}  // namespace toposcope
