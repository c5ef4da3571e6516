// SPDX-License-Identifier: BSD-3-Clause

// Markov and Bayesian networks in the format of the UAI inference competitions, see docs/guide/problems.md.

#include <cmath>
#include <limits>

#include "formats/problem_formats.h"
#include "reading/problem_builder.h"
#include "toposcope/labeling/tools.h"

namespace toposcope {
namespace {

constexpr std::int64_t most = 1 << 30;

std::vector<double> read_table(ProblemText& text, ProblemBuilder& builder, const std::vector<Index>& scope) {
  const ProblemToken at = text.need("the number of a function's entries");
  const auto announced = static_cast<std::size_t>(
      text.integer(at, "the number of a function's entries", 0, std::numeric_limits<std::int64_t>::max()));
  std::vector<double> costs(builder.table_size(at, scope, most_table_entries));
  if (announced != costs.size())
    text.fail(at, "the function has " + std::to_string(announced) + " entries; the domains of its " +
                      std::to_string(scope.size()) + " variables make " + std::to_string(costs.size()));
  for (double& cost : costs) {
    const ProblemToken entry = text.need("a function's entry");
    const double probability = text.number(entry, "a function's entry");
    if (probability < 0)
      text.fail(entry, "a function's entry is " + std::string(entry.text) + "; probabilities are not negative");
    cost = probability == 0 ? forbidden : 0 - std::log(probability);
  }
  return costs;
}

}  // namespace

ProblemFile read_uai(const std::string& name, std::string_view bytes, std::uint64_t memory_budget) {
  ProblemText text(name, bytes, {});
  ProblemBuilder builder(text, memory_budget);
  const ProblemToken kind = text.need("MARKOV or BAYES");
  if (kind.text != "MARKOV" && kind.text != "BAYES")
    text.fail(kind, "the file begins with " + ProblemText::name(kind) + "; supported are MARKOV and BAYES");
  const std::int64_t variables = text.need_integer("the number of variables", 0, most);
  for (std::int64_t v = 0; v < variables; ++v) {
    const ProblemToken at = text.need("a domain size");
    builder.add_variable(at, "x" + std::to_string(v), text.integer(at, "a domain size", 1, most));
  }
  const std::int64_t functions = text.need_integer("the number of functions", 0, most);
  std::vector<std::vector<Index>> scopes;
  std::vector<ProblemToken> places;
  for (std::int64_t f = 0; f < functions; ++f) {
    places.push_back(text.need("a function's number of variables"));
    const std::int64_t arity = text.integer(places.back(), "a function's number of variables", 0, variables);
    std::vector<Index>& scope = scopes.emplace_back();
    for (std::int64_t i = 0; i < arity; ++i)
      scope.push_back(static_cast<Index>(text.need_integer("the index of a variable", 0, variables - 1)));
    builder.check_scope(places.back(), scope);
  }
  for (std::size_t f = 0; f < scopes.size(); ++f) {
    std::vector<double> costs = read_table(text, builder, scopes[f]);
    builder.add_table(places[f], "f" + std::to_string(f), std::move(scopes[f]), std::move(costs));
  }
  if (const ProblemToken rest = text.peek(); !rest.end)
    text.fail(rest, "the file goes on with " + ProblemText::name(rest) + " after the " + std::to_string(functions) +
                        " functions that it announces; correct their number");
  return builder.finish();
}

void read_uai_evidence(LabelingProblem& problem, const std::string& name, std::string_view bytes) {
  ProblemText text(name, bytes, {});
  std::vector<ProblemToken> words;
  for (ProblemToken token = text.next(); !token.end; token = text.next()) words.push_back(token);
  std::vector<std::int64_t> numbers;
  for (const ProblemToken& word : words) numbers.push_back(text.integer(word, "evidence", 0, most));
  if (numbers.empty()) return;
  // "<observed> (<variable> <value>)*"; in older files the number of samples stands before it.
  std::size_t first = 0;
  const auto fits = [&](std::size_t at) {
    return at < numbers.size() && numbers.size() - at == 1 + 2 * static_cast<std::size_t>(numbers[at]);
  };
  if (!fits(0) && fits(1) && numbers[0] <= 1) first = 1;
  if (!fits(first))
    text.fail(words[0], "the file has " + std::to_string(numbers.size()) +
                            " numbers; it should be the number of observed variables, then for each its index and its "
                            "value (one sample only)");
  for (std::size_t i = first + 1; i < numbers.size(); i += 2) {
    if (numbers[i] >= static_cast<std::int64_t>(problem.variables.size()))
      text.fail(words[i], "there is no variable " + std::to_string(numbers[i]) + "; the problem has " +
                              std::to_string(problem.variables.size()));
    LabelingVariable& variable = problem.variables[static_cast<std::size_t>(numbers[i])];
    if (numbers[i + 1] >= variable.domain())
      text.fail(words[i + 1], "variable " + std::to_string(numbers[i]) + " has no value " +
                                  std::to_string(numbers[i + 1]) + "; it has " + std::to_string(variable.domain()));
    for (Index value = 0; value < variable.domain(); ++value)
      if (value != numbers[i + 1]) variable.costs[value] = forbidden;
  }
}

}  // namespace toposcope
