// SPDX-License-Identifier: BSD-3-Clause
// The project's own format: loses nothing. What is forbidden is written as null.

#include <cmath>
#include <nlohmann/json.hpp>

#include "base/errors.h"
#include "problem/problem_formats.h"
#include "toposcope/labeling_tools.h"

namespace toposcope {
namespace {

using nlohmann::json;

template <class Number>
json numbers(const std::vector<Number>& values) {
  json list = json::array();
  for (const Number value : values) list.push_back(std::isfinite(value) ? json(value) : json());
  return list;
}

template <class Number>
std::vector<Number> numbers(const json& list) {
  std::vector<Number> values;
  values.reserve(list.size());
  for (const json& item : list)
    values.push_back(item.is_null() ? std::numeric_limits<Number>::infinity() : item.get<Number>());
  return values;
}

}  // namespace

std::string problem_json(const LabelingProblem& problem) {
  json root = {{"schema", "toposcope.problem/1"}, {"name", problem.name}, {"constant", problem.constant}};
  for (const LabelingVariable& variable : problem.variables) {
    json entry = {{"name", variable.name},
                  {"optional", variable.optional},
                  {"detectability", variable.detectability},
                  {"costs", numbers(variable.costs)}};
    if (!variable.candidates.empty()) entry["candidates"] = variable.candidates;
    if (!variable.value_names.empty()) entry["value_names"] = variable.value_names;
    root["variables"].push_back(std::move(entry));
  }
  for (const LabelingConstraint& constraint : problem.constraints) {
    json entry = {{"name", constraint.name}, {"scope", constraint.scope}, {"costs", numbers(constraint.costs)}};
    if (!constraint.violations.empty()) entry["violations"] = numbers(constraint.violations);
    root["constraints"].push_back(std::move(entry));
  }
  root["candidate_count"] = problem.candidate_count;
  json conflicts = json::array();
  for (Index a = 0; a < problem.candidate_count; ++a)
    for (Index b = a; b < problem.candidate_count; ++b)
      if (problem.conflict(a, b)) conflicts.push_back({a, b});
  root["conflicts"] = std::move(conflicts);
  return root.dump() + "\n";
}

ProblemFile read_problem_json(const std::string& where, std::string_view text) {
  try {
    const json root = json::parse(text);
    if (root.value("schema", "") != "toposcope.problem/1")
      throw UsageError(where + ": is no labelling problem: 'schema' must be \"toposcope.problem/1\"");
    ProblemFile file;
    LabelingProblem& problem = file.problem;
    problem.name = root.value("name", "");
    problem.constant = root.value("constant", 0.0);
    for (const json& entry : root.value("variables", json::array())) {
      LabelingVariable& variable = problem.variables.emplace_back();
      variable.name = entry.at("name").get<std::string>();
      variable.optional = entry.value("optional", true);
      variable.detectability = entry.value("detectability", 1.0);
      variable.costs = numbers<double>(entry.at("costs"));
      variable.candidates = entry.value("candidates", std::vector<Index>{});
      variable.value_names = entry.value("value_names", std::vector<std::string>{});
    }
    for (const json& entry : root.value("constraints", json::array())) {
      LabelingConstraint& constraint = problem.constraints.emplace_back();
      constraint.name = entry.value("name", "");
      constraint.scope = entry.at("scope").get<std::vector<Index>>();
      constraint.costs = numbers<double>(entry.at("costs"));
      if (entry.contains("violations")) constraint.violations = numbers<float>(entry["violations"]);
    }
    problem.candidate_count = root.value("candidate_count", Index{0});
    if (problem.candidate_count > 1'000'000) throw UsageError(where + ": has more than a million candidates");
    problem.conflict_bits.assign(problem.candidate_count * problem.conflict_words(), 0);
    for (const json& pair : root.value("conflicts", json::array())) {
      const auto a = pair.at(0).get<std::size_t>(), b = pair.at(1).get<std::size_t>();
      if (a >= problem.candidate_count || b >= problem.candidate_count)
        throw UsageError(where + ": 'conflicts' names candidate " + std::to_string(std::max(a, b)) + " of " +
                         std::to_string(problem.candidate_count));
      problem.conflict_bits[a * problem.conflict_words() + b / 64] |= std::uint64_t{1} << (b % 64);
      problem.conflict_bits[b * problem.conflict_words() + a / 64] |= std::uint64_t{1} << (a % 64);
    }
    return file;
  } catch (const json::exception& error) {
    throw UsageError(where + ": " + error.what() + "; compare with schemas/problem.schema.json");
  }
}

}  // namespace toposcope
