// SPDX-License-Identifier: BSD-3-Clause
#include "problem/global_functions.h"

#include <algorithm>
#include <array>
#include <limits>
#include <memory>
#include <utility>

#include "base/nearest_name.h"
#include "problem/global_costs.h"
#include "toposcope/labeling_tools.h"

namespace toposcope {
namespace {

constexpr std::int64_t most = std::int64_t{1} << 40;

/// Parameters of one function while they are read.
struct Call {
  ProblemBuilder& builder;
  const ProblemText& text;
  ProblemToken keyword;
  std::string name;
  std::vector<Index> scope;
  const NextParameter& next;

  std::int64_t integer(std::string_view what, std::int64_t least = -most, std::int64_t greatest = most) const {
    return text.integer(next(what), what, least, greatest);
  }
  Index index(std::string_view what, std::int64_t greatest = std::int64_t{1} << 30) const {
    return static_cast<Index>(integer(what, 0, greatest));
  }
  double cost(std::string_view what = "a cost") const {
    const ProblemToken at = next(what);
    const double value = text.number(at, what);
    if (value < 0)
      text.fail(at, std::string(what) + " of '" + std::string(keyword.text) + "' is negative: it must be at least 0");
    return value;
  }
  std::string choice(std::string_view what, const std::vector<std::string>& choices) const {
    const ProblemToken at = next(what);
    std::string all;
    for (const std::string& each : choices) {
      if (at.is(each)) return each;
      all += (all.empty() ? "" : ", ") + each;
    }
    text.fail(at, std::string(what) + " of '" + std::string(keyword.text) + "' is " + ProblemText::name(at) +
                      "; supported are " + all);
  }
  Measure measure(bool hard_only = false) const {
    const std::string word = choice("the measure", hard_only ? std::vector<std::string>{"hard"}
                                                             : std::vector<std::string>{"hard", "lin", "var", "quad"});
    return word == "hard" ? Measure::hard : word == "quad" ? Measure::quadratic : Measure::linear;
  }
  std::string comparator() const { return choice("the comparator", {"==", "!=", "<", "<=", ">", ">="}); }
  std::size_t position(std::string_view what) const {
    const ProblemToken at = next(what);
    const std::int64_t variable = text.integer(at, what, 0, most);
    const auto found = std::find(scope.begin(), scope.end(), variable);
    if (found == scope.end())
      text.fail(at, "variable " + std::string(at.text) + " is not in the scope of '" + std::string(keyword.text) + "'");
    return static_cast<std::size_t>(found - scope.begin());
  }
  /// One more than the greatest value of any variable.
  Index values() const {
    Index greatest = 0;
    for (const Index v : scope) greatest = std::max(greatest, builder.domain(v));
    return greatest;
  }
  [[noreturn]] void fail(const std::string& message) const {
    text.fail(keyword, "'" + std::string(keyword.text) + "' " + message);
  }
  void arity(std::size_t wanted) const {
    if (scope.size() != wanted)
      fail("is over " + std::to_string(scope.size()) + " variables; it needs " + std::to_string(wanted));
  }

