// SPDX-License-Identifier: BSD-3-Clause
#include <memory>
#include <utility>

#include "functions/function_families.h"
#include "toposcope/labeling/tools.h"

namespace toposcope::intension {
namespace {

void read_states(const Call& call, Index states, bool costs, std::vector<Transition>& list) {
  const Index count = call.index("the number of states in a list");
  for (Index i = 0; i < count; ++i) {
    Transition state{.from = call.index("a state", static_cast<std::int64_t>(states) - 1)};
    if (costs) state.cost = call.builder.cost(call.text.number(call.next("a state's cost"), "a state's cost"));
    list.push_back(state);
  }
}

}  // namespace

void regular(const Call& call) {
  const bool weighted = call.keyword.is("wregular");
  const bool dp = call.keyword.is("sregulardp");
  const bool edit = !weighted && call.choice("the measure", dp ? std::vector<std::string>{"var"}
                                                               : std::vector<std::string>{"var", "edit"}) == "edit";
  const double substitution = weighted ? forbidden : call.cost();
  Automaton automaton;
  automaton.states = call.index("the number of states", 1 << 20);
  if (automaton.states == 0) call.fail("has no states; it needs at least one");
  const std::int64_t last = static_cast<std::int64_t>(automaton.states) - 1;
  read_states(call, automaton.states, weighted, automaton.starts);
  read_states(call, automaton.states, weighted, automaton.ends);
  const Index count = call.index("the number of transitions");
  for (Index i = 0; i < count; ++i) {
    Transition step{
        .from = call.index("a state", last), .symbol = call.index("a value"), .to = call.index("a state", last)};
    if (weighted) step.cost = call.builder.cost(call.text.number(call.next("a transition's cost"), "a cost"));
    automaton.transitions.push_back(step);
  }
  call.tabulate([cost = std::make_shared<RegularCost>(std::move(automaton), substitution, edit)](
                    std::span<const Index> v) { return (*cost)(v); },
                weighted);
}

void grammar(const Call& call) {
  const bool weighted = call.choice("the measure", {"var", "weight"}) == "weight";
  const double substitution = call.cost();
  Grammar rules;
  rules.symbols = call.index("the number of symbols", 1 << 16);
  call.index("the number of values");
  const std::int64_t last = static_cast<std::int64_t>(rules.symbols) - 1;
  rules.start = call.index("the start symbol", last);
  const Index count = call.index("the number of rules");
  for (Index i = 0; i < count; ++i) {
    const Index kind = call.index("the kind of a rule", 3);
    const Index from = call.index("a symbol", last);
    if (kind == 0 || kind == 2) {
      Grammar::Terminal rule{from, call.index("a value"), 0};
      if (kind == 2) rule.cost = call.cost("a rule's cost");
      if (!weighted) rule.cost = 0;
      rules.terminals.push_back(rule);
    } else {
      Grammar::Production rule{from, call.index("a symbol", last), call.index("a symbol", last), 0};
      if (kind == 3) rule.cost = call.cost("a rule's cost");
      if (!weighted) rule.cost = 0;
      rules.productions.push_back(rule);
    }
  }
  // What a substitution is where a symbol does both, toulbar2's documentation does not say.
  if (!weighted)
    for (const Grammar::Terminal& rule : rules.terminals)
      for (const Grammar::Production& production : rules.productions)
        if (production.from == rule.from)
          call.fail("with measure 'var' needs symbols that either stand for values or are produced; symbol " +
                    std::to_string(rule.from) + " does both. Give the values a symbol of their own");
  call.tabulate([cost = std::make_shared<GrammarCost>(std::move(rules), weighted ? forbidden : substitution)](
                    std::span<const Index> v) { return (*cost)(v); });
}

void spanning_tree(const Call& call) {
  for (std::size_t i = 0; i < call.scope.size(); ++i) {
    if (call.scope[i] != i)
      call.fail("is supported over the variables 0, 1, 2, ... in this order only, where index and position agree");
    if (call.builder.domain(call.scope[i]) > call.scope.size())
      call.fail("has a variable with more values than there are variables; a value is the index of the parent");
  }
  call.tabulate([](std::span<const Index> v) { return is_spanning_tree(v) ? 0.0 : forbidden; });
}

}  // namespace toposcope::intension
