// SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <charconv>
#include <cmath>
#include <stdexcept>

#include "cost_functions.h"
#include "toposcope/labeling/problem_writer.h"
#include "toposcope/labeling/tools.h"

namespace toposcope {
namespace {

void add_factor(std::string& text, double cost) {
  const double factor = std::exp(0 - cost);
  if (cost < forbidden && !(factor > 0 && factor < forbidden))
    throw std::invalid_argument(
        "a cost of " + std::to_string(cost) +
        " nats has no probability that a number can hold (about 700 at most); write .cfn or .json");
  std::array<char, 32> buffer{};
  text.append(buffer.data(), std::to_chars(buffer.data(), buffer.data() + buffer.size(), factor).ptr);
  text += ' ';
}

}  // namespace

WrittenProblem write_uai(const LabelingProblem& problem) {
  check(problem);
  std::vector<CostFunction> functions = cost_functions(problem);
  std::vector<double> constant;  // the constant joins the first variable
  if (problem.constant != 0) {
    if (problem.variables.empty())
      throw std::invalid_argument("a constant without variables cannot be written as .uai");
    constant.assign(problem.variables[0].domain(), problem.constant);
    functions.push_back({"constant", {0}, &constant, false});
  }
  std::string text = "MARKOV\n" + std::to_string(problem.variables.size()) + "\n";
  for (const LabelingVariable& variable : problem.variables) text += std::to_string(variable.domain()) + " ";
  text += "\n" + std::to_string(functions.size()) + "\n";
  for (const CostFunction& function : functions) {
    text += std::to_string(function.scope.size());
    for (const Index v : function.scope) text += " " + std::to_string(v);
    text += '\n';
  }
  std::vector<double> table;
  for (const CostFunction& function : functions) {
    fill_table(problem, function, table);
    text += "\n" + std::to_string(table.size()) + "\n";
    for (const double cost : table) add_factor(text, cost);
    text += '\n';
  }
  return {std::move(text), 0, true, 0};
}

}  // namespace toposcope