  /// Tables are made at the end of the file.
  void tabulate(CostFunction function, bool negative = false) const {
    builder.later(negative, [at = keyword, this_name = name, this_scope = scope, &b = builder,
                             f = std::move(function)] { b.tabulate(at, this_name, this_scope, f); });
  }
  void tabulate_pairs(CostFunction function) const {
    builder.later(false, [at = keyword, this_name = name, this_scope = scope, &b = builder, f = std::move(function)] {
      b.tabulate_pairs(at, this_name, this_scope, f);
    });
  }
};

CostFunction equal_pair(double cost) {
  return [cost](std::span<const Index> v) { return v[0] == v[1] ? cost : 0.0; };
}

// Values as numbers: x >= y + constant, with what is missing as cost, up to `most_missing`.
void arithmetic(const Call& call) {
  call.arity(2);
  const std::string op(call.keyword.text);
  const double constant = static_cast<double>(call.integer("the constant"));
  const double most_missing = call.text.number(call.next("the threshold"), "the threshold");
  call.tabulate([op, constant, most_missing](std::span<const Index> v) {
    const double x = v[0], y = v[1];
    double gap = 0;
    if (op == ">=") gap = y + constant - x;
    if (op == ">") gap = y + constant + 1 - x;
    if (op == "<=") gap = x - constant - y;
    if (op == "<") gap = x - constant + 1 - y;
    if (op == "=") gap = std::max(y + constant - x, x - constant - y);
    return gap <= 0 ? 0 : gap <= most_missing ? gap : forbidden;
  });
}

void disjunction(const Call& call) {
  call.arity(2);
  const double after_x = static_cast<double>(call.integer("the first constant"));
  const double after_y = static_cast<double>(call.integer("the second constant"));
  const auto apart = [after_x, after_y](double x, double y) { return x >= y + after_y || y >= x + after_x; };
  if (call.keyword.is("disj")) {
    const double penalty = call.cost("the penalty");
    call.tabulate([apart, penalty](std::span<const Index> v) { return apart(v[0], v[1]) ? 0 : penalty; });
    return;
  }
  const std::int64_t last_x = call.integer("the first variable's last value");
  const std::int64_t last_y = call.integer("the second variable's last value");
  const double cost_x = call.cost(), cost_y = call.cost();
  call.tabulate([=](std::span<const Index> v) {
    if (v[0] > last_x || v[1] > last_y) return forbidden;
    if (v[0] < last_x && v[1] < last_y && !apart(v[0], v[1])) return forbidden;
    return (v[0] == last_x ? cost_x : 0) + (v[1] == last_y ? cost_y : 0);
  });
}

void all_different(const Call& call) {
  const std::string word(call.keyword.text);
  const std::string metric = word == "salldiff"     ? call.choice("the measure", {"var", "dec", "decbi"})
                             : word == "salldiffdp" ? call.choice("the measure", {"var"})
                                                    : call.choice("the measure", {"hard"});
  const double cost = call.cost();
  if (word == "salldiffkp") return call.tabulate_pairs(equal_pair(forbidden));
  if (metric != "var") return call.tabulate_pairs(equal_pair(cost));
  const auto counts = std::make_shared<ValueCounts>(call.values());
  const CostFunction count_repeats = [counts, cost](std::span<const Index> v) {
    double repeats = 0;
    for (const Index n : counts->of(v)) repeats += n > 1 ? n - 1 : 0;
    return repeats * cost;
  };
  call.builder.later(false,
                     [at = call.keyword, name = call.name, scope = call.scope, &b = call.builder, cost, count_repeats] {
                       if (b.hard(cost))
                         b.tabulate_pairs(at, name, scope, equal_pair(forbidden));
                       else
                         b.tabulate(at, name, scope, count_repeats);
                     });
}

void w_all_different(const Call& call) {
  const Measure measure = call.measure();
  const double cost = call.cost();
  const auto counts = std::make_shared<ValueCounts>(call.values());
  const CostFunction count = [counts, cost, measure](std::span<const Index> v) {
    double sum = 0;
    for (const Index n : counts->of(v)) sum += violation_cost(measure, cost, n > 1 ? n - 1 : 0);
    return sum;
  };
  call.builder.later(false, [at = call.keyword, name = call.name, scope = call.scope, &b = call.builder, cost, count] {
    if (b.hard(cost))
      b.tabulate_pairs(at, name, scope, equal_pair(forbidden));
    else
      b.tabulate(at, name, scope, count);
  });
}

/// Bounds by value; values that are not named may occur at will.
std::vector<Occurrence> read_bounds(const Call& call, double cost, bool weights) {
  const Occurrence free = {0, std::numeric_limits<Index>::max(), cost, cost};
  std::vector<Occurrence> bounds(call.values(), free);
  std::vector<bool> given(bounds.size(), false);
  const Index count = call.index("the number of values");
  for (Index i = 0; i < count; ++i) {
    const ProblemToken at = call.next("a value");
    const auto value = static_cast<std::size_t>(call.text.integer(at, "a value", 0, 1 << 24));
    if (value >= bounds.size()) {
      bounds.resize(value + 1, free);
      given.resize(value + 1, false);
    }
    if (given[value]) call.text.fail(at, "value " + std::to_string(value) + " has its bounds twice; keep one of them");
    given[value] = true;
    Occurrence& bound = bounds[value];
    bound.lower = call.index("a lower bound");
    const ProblemToken upper = call.next("an upper bound");
    bound.upper = static_cast<Index>(call.text.integer(upper, "an upper bound", bound.lower, 1 << 30));
    if (weights) {
      bound.shortage = call.cost("a shortage's cost");
      bound.excess = call.cost("an excess's cost");
    }
  }
  return bounds;
}

double shortage(const Occurrence& bound, Index n) {
  return n < bound.lower ? bound.lower - n : 0;
}
double excess(const Occurrence& bound, Index n) {
  return n > bound.upper ? n - bound.upper : 0;
}
double miss(const Occurrence& bound, Index n) {
  return std::max(shortage(bound, n), excess(bound, n));
}

void cardinality(const Call& call) {
  const bool dp = call.keyword.is("sgccdp");
  const std::string metric =
      call.choice("the measure", dp ? std::vector<std::string>{"var"} : std::vector<std::string>{"var", "dec", "wdec"});
  const double cost = call.cost();
  const std::vector<Occurrence> bounds = read_bounds(call, cost, metric == "wdec");
  const auto counts = std::make_shared<ValueCounts>(static_cast<Index>(bounds.size()));
  // sgccdp is the sum over the values, whatever its measure is called.
  const bool by_variable = metric == "var" && !dp;
  double least = 0, greatest = 0;
  for (const Occurrence& bound : bounds) {
    least += bound.lower;
    greatest += bound.upper;
  }
  const auto n = static_cast<double>(call.scope.size());
  const bool never = by_variable && (least > n || greatest < n);
  call.tabulate([=](std::span<const Index> v) {
    const std::vector<Index>& occurs = counts->of(v);
    double too_few = 0, too_many = 0, sum = 0;
    for (std::size_t value = 0; value < bounds.size(); ++value) {
      too_few += shortage(bounds[value], occurs[value]);
      too_many += excess(bounds[value], occurs[value]);
      sum += shortage(bounds[value], occurs[value]) * bounds[value].shortage +
             excess(bounds[value], occurs[value]) * bounds[value].excess;
    }
    return never ? forbidden : by_variable ? std::max(too_few, too_many) * cost : sum;
  });
}

void w_cardinality(const Call& call) {
  const Measure measure = call.measure();
  const double cost = call.cost();
  const std::vector<Occurrence> bounds = read_bounds(call, cost, false);
  const auto counts = std::make_shared<ValueCounts>(static_cast<Index>(bounds.size()));
  call.tabulate([=](std::span<const Index> v) {
    const std::vector<Index>& occurs = counts->of(v);
    double sum = 0;
    for (std::size_t value = 0; value < bounds.size(); ++value)
      sum += violation_cost(measure, cost, miss(bounds[value], occurs[value]));
    return sum;
  });
}

void same(const Call& call) {
  const double cost = call.cost();
  std::array<std::vector<std::size_t>, 2> sides;
  const Index first = call.index("the first list's size"), second = call.index("the second list's size");
  if (first != second)
    call.fail("has lists of " + std::to_string(first) + " and " + std::to_string(second) +
              " variables; they must be of one size");
  for (auto& side : sides)
    for (Index i = 0; i < first; ++i) side.push_back(call.position("a variable of a list"));
  const auto differences = std::make_shared<std::vector<double>>(call.values());
  call.tabulate([=](std::span<const Index> v) {
    std::fill(differences->begin(), differences->end(), 0);
    for (const std::size_t i : sides[0]) ++(*differences)[v[i]];
    for (const std::size_t i : sides[1]) --(*differences)[v[i]];
    double sum = 0;
    for (const double d : *differences) sum += std::max(d, 0.0);
    return sum * cost;
  });
}

void w_same(const Call& call) {
  const Measure measure = call.measure();
  const double cost = call.cost();
  if (call.scope.size() % 2 != 0) call.fail("is over an odd number of variables; it compares two lists of one size");
  const bool bounded = call.keyword.is("wsamegcc");
  const std::vector<Occurrence> bounds = bounded ? read_bounds(call, cost, false) : std::vector<Occurrence>();
  const Index values = std::max(call.values(), static_cast<Index>(bounds.size()));
  const auto left = std::make_shared<ValueCounts>(values), right = std::make_shared<ValueCounts>(values);
  call.tabulate([=](std::span<const Index> v) {
    const std::vector<Index>& a = left->of(v.subspan(0, v.size() / 2));
    const std::vector<Index>& b = right->of(v.subspan(v.size() / 2));
    double sum = 0;
    for (std::size_t value = 0; value < a.size(); ++value)
      sum += violation_cost(measure, cost, a[value] > b[value] ? a[value] - b[value] : b[value] - a[value]);
    for (std::size_t value = 0; value < bounds.size(); ++value)
      sum += violation_cost(measure, cost, miss(bounds[value], a[value])) +
             violation_cost(measure, cost, miss(bounds[value], b[value]));
    return sum;
  });
}

std::vector<bool> read_values(const Call& call) {
  std::vector<bool> in(call.values(), false);
  const Index count = call.index("the number of values");
  for (Index i = 0; i < count; ++i)
    if (const Index value = call.index("a value"); value < in.size()) in[value] = true;
  return in;
}

Index occurrences(const std::vector<bool>& in, std::span<const Index> v) {
  Index n = 0;
  for (const Index value : v) n += in[value] ? 1 : 0;
  return n;
}

void among(const Call& call) {
  const bool w = call.keyword.is("wamong");
  if (!w) call.choice("the measure", {"var"});
  const Measure measure = w ? call.measure() : Measure::linear;
  const double cost = call.cost();
  Occurrence bound;
  const auto read_limits = [&] {
    bound.lower = call.index("the lower bound");
    bound.upper = call.index("the upper bound");
    if (bound.upper < bound.lower)
      call.fail("has lower bound " + std::to_string(bound.lower) + " above upper bound " + std::to_string(bound.upper));
  };
  if (!w) read_limits();
  const std::vector<bool> in = read_values(call);
  if (w) read_limits();
  call.tabulate(
      [=](std::span<const Index> v) { return violation_cost(measure, cost, miss(bound, occurrences(in, v))); });
}

void w_var_among(const Call& call) {
  call.measure(true);
  const double cost = call.cost();
  const std::vector<bool> in = read_values(call);
  call.tabulate(
      [=](std::span<const Index> v) { return occurrences(in, v.first(v.size() - 1)) == v.back() ? 0 : cost; });
}

void w_overlap(const Call& call) {
  const Measure measure = call.measure();
  const double cost = call.cost();
  const std::string comparator = call.comparator();
  const double right = static_cast<double>(call.integer("the right-hand side"));
  if (call.scope.size() % 2 != 0) call.fail("is over an odd number of variables; it compares two lists of one size");
  call.tabulate([=](std::span<const Index> v) {
    double overlaps = 0;
    for (std::size_t i = 0; i < v.size() / 2; ++i) overlaps += v[i] != 0 && v[i] == v[i + v.size() / 2] ? 1 : 0;
    return violation_cost(measure, cost, comparison_gap(comparator, overlaps, right));
  });
}

double sum_of(std::span<const Index> v) {
  double sum = 0;
  for (const Index value : v) sum += value;
  return sum;
}

void w_sum(const Call& call) {
  const bool variable = call.keyword.is("wvarsum");
  const Measure measure = call.measure();
  const double cost = call.cost();
  const std::string comparator = call.comparator();
  const double constant = variable ? 0 : static_cast<double>(call.integer("the right-hand side"));
  call.tabulate([=](std::span<const Index> v) {
    const double gap = variable ? comparison_gap(comparator, sum_of(v.first(v.size() - 1)), v.back())
                                : comparison_gap(comparator, sum_of(v), constant);
    return violation_cost(measure, cost, gap);
  });
}

void read_states(const Call& call, Index states, bool costs, std::vector<Transition>& list) {
  const Index count = call.index("the number of states in a list");
  for (Index i = 0; i < count; ++i) {
    Transition state{.from = call.index("a state", static_cast<std::int64_t>(states) - 1)};
    if (costs) state.cost = call.builder.cost(call.text.number(call.next("a state's cost"), "a state's cost"));
    list.push_back(state);
  }
}

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

void maximum(const Call& call) {
  const double default_cost = call.cost("the default cost");
  std::vector<std::vector<double>> costs;
  for (const Index v : call.scope) costs.emplace_back(call.builder.domain(v), default_cost);
  const Index count = call.index("the number of tuples");
  for (Index i = 0; i < count; ++i) {
    std::vector<double>& own = costs[call.position("a variable")];
    const Index value = call.index("a value", static_cast<std::int64_t>(own.size()) - 1);
    own[value] = call.cost();
  }
  call.tabulate([costs](std::span<const Index> v) {
    double greatest = 0;
    for (std::size_t i = 0; i < v.size(); ++i) greatest = std::max(greatest, costs[i][v[i]]);
    return greatest;
  });
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

// At most one variable takes one of its listed values.
void clique(const Call& call) {
  call.integer("the right-hand side", 1, 1);
  std::vector<std::vector<bool>> in;
  for (const Index v : call.scope) {
    in.emplace_back(call.builder.domain(v), false);
    const Index count = call.index("the number of values");
    for (Index i = 0; i < count; ++i)
      in.back()[call.index("a value", static_cast<std::int64_t>(in.back().size()) - 1)] = true;
  }
  call.builder.later(
      false, [in = std::move(in), at = call.keyword, name = call.name, scope = call.scope, &b = call.builder] {
        for (std::size_t i = 0; i < scope.size(); ++i)
          for (std::size_t j = i + 1; j < scope.size(); ++j)
            b.tabulate(at, name + "_" + std::to_string(i) + "_" + std::to_string(j), {scope[i], scope[j]},
                       [&](std::span<const Index> v) { return in[i][v[0]] && in[j][v[1]] ? forbidden : 0.0; });
      });
}

// The weights of the values taken sum up to the capacity at least.
void knapsack(const Call& call) {
  const double capacity = static_cast<double>(call.integer("the capacity"));
  std::vector<std::vector<double>> weights;
  for (const Index v : call.scope) weights.emplace_back(call.builder.domain(v), 0);
  const auto value_of = [&](std::size_t i) {
    return call.index("a value", static_cast<std::int64_t>(weights[i].size()) - 1);
  };
  if (call.keyword.is("knapsackv")) {
    const Index count = call.index("the number of weights");
    for (Index k = 0; k < count; ++k) {
      const std::size_t i = call.position("a variable");
      const Index value = value_of(i);
      weights[i][value] = static_cast<double>(call.integer("a weight"));
    }
  } else {
    for (std::size_t i = 0; i < weights.size(); ++i) {
      if (call.keyword.is("knapsack") && weights[i].size() != 2)
        call.fail("is over variables of two values; variable " + std::to_string(call.scope[i]) + " has " +
                  std::to_string(weights[i].size()));
      const Index count = call.keyword.is("knapsackp") ? call.index("the number of values") : 1;
      for (Index k = 0; k < count; ++k) {
        const Index value = call.keyword.is("knapsackp") ? value_of(i) : 1;
        weights[i][value] = static_cast<double>(call.integer("a weight"));
      }
    }
  }
  call.tabulate([=](std::span<const Index> v) {
    double sum = 0;
    for (std::size_t i = 0; i < v.size(); ++i) sum += weights[i][v[i]];
    return sum >= capacity ? 0.0 : forbidden;
  });
}

// At least so many variables differ from the values given.
void diverse(const Call& call) {
  const Index distance = call.index("the distance");
  std::vector<Index> values;
  for (std::size_t i = 0; i < call.scope.size(); ++i) values.push_back(call.index("a value"));
  if (distance == call.scope.size()) {  // each by itself
    call.builder.later(false, [=, at = call.keyword, name = call.name, scope = call.scope, &b = call.builder] {
      for (std::size_t i = 0; i < scope.size(); ++i)
        b.tabulate(at, name, {scope[i]}, [&](std::span<const Index> v) { return v[0] == values[i] ? forbidden : 0.0; });
    });
    return;
  }
  call.tabulate([=](std::span<const Index> v) {
    Index different = 0;
    for (std::size_t i = 0; i < v.size(); ++i) different += v[i] != values[i] ? 1 : 0;
    return different >= distance ? 0.0 : forbidden;
  });
}

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
