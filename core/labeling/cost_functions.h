// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "toposcope/labeling.h"

namespace toposcope {

/// One function of a problem whose exclusions are functions too.
struct CostFunction {
  std::string name;
  std::vector<Index> scope;
  const std::vector<double>* costs = nullptr;  ///< null: 0
  bool exclusions = false;                     ///< over two variables: forbidden where their values exclude each other
};

/// Unary costs, constraints and exclusions; exclusions join the first constraint over their two variables.
std::vector<CostFunction> cost_functions(const LabelingProblem& problem);

/// The function's dense table, row-major; `table` is overwritten.
void fill_table(const LabelingProblem& problem, const CostFunction& function, std::vector<double>& table);

/// Least and greatest finite cost; 0 and 0 where all is forbidden.
struct CostRange {
  double least = 0, greatest = 0;
};
CostRange finite_range(const std::vector<double>& table);

/// The entry that most others may equal: the majority where there is one.
double frequent_entry(const std::vector<double>& table);

/// Decimal digits with which all costs are exact, or as many as leave `magnitude` within 15 digits (9 at most).
struct Decimals {
  int digits = 0;
  bool exact = true;
};
/// \throw std::invalid_argument  the magnitude alone has more than 15 digits
Decimals decimals_of(const LabelingProblem& problem, double magnitude);

/// 10 to the power of 0 to 22, exactly.
double power_of_ten(int exponent);

}  // namespace toposcope
