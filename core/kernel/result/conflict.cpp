// SPDX-License-Identifier: BSD-3-Clause
#include "result/conflict.h"

#include "toposcope/labeling/conflict_set.h"

namespace toposcope {
namespace {

constexpr double time_limit_s = 1;  // one feature against the others as they are: a moment

std::string any_of(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t k = 0; k < names.size(); ++k) text += (k == 0 ? "" : " or ") + names[k];
  return text;
}

}  // namespace

std::optional<ConflictReport> conflict_of_missing(const LabelingProblem& problem, const Labeling& labeling,
                                                  Index variable, const Context& context) {
  ConflictQuestion question{false, labeling.values, variable};
  question.fixed[variable] = no_candidate;
  Deadline deadline(time_limit_s, context);
  const ConflictSet set = smallest_conflict(problem, question, deadline);
  if (!set.conflicts() || set.size() == 0) return std::nullopt;
  ConflictReport report;
  report.smallest = set.status == ConflictSet::Status::smallest;
  for (const Index c : set.constraints) report.relations.push_back(problem.constraints[c].name);
  for (const auto& [first, second] : set.exclusions)
    report.exclusions.push_back(problem.variables[first == variable ? second : first].name);
  return report;
}

std::string in_words(const ConflictReport& conflict) {
  std::string text = "every candidate ";
  if (!conflict.relations.empty()) text += "breaks " + any_of(conflict.relations);
  if (!conflict.relations.empty() && !conflict.exclusions.empty()) text += " or ";
  if (!conflict.exclusions.empty()) text += "shares its place with " + any_of(conflict.exclusions);
  return text;
}

}  // namespace toposcope
