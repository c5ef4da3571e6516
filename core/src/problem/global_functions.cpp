// SPDX-License-Identifier: BSD-3-Clause
// Global cost functions as toulbar2's manual defines them, as costs of tuples.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "problem/problem_builder.h"

namespace toposcope {
namespace {

using Numbers = std::vector<double>;

std::map<Index, double> counts(Tuple tuple) {
  std::map<Index, double> count;
  for (const Index value : tuple) count[value] += 1;
  return count;
}

double by_metric(const std::string& metric, double cost, double deviation, double top) {
  if (deviation <= 0) return 0;
  if (metric == "hard") return top;
  return cost * (metric == "quad" ? deviation * deviation : deviation);
}

GlobalFunction all_different(const GlobalArguments& given, double top) {
  const double cost = given.cost;
  if (given.metric == "var" && cost < top)
    return {[cost](Tuple t) { return cost * static_cast<double>(t.size() - counts(t).size()); }};
  if (given.metric == "dec" || given.metric == "decbi" || given.metric == "var" || given.metric == "hard")
    return {[cost = given.metric == "hard" ? top : cost](Tuple t) { return t[0] == t[1] ? cost : 0; }, "", true};
  return {{}, "measures its violation by '" + given.metric + "', which is not supported; var, dec and hard are"};
}

// numbers: value, lower, upper, ... (wdec: and two weights each)
GlobalFunction cardinality(const GlobalArguments& given) {
  if (given.metric != "var" && given.metric != "dec" && given.metric != "wdec")
    return {{}, "measures its violation by '" + given.metric + "', which is not supported; var, dec and wdec are"};
  return {[given](Tuple t) {
    const auto count = counts(t);
    const std::size_t width = given.metric == "wdec" ? 5 : 3;
    double shortage = 0, excess = 0;
    for (std::size_t k = 0; k + width <= given.numbers.size(); k += width) {
      const auto found = count.find(static_cast<Index>(given.numbers[k]));
      const double n = found == count.end() ? 0 : found->second;
      const bool weighted = width == 5;
      shortage += std::max(0.0, given.numbers[k + 1] - n) * (weighted ? given.numbers[k + 3] : 1);
      excess += std::max(0.0, n - given.numbers[k + 2]) * (weighted ? given.numbers[k + 4] : 1);
    }
    if (given.metric == "var") return given.cost * std::max(shortage, excess);
    return given.metric == "wdec" ? shortage + excess : given.cost * (shortage + excess);
  }};
}

// numbers: lower, upper, values
GlobalFunction among(const GlobalArguments& given, double top) {
  return {[given, top](Tuple t) {
    double n = 0;
    for (const Index value : t)
      n += std::find(given.numbers.begin() + 2, given.numbers.end(), value) != given.numbers.end();
    return by_metric(given.metric, given.cost, std::max(given.numbers[0] - n, n - given.numbers[1]), top);
  }};
}

// numbers: default cost, then position in the scope, value, cost, ...
GlobalFunction maximum(const GlobalArguments& given) {
  return {[given](Tuple t) {
    double most = -std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < t.size(); ++k) {
      double cost = given.numbers[0];
      for (std::size_t i = 1; i + 3 <= given.numbers.size(); i += 3)
        if (given.numbers[i] == static_cast<double>(k) && given.numbers[i + 1] == t[k]) cost = given.numbers[i + 2];
      most = std::max(most, cost);
    }
    return most;
  }};
}

// numbers: positions in the scope of the first half, of the second
GlobalFunction same(const GlobalArguments& given) {
  return {[given](Tuple t) {
    std::map<Index, double> balance;
    for (std::size_t k = 0; k < given.numbers.size(); ++k)
      balance[t[static_cast<std::size_t>(given.numbers[k])]] += k < given.numbers.size() / 2 ? 1 : -1;
    double surplus = 0;
    for (const auto& entry : balance) surplus += std::max(0.0, entry.second);
    return given.cost * surplus;
  }};
}

// numbers: states, starts, the starts, ends, the ends, transitions, from, value, to, ...
GlobalFunction regular(const GlobalArguments& given, double top) {
  if (given.metric != "var")
    return {{}, "measures its violation by '" + given.metric + "', which is not supported; var is"};
  return {[given, top](Tuple t) {
    const Numbers& n = given.numbers;
    const auto states = static_cast<std::size_t>(n[0]);
    const auto starts = static_cast<std::size_t>(n[1]), ends = static_cast<std::size_t>(n[2 + starts]);
    const std::size_t transitions = 4 + starts + ends;
    const double none = std::numeric_limits<double>::infinity();
    std::vector<double> least(states, none), next(states);  // changes to reach a state
    for (std::size_t k = 0; k < starts; ++k) least[static_cast<std::size_t>(n[2 + k])] = 0;
    for (const Index value : t) {
      std::fill(next.begin(), next.end(), none);
      for (std::size_t k = transitions; k + 3 <= n.size(); k += 3) {
        double& to = next[static_cast<std::size_t>(n[k + 2])];
        to = std::min(to, least[static_cast<std::size_t>(n[k])] + (n[k + 1] == value ? 0 : 1));
      }
      std::swap(least, next);
    }
    double changes = none;
    for (std::size_t k = 0; k < ends; ++k)
      changes = std::min(changes, least[static_cast<std::size_t>(n[3 + starts + k])]);
    return changes == none ? top : given.cost * changes;
  }};
}

// numbers: capacity, weights
GlobalFunction knapsack(const GlobalArguments& given, double top) {
  return {[given, top](Tuple t) {
    double sum = 0;
    for (std::size_t k = 0; k < t.size(); ++k) sum += given.numbers[k + 1] * t[k];
    return sum >= given.numbers[0] ? 0 : top;
  }};
}

// numbers: constant, delta. x (comparator) y + constant, up to delta at a price of one a unit
GlobalFunction comparison(const std::string& sign, const GlobalArguments& given, double top) {
  return {[sign, given, top](Tuple t) {
    const double x = t[0], y = t[1] + given.numbers[0];
    const double lack = sign == ">="   ? y - x
                        : sign == ">"  ? y + 1 - x
                        : sign == "<=" ? x - y
                        : sign == "<"  ? x + 1 - y
                                       : std::abs(x - y);
    return lack <= 0 ? 0.0 : lack <= given.numbers[1] ? lack : top;
  }};
}

// numbers: constants of x and y, then the penalty; or values at infinity and their costs
GlobalFunction disjunction(const GlobalArguments& given, double top) {
  return {[given, top](Tuple t) {
    const Numbers& n = given.numbers;
    const double x = t[0], y = t[1];
    const bool apart = x >= y + n[1] || y >= x + n[0];
    if (n.size() == 3) return apart ? 0.0 : n[2];
    const bool free = apart || x == n[2] || y == n[3];
    return free ? (x == n[2] ? n[4] : 0.0) + (y == n[3] ? n[5] : 0.0) : top;
  }};
}

}  // namespace

