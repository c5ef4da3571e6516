// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "functions/function_families.h"
#include "toposcope/labeling/tools.h"

namespace toposcope::intension {

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

}  // namespace toposcope::intension
