// SPDX-License-Identifier: BSD-3-Clause
#include "functions/global_functions.h"

#include <utility>

#include "base/nearest_name.h"
#include "functions/function_families.h"

namespace toposcope {
namespace {

using namespace intension;

using Reader = void (*)(const Call&);
const std::vector<std::pair<std::string, Reader>>& readers() {
  static const std::vector<std::pair<std::string, Reader>> table = {
      {">=", arithmetic},
      {">", arithmetic},
      {"<=", arithmetic},
      {"<", arithmetic},
      {"=", arithmetic},
      {"disj", disjunction},
      {"sdisj", disjunction},
      {"salldiff", all_different},
      {"salldiffdp", all_different},
      {"salldiffkp", all_different},
      {"walldiff", w_all_different},
      {"walldifferent", w_all_different},
      {"sgcc", cardinality},
      {"sgccdp", cardinality},
      {"wgcc", w_cardinality},
      {"ssame", same},
      {"wsame", w_same},
      {"wsamegcc", w_same},
      {"samong", among},
      {"samongdp", among},
      {"wamong", among},
      {"wvaramong", w_var_among},
      {"woverlap", w_overlap},
      {"wsum", w_sum},
      {"wvarsum", w_sum},
      {"sregular", regular},
      {"sregulardp", regular},
      {"wregular", regular},
      {"sgrammar", grammar},
      {"sgrammardp", grammar},
      {"max", maximum},
      {"smaxdp", maximum},
      {"MST", spanning_tree},
      {"smstdp", spanning_tree},
      {"clique", clique},
      {"knapsack", knapsack},
      {"knapsackp", knapsack},
      {"knapsackv", knapsack},
      {"wdiverse", diverse},
      {"whdiverse", diverse},
      {"wtdiverse", diverse},
  };
  return table;
}

}  // namespace

void add_global_function(ProblemBuilder& builder, const ProblemText& text, const ProblemToken& keyword,
                         const std::string& name, std::vector<Index> scope, const NextParameter& next) {
  const Call call{builder, text, keyword, name, std::move(scope), next};
  std::vector<std::string> known;
  for (const auto& [word, read] : readers()) {
    if (keyword.is(word)) {
      if (builder.file().maximize && word != "wregular")
        call.fail("cannot be used where the problem is to be maximised; write it as a table, or minimise");
      if (call.scope.empty()) call.fail("is over no variables; it needs at least one");
      return read(call);
    }
    known.push_back(word);
  }
  const std::string remedy = name_remedy(keyword.text, known);
  text.fail(keyword, "the cost function " + ProblemText::name(keyword) + " is not supported; " + remedy +
                         (remedy.ends_with('?') ? " " : ". ") + "Otherwise write it as a table of costs");
}

}  // namespace toposcope
