// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "cost_functions.h"
#include "toposcope/labeling/problem_writer.h"
#include "toposcope/labeling/tools.h"

namespace toposcope {
namespace {

class WcspWriter {
 public:
  WcspWriter(const LabelingProblem& problem, double upper_bound)
      : problem_(problem), functions_(cost_functions(problem)) {
    find_scale(upper_bound);
  }

  WrittenProblem write() {
    Index widest = 0;
    for (const LabelingVariable& variable : problem_.variables) widest = std::max(widest, variable.domain());
    const double constant = std::round((problem_.constant + std::max(0.0, -problem_.constant)) * scale_);
    made_.text = name() + " " + std::to_string(problem_.variables.size()) + " " + std::to_string(widest) + " " +
                 std::to_string(functions_.size() + (constant > 0 ? 1 : 0)) + " " + integer(top_) + "\n";
    for (const LabelingVariable& variable : problem_.variables) made_.text += std::to_string(variable.domain()) + " ";
    made_.text += '\n';
    if (constant > 0) made_.text += "0 " + integer(constant) + " 0\n";
    for (std::size_t i = 0; i < functions_.size(); ++i) function(functions_[i], shifts_[i]);
    return std::move(made_);
  }

 private:
  // The name says what the file cannot: how its costs stand to the problem's.
  std::string name() const {
    std::string made;
    for (const char c : problem_.name) made += static_cast<unsigned char>(c) <= ' ' ? '_' : c;
    if (made.empty()) made = "problem";
    if (made_.decimals > 0) made += ":cost*10^" + std::to_string(made_.decimals);
    if (made_.shift > 0) made += (made_.decimals > 0 ? "+" : ":cost+") + integer(made_.shift * scale_);
    return made;
  }

  void find_scale(double upper_bound) {
    double greatest = std::max(0.0, problem_.constant);
    made_.shift = std::max(0.0, -problem_.constant);
    for (const CostFunction& each : functions_) {
      fill_table(problem_, each, table_);
      const CostRange range = finite_range(table_);
      shifts_.push_back(std::max(0.0, -range.least));
      made_.shift += shifts_.back();
      greatest += range.greatest + shifts_.back();
    }
    const Decimals decimals = decimals_of(problem_, greatest + 1 + made_.shift);
    made_.decimals = decimals.digits;
    made_.exact = decimals.exact;
    scale_ = power_of_ten(decimals.digits);
    // Each function's rounding may add one half.
    top_ = std::ceil(greatest * scale_ + 1 + (decimals.exact ? 0 : static_cast<double>(functions_.size())));
    if (upper_bound < forbidden) top_ = std::max(0.0, std::min(top_, std::ceil((upper_bound + made_.shift) * scale_)));
  }

  std::string integer(double value) const { return std::to_string(static_cast<long long>(std::round(value))); }
  std::string cost(double value, double shift) const {
    return value < forbidden ? integer((value + shift) * scale_) : integer(top_);
  }

  void function(const CostFunction& function, double shift) {
    fill_table(problem_, function, table_);
    const double frequent = frequent_entry(table_);
    const auto others = std::count_if(table_.begin(), table_.end(), [&](double each) { return each != frequent; });
    made_.text += std::to_string(function.scope.size());
    for (const Index v : function.scope) made_.text += " " + std::to_string(v);
    made_.text += " " + cost(frequent, shift) + " " + std::to_string(others) + "\n";
    std::vector<Index> digits(function.scope.size(), 0);
    for (const double each : table_) {
      if (each != frequent) {
        for (const Index value : digits) made_.text += std::to_string(value) + " ";
        made_.text += cost(each, shift) + "\n";
      }
      for (std::size_t k = digits.size(); k-- > 0;) {
        if (++digits[k] < problem_.variables[function.scope[k]].domain()) break;
        digits[k] = 0;
      }
    }
  }

  const LabelingProblem& problem_;
  std::vector<CostFunction> functions_;
  std::vector<double> shifts_, table_;
  WrittenProblem made_;
  double scale_ = 1, top_ = 1;
};

}  // namespace

WrittenProblem write_wcsp(const LabelingProblem& problem, double upper_bound) {
  check(problem);
  return WcspWriter(problem, upper_bound).write();
}

}  // namespace toposcope