GlobalFunction global_function(const std::string& name, const std::vector<Index>& scope, const GlobalArguments& given,
                               double top) {
  const bool comparator = name == ">=" || name == ">" || name == "<=" || name == "<" || name == "=";
  const bool pair = comparator || name == "disj" || name == "sdisj";
  if (pair && scope.size() != 2) return {{}, "is over two variables, not " + std::to_string(scope.size())};
  const std::size_t needed = comparator                             ? 2
                             : name == "disj"                       ? 3
                             : name == "sdisj"                      ? 6
                             : name == "max"                        ? 1
                             : name == "samong" || name == "wamong" ? 2
                             : name == "sregular"                   ? 4
                             : name == "knapsack"                   ? scope.size() + 1
                                                                    : 0;
  if (given.numbers.size() < needed) return {{}, "has too few parameters"};
  if (name == "salldiff") return all_different(given, top);
  if (name == "walldiff" && given.metric == "hard") return all_different(given, top);
  if (name == "sgcc") return cardinality(given);
  if (name == "samong" || name == "wamong") return among(given, top);
  if (name == "max") return maximum(given);
  if (name == "ssame") return same(given);
  if (name == "sregular") return regular(given, top);
  if (name == "knapsack") return knapsack(given, top);
  if (comparator) return comparison(name, given, top);
  if (pair) return disjunction(given, top);
  return {{},
          "is not supported; supported are salldiff, walldiff hard, sgcc, samong, wamong, max, ssame, sregular, "
          "knapsack, <, <=, >, >=, =, disj and sdisj"};
}

}  // namespace toposcope
