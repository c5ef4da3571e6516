// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "reading/problem_file.h"
#include "reading/problem_text.h"

namespace toposcope {

/// Tables in extension may be this large, those made of a function in intension that. Entries of 8 bytes.
inline constexpr std::size_t most_table_entries = std::size_t{1} << 27;
inline constexpr std::size_t most_tabulated_entries = std::size_t{1} << 22;

/// Cost of the values of a scope, in its order; infinite where forbidden.
using CostFunction = std::function<double(std::span<const Index> values)>;

/// Adds the functions of a file to a problem. Only the sum of all costs is held against the file's bound; an entry that
/// reaches it whatever the other functions give is forbidden (in a file without negative costs: from the bound on). The
/// least that the others may give is known at the file's end, so functions in intension wait for `finish`.
class ProblemBuilder {
 public:
  /// \param memory_budget  bytes that all tables together may take
  ProblemBuilder(const ProblemText& text, std::uint64_t memory_budget) : text_(text), memory_budget_(memory_budget) {}

  ProblemFile& file() { return file_; }
  LabelingProblem& problem() { return file_.problem; }
  const LabelingProblem& problem() const { return file_.problem; }
  Index domain(Index variable) const { return file_.problem.variables[variable].domain(); }

  void add_variable(const ProblemToken& at, std::string name, std::int64_t domain,
                    std::vector<std::string> value_names = {});

  /// The cost, to be minimised, of a value that stands in the file.
  double cost(double value) const { return file_.maximize ? 0 - value : value; }

  /// \throw UsageError  a variable twice
  void check_scope(const ProblemToken& at, std::span<const Index> scope) const;
  /// Asked before a table is made or copied: it is counted from here on.
  /// \return entries of the dense table \throw UsageError  more than `most`, or all tables more than the budget
  std::size_t table_size(const ProblemToken& at, std::span<const Index> scope, std::size_t most);

  /// Adds a dense table of costs (of `cost()`), row-major. Without scope it is added to the constant, with one variable
  /// to the variable's own costs.
  void add_table(const ProblemToken& at, std::string name, std::vector<Index> scope, std::vector<double> costs);

  /// Adds the table of a function in intension. \throw UsageError  it would be too large
  void tabulate(const ProblemToken& at, std::string name, std::vector<Index> scope, const CostFunction& function);

  /// The same for every pair of the scope: exact for functions that are sums over pairs.
  void tabulate_pairs(const ProblemToken& at, const std::string& name, std::span<const Index> scope,
                      const CostFunction& function);

  /// Adds to the problem at the end of the file. \param negative  it may have negative costs
  void later(bool negative, std::function<void()> add) { (negative ? first_ : last_).push_back(std::move(add)); }
  /// While functions wait are added: this cost is as good as forbidden.
  bool hard(double cost) const { return cost >= threshold_; }

  /// To be called once, at the end of the file.
  ProblemFile finish();

 private:
  void find_threshold();
  void take(const ProblemToken& at, std::size_t entries);

  const ProblemText& text_;
  std::uint64_t memory_budget_, taken_ = 0;  ///< bytes
  ProblemFile file_;
  std::vector<std::function<void()>> first_, last_;
  double threshold_ = std::numeric_limits<double>::infinity();
};

}  // namespace toposcope
