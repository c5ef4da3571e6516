// SPDX-License-Identifier: BSD-3-Clause
#include "solver_output.h"

#include <cstdlib>
#include <sstream>
#include <utility>

namespace toposcope::toulbar2 {
namespace {

// The number before the word that begins so.
std::uint64_t number_before(const std::string& line, const std::string& word) {
  std::istringstream words(line);
  std::string each, last;
  while (words >> each && !each.starts_with(word)) last = each;
  return std::strtoull(last.c_str(), nullptr, 10);
}

// The numbers of a line as values of the problem; none where they are too few.
std::vector<Index> parse_values(const std::string& line, const LabelingProblem& problem) {
  std::istringstream words(line);
  std::vector<Index> values;
  for (std::uint64_t value = 0; values.size() < problem.variables.size() && words >> value;)
    if (value < problem.variables[values.size()].domain()) values.push_back(static_cast<Index>(value));
  if (values.size() < problem.variables.size()) values.clear();
  return values;
}

}  // namespace

SolverOutput parse_output(const std::string& text, const LabelingProblem& problem) {
  SolverOutput output;
  bool labelling_follows = false;
  for (std::size_t begin = 0, end = text.find('\n'); end != text.npos; begin = end + 1, end = text.find('\n', begin)) {
    const std::string line = text.substr(begin, end - begin);
    if (line.find_first_not_of(" \t\r") != line.npos) output.last_line = line;
    if (labelling_follows)
      if (std::vector<Index> values = parse_values(line, problem); !values.empty()) output.values = std::move(values);
    labelling_follows = line.starts_with("New solution:");
    for (const std::string start : {"Initial lower and upper bounds: [", "Optimality gap: ["})
      if (line.starts_with(start)) output.lower_bound = std::strtod(line.c_str() + start.size(), nullptr);
    if (const std::string start = "Optimum:"; line.starts_with(start)) {
      output.optimal = true;
      output.optimum = std::strtod(line.c_str() + start.size(), nullptr);
    }
    output.unsatisfiable = output.unsatisfiable || line.starts_with("No solution");
    if (line.starts_with("Optimum:") || line.starts_with("No solution")) {
      output.backtracks = number_before(line, "backtracks");
      output.nodes = number_before(line, "nodes");
    }
  }
  return output;
}

}  // namespace toposcope::toulbar2
