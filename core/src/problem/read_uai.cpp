// SPDX-License-Identifier: BSD-3-Clause
// .uai: factors of a Markov or Bayes network, whose product is a probability; costs are minus their logarithms.

#include <algorithm>
#include <cmath>

#include "problem/problem_builder.h"
#include "problem/problem_formats.h"
#include "problem/problem_words.h"

namespace toposcope {

ProblemFile read_uai(const std::string& where, std::string_view text, std::string_view evidence) {
  constexpr std::int64_t most = 1'000'000;
  ProblemFile file;
  ProblemWords words(where, text);
  const std::string kind(words.need("MARKOV or BAYES"));
  if (kind != "MARKOV" && kind != "BAYES") words.fail("'" + kind + "' stands where MARKOV or BAYES should");
  const std::int64_t variables = words.integer("the number of variables", 0, most);
  for (std::int64_t v = 0; v < variables; ++v)
    add_variable(file.problem, "x" + std::to_string(v),
                 static_cast<Index>(words.integer("the size of a domain", 1, most)));
  std::vector<std::vector<Index>> scopes(
      static_cast<std::size_t>(words.integer("the number of factors", 0, most * 10)));
  for (std::vector<Index>& scope : scopes) {
    scope.resize(static_cast<std::size_t>(words.integer("the size of a scope", 0, variables)));
    for (Index& v : scope) v = static_cast<Index>(words.integer("a variable of a factor", 0, variables - 1));
    for (const Index v : scope)
      if (std::count(scope.begin(), scope.end(), v) > 1)
        words.fail("variable " + std::to_string(v) + " stands twice in a scope");
  }
  for (std::size_t f = 0; f < scopes.size(); ++f) {
    const auto entries = table_size(file.problem, scopes[f]);
    if (!entries)
      words.fail("factor " + std::to_string(f) + " needs a table of over " + std::to_string(most_entries) +
                 " entries, which is not supported");
    if (words.integer("the number of a factor's entries", 0, most * 1000) != static_cast<std::int64_t>(*entries))
      words.fail("factor " + std::to_string(f) + " must have " + std::to_string(*entries) + " entries for its domains");
    std::vector<double> costs(*entries);
    for (double& cost : costs) {
      const double factor = words.number("a factor's entry");
      if (!(factor >= 0 && std::isfinite(factor))) words.fail("a factor's entry must be finite and not negative");
      cost = factor > 0 ? -std::log(factor) : forbidden;
    }
    if (scopes[f].empty() && costs[0] == forbidden)
      words.fail("a factor of no variables is 0: nothing has a probability");
    add_table(file, "factor" + std::to_string(f), scopes[f], std::move(costs));
  }
  if (!words.at_end()) words.fail("more follows after the last factor; the number of factors is wrong");

  const std::string evidence_where = where + ".evid";
  ProblemWords seen(evidence_where, evidence);
  if (!seen.at_end()) {
    // The newer form puts the number of samples (1) first; then the file has an even number of words.
    std::size_t count = 0;
    for (ProblemWords counted(evidence_where, evidence); !counted.next().empty();) ++count;
    if (count % 2 == 0 && seen.integer("the number of samples", 0, 1) == 0) return file;
    const std::int64_t observed = seen.integer("the number of observed variables", 0, variables);
    for (std::int64_t k = 0; k < observed; ++k) {
      LabelingVariable& variable =
          file.problem.variables[static_cast<std::size_t>(seen.integer("a variable", 0, variables - 1))];
      const auto value = static_cast<Index>(seen.integer("an observed value", 0, variable.domain() - 1));
      for (Index a = 0; a < variable.domain(); ++a)
        if (a != value) variable.costs[a] = forbidden;
    }
  }
  return file;
}

}  // namespace toposcope
