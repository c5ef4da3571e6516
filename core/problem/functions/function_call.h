// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "functions/global_costs.h"
#include "functions/global_functions.h"

namespace toposcope::intension {

inline constexpr std::int64_t most_parameter = std::int64_t{1} << 40;

/// Parameters of one function while they are read.
struct Call {
  ProblemBuilder& builder;
  const ProblemText& text;
  ProblemToken keyword;
  std::string name;
  std::vector<Index> scope;
  const NextParameter& next;

  std::int64_t integer(std::string_view what, std::int64_t least = -most_parameter,
                       std::int64_t greatest = most_parameter) const {
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
    const std::int64_t variable = text.integer(at, what, 0, most_parameter);
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

}  // namespace toposcope::intension
