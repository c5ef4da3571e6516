// SPDX-License-Identifier: BSD-3-Clause

// Weighted CSP format of toulbar2: words separated by white space, see docs/guide/problems.md.

#include <limits>

#include "formats/problem_formats.h"
#include "functions/global_functions.h"

namespace toposcope {
namespace {

class WcspReader {
 public:
  WcspReader(const std::string& name, std::string_view bytes, std::uint64_t memory_budget)
      : text_(name, bytes, {}), builder_(text_, memory_budget) {}

  ProblemFile read() {
    const std::int64_t functions = header();
    std::int64_t read = 0;
    for (; read < functions && !text_.peek().end; ++read) function(read);
    // As toulbar2: the number in the first line may be wrong.
    if (read < functions)
      warn(text_.peek(), "ends after " + std::to_string(read) + " of " + std::to_string(functions) + " cost functions");
    else if (const ProblemToken rest = text_.peek(); !rest.end)
      warn(rest, "goes on after its " + std::to_string(functions) + " cost functions; the rest was not read");
    return builder_.finish();
  }

 private:
  // A table in extension that others may use again.
  struct Shared {
    std::vector<Index> domains;
    std::vector<double> costs;
  };

  void warn(const ProblemToken& at, const std::string& what) {
    builder_.file().warnings.push_back(text_.file() + ":" + std::to_string(at.line) + ": the file " + what);
  }

  std::int64_t header() {
    builder_.problem().name = text_.need("the problem's name").text;
    const std::int64_t variables = text_.need_integer("the number of variables", 0, most_variables);
    text_.need_integer("the greatest domain size", 0, std::numeric_limits<std::int64_t>::max());
    const std::int64_t functions = text_.need_integer("the number of cost functions", 0, most_variables);
    builder_.file().top = text_.need_number("the upper bound of the costs");
    for (std::int64_t v = 0; v < variables; ++v) {
      const ProblemToken at = text_.need("a domain size");
      // A negative size is an interval of values from 0.
      const std::int64_t size = text_.integer(at, "a domain size", -most_variables, most_variables);
      builder_.add_variable(at, "x" + std::to_string(v), std::abs(size));
    }
    return functions;
  }

  void function(std::int64_t number) {
    const ProblemToken at = text_.need("the arity of a cost function");
    const std::int64_t signed_arity = text_.integer(at, "the arity of a cost function", -most_arity, most_arity);
    const bool shared = signed_arity < 0;
    std::vector<Index> scope;
    for (std::int64_t i = 0; i < std::abs(signed_arity); ++i) scope.push_back(variable());
    builder_.check_scope(at, scope);
    const ProblemToken default_at = text_.need("the default cost");
    const double default_cost = text_.number(default_at, "the default cost (or -1 for a function in intension)");
    std::string name = "f" + std::to_string(number);
    if (default_cost == -1) {
      if (shared) text_.fail(at, "only functions in extension can be shared; give the arity without '-'");
      const ProblemToken keyword = text_.need("the keyword of a cost function in intension");
      add_global_function(builder_, text_, keyword, name, std::move(scope),
                          [this](std::string_view what) { return text_.need(what); });
      return;
    }
    extension(at, default_at, default_cost, shared, std::move(name), std::move(scope));
  }

  void extension(const ProblemToken& at, const ProblemToken& default_at, double default_cost, bool shared,
                 std::string name, std::vector<Index> scope) {
    if (default_cost < 0) text_.fail(default_at, "costs of .wcsp are not negative; use .cfn for negative costs");
    const ProblemToken count_at = text_.need("the number of tuples");
    const std::int64_t count =
        text_.integer(count_at, "the number of tuples", -most_variables, static_cast<std::int64_t>(most_table_entries));
    Shared table;
    for (const Index v : scope) table.domains.push_back(builder_.domain(v));
    if (count < 0) {
      const auto used = static_cast<std::size_t>(-count - 1);
      if (used >= shared_.size() || shared_[used].domains != table.domains)
        text_.fail(count_at, "number " + std::to_string(-count) +
                                 " of the shared cost functions is not defined before, or has other domain sizes; "
                                 "shared functions count from 1 in the order of the file");
      builder_.table_size(at, scope, most_table_entries);
      table.costs = shared_[used].costs;
    } else {
      table.costs.assign(builder_.table_size(at, scope, most_table_entries), builder_.cost(default_cost));
      for (std::int64_t t = 0; t < count; ++t) tuple(scope, table.costs);
    }
    if (shared) {
      builder_.table_size(at, scope, most_table_entries);
      shared_.push_back(table);
    }
    builder_.add_table(at, std::move(name), std::move(scope), std::move(table.costs));
  }

  void tuple(const std::vector<Index>& scope, std::vector<double>& costs) {
    std::size_t entry = 0;
    for (const Index v : scope)
      entry = entry * builder_.domain(v) +
              static_cast<std::size_t>(text_.need_integer("a value of variable " + std::to_string(v), 0,
                                                          static_cast<std::int64_t>(builder_.domain(v)) - 1));
    const ProblemToken at = text_.need("a cost");
    const double cost = text_.number(at, "a cost");
    if (cost < 0) text_.fail(at, "costs of .wcsp are not negative; use .cfn for negative costs");
    costs[entry] = builder_.cost(cost);
  }

  Index variable() {
    const auto count = static_cast<std::int64_t>(builder_.problem().variables.size());
    return static_cast<Index>(text_.need_integer("the index of a variable", 0, count - 1));
  }

  static constexpr std::int64_t most_variables = 1 << 30, most_arity = 1 << 20;
  ProblemText text_;
  ProblemBuilder builder_;
  std::vector<Shared> shared_;
};

}  // namespace

ProblemFile read_wcsp(const std::string& name, std::string_view text, std::uint64_t memory_budget) {
  return WcspReader(name, text, memory_budget).read();
}

}  // namespace toposcope
