// SPDX-License-Identifier: BSD-3-Clause
// toulbar2's .wcsp: name, variables, largest domain, functions, top; domains; functions as tuples or by keyword.

#include <algorithm>
#include <charconv>

#include "problem/problem_builder.h"
#include "problem/problem_formats.h"
#include "problem/problem_words.h"

namespace toposcope {
namespace {

constexpr std::int64_t most = 1'000'000;

class WcspReader {
 public:
  WcspReader(const std::string& where, std::string_view text) : words_(where, text) {}

  ProblemFile read() {
    file_.problem.name = std::string(words_.need("the problem's name"));
    const std::int64_t variables = words_.integer("the number of variables", 0, most);
    words_.integer("the largest domain", 0, most);
    const std::int64_t functions = words_.integer("the number of functions", 0, most * 100);
    file_.top = words_.number("the top cost");
    for (std::int64_t v = 0; v < variables; ++v) add_variable(file_.problem, "x" + std::to_string(v), domain());
    for (std::int64_t f = 0; f < functions; ++f) function("f" + std::to_string(f));
    if (!words_.at_end()) words_.fail("more follows after the last function; the number of functions is wrong");
    return std::move(file_);
  }

 private:
  // A negative size is an interval's, of which solvers may keep the ends alone.
  Index domain() {
    const std::int64_t size = words_.integer("the size of a domain", -most, most);
    if (size == 0) words_.fail("the size of a domain must not be 0");
    return static_cast<Index>(std::abs(size));
  }

  void function(const std::string& name) {
    const std::int64_t signed_arity = words_.integer("the arity of a function", -most, most);
    const auto arity = static_cast<std::size_t>(std::abs(signed_arity));
    std::vector<Index> scope;
    for (std::size_t k = 0; k < arity; ++k) {
      scope.push_back(
          static_cast<Index>(words_.integer("a variable of a function", 0, std::ssize(file_.problem.variables) - 1)));
      if (std::count(scope.begin(), scope.end(), scope.back()) > 1)
        words_.fail("variable " + std::to_string(scope.back()) + " stands twice in a scope");
    }
    const double base = words_.number("a function's default cost");
    if (base == -1 && arity > 0) return global(scope);
    const std::int64_t tuples = words_.integer("a function's number of tuples", -most, most * 1000);
    if (arity == 0) return add_table(file_, name, {}, {base});
    if (tuples < 0) return share(name, scope, static_cast<std::size_t>(-tuples));
    const auto entries = table_size(file_.problem, scope);
    if (!entries)
      words_.fail("a function over " + std::to_string(arity) + " variables needs a table of over " +
                  std::to_string(most_entries) + " entries, which is not supported");
    std::vector<double> costs(*entries, base);
    for (std::int64_t t = 0; t < tuples; ++t) {
      std::size_t entry = 0;
      for (const Index v : scope) {
        const Index domain = file_.problem.variables[v].domain();
        entry = entry * domain + static_cast<std::size_t>(words_.integer("a value of a tuple", 0, domain - 1));
      }
      costs[entry] = words_.number("a tuple's cost");
    }
    if (signed_arity < 0) shared_.push_back(costs);
    add_table(file_, name, scope, std::move(costs));
  }

  void share(const std::string& name, const std::vector<Index>& scope, std::size_t number) {
    if (number > shared_.size())
      words_.fail("shared function " + std::to_string(number) + " is named before it is given");
    if (table_size(file_.problem, scope) != shared_[number - 1].size())
      words_.fail("shared function " + std::to_string(number) + " does not fit the domains of this scope");
    add_table(file_, name, scope, shared_[number - 1]);
  }

  void append(GlobalArguments& given, std::int64_t count, const char* what) {
    for (std::int64_t k = 0; k < count; ++k) given.numbers.push_back(words_.number(what));
  }
  std::int64_t count(const char* what) { return words_.integer(what, 0, most); }

  void global(const std::vector<Index>& scope) {
    const std::string name(words_.need("the name of a global function"));
    GlobalArguments given;
    const auto metric = [&] {
      given.metric = std::string(words_.need("a violation measure"));
      given.cost = words_.number("a cost of violation");
    };
    if (name == "salldiff" || name == "walldiff") {
      metric();
    } else if (name == "sgcc") {
      metric();
      append(given, count("a number of values") * (given.metric == "wdec" ? 5 : 3), "a bound");
    } else if (name == "samong" || name == "wamong") {
      metric();
      std::vector<double> bounds;
      if (name == "samong")
        for (int k = 0; k < 2; ++k) bounds.push_back(words_.number("a bound"));
      append(given, count("a number of values"), "a value");
      if (name == "wamong")
        for (int k = 0; k < 2; ++k) bounds.push_back(words_.number("a bound"));
      given.numbers.insert(given.numbers.begin(), bounds.begin(), bounds.end());
    } else if (name == "ssame") {
      given.cost = words_.number("a cost of violation");
      const std::int64_t first = count("the size of a list"), second = count("the size of a list");
      for (std::int64_t k = 0; k < first + second; ++k) {
        const auto v = static_cast<Index>(count("a variable"));
        const auto at = std::find(scope.begin(), scope.end(), v);
        if (at == scope.end())
          words_.fail("'ssame' lists variable " + std::to_string(v) + ", which is not in its scope");
        given.numbers.push_back(static_cast<double>(at - scope.begin()));
      }
      if (first != second) words_.fail("'ssame' with lists of different sizes is not supported");
    } else if (name == "sregular") {
      metric();
      append(given, 1, "a number of states");
      for (int part = 0; part < 2; ++part) {
        const std::int64_t states = count("a number of states");
        given.numbers.push_back(static_cast<double>(states));
        for (std::int64_t k = 0; k < states; ++k)
          given.numbers.push_back(
              static_cast<double>(words_.integer("a state", 0, static_cast<std::int64_t>(given.numbers[0]) - 1)));
      }
      const std::int64_t transitions = count("a number of transitions");
      given.numbers.push_back(static_cast<double>(transitions));
      for (std::int64_t k = 0; k < 3 * transitions; ++k)
        given.numbers.push_back(static_cast<double>(words_.integer(
            "a part of a transition", 0, k % 3 == 1 ? most : static_cast<std::int64_t>(given.numbers[0]) - 1)));
    } else if (name == "max") {
      append(given, 1, "a default cost");
      const std::int64_t tuples = count("a number of tuples");
      for (std::int64_t k = 0; k < tuples; ++k) {
        const auto v = static_cast<Index>(count("a variable"));
        const auto at = std::find(scope.begin(), scope.end(), v);
        if (at == scope.end()) words_.fail("'max' lists variable " + std::to_string(v) + ", which is not in its scope");
        given.numbers.push_back(static_cast<double>(at - scope.begin()));
        append(given, 2, "a value or cost");
      }
    } else if (name == "knapsack") {
      append(given, 1 + std::ssize(scope), "a weight");
    } else if (name == "disj" || name == "sdisj") {
      append(given, name == "disj" ? 3 : 6, "a parameter");
    } else if (name == ">=" || name == ">" || name == "<=" || name == "<" || name == "=") {
      append(given, 2, "a parameter");
    }
    if (const std::string why = add_global(file_, name, scope, given); !why.empty())
      words_.fail("the global function '" + name + "' " + why);
  }

  ProblemWords words_;
  ProblemFile file_;
  std::vector<std::vector<double>> shared_;
};

}  // namespace

ProblemFile read_wcsp(const std::string& where, std::string_view text) {
  return WcspReader(where, text).read();
}

}  // namespace toposcope
