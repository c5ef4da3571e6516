// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <limits>
#include <memory>

#include "functions/function_families.h"
#include "toposcope/labeling/tools.h"

namespace toposcope::intension {
namespace {

CostFunction equal_pair(double cost) {
  return [cost](std::span<const Index> v) { return v[0] == v[1] ? cost : 0.0; };
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

double sum_of(std::span<const Index> v) {
  double sum = 0;
  for (const Index value : v) sum += value;
  return sum;
}

}  // namespace

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

}  // namespace toposcope::intension
