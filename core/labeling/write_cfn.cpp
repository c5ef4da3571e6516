// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <set>

#include "cost_functions.h"
#include "toposcope/labeling/problem_writer.h"
#include "toposcope/labeling/tools.h"

namespace toposcope {
namespace {

/// Makes names that the format allows and that differ from each other.
class Names {
 public:
  std::string add(const std::string& wanted, const std::string& fallback) {
    std::string name;
    for (const char c : wanted) {
      const bool bad =
          static_cast<unsigned char>(c) <= ' ' || std::string_view("\":,{}[]/#").find(c) != std::string_view::npos;
      name += bad ? '_' : c;
    }
    if (name.empty()) name = fallback;
    if (std::string_view("0123456789+-.<>").find(name[0]) != std::string_view::npos) name.insert(0, "_");
    std::string unique = name;
    for (int i = 2; !used_.insert(unique).second; ++i) unique = name + "_" + std::to_string(i);
    return unique;
  }

 private:
  std::set<std::string> used_;
};

class CfnWriter {
 public:
  CfnWriter(const LabelingProblem& problem, double upper_bound, bool maximize, const std::function<bool()>& stop)
      : problem_(problem), sign_(maximize ? -1 : 1), stop_(stop), functions_(cost_functions(problem)) {
    find_bounds(upper_bound);
  }

  WrittenProblem write() {
    made_.text += R"({"problem": {"name": ")" + Names().add(problem_.name, "problem") + R"(", "mustbe": ")" +
                  (sign_ < 0 ? ">" : "<");
    number(top_);
    made_.text += "\"},\n\"variables\": {";
    for (Index v = 0; v < problem_.variables.size(); ++v) variable(v);
    made_.text += "\n},\n\"functions\": {";
    if (problem_.constant != 0) {
      made_.text += "\n\"" + function_names_.add("constant", "") + "\": {\"scope\": [], \"costs\": [";
      number(problem_.constant);
      made_.text += "]}";
    }
    for (const CostFunction& each : functions_) {
      if (stopped()) break;
      function(each);
    }
    made_.text += "\n}\n}\n";
    return std::move(made_);
  }

 private:
  // Every labelling of finite cost costs less than the top. A forbidden entry reaches it whatever else is gained.
  void find_bounds(double upper_bound) {
    double greatest = problem_.constant, gain = std::min(0.0, problem_.constant);
    std::vector<double> table;
    for (const CostFunction& each : functions_) {
      if (stopped()) return;
      fill_table(problem_, each, table);
      const CostRange range = finite_range(table);
      greatest += range.greatest;
      gain += std::min(0.0, range.least);
    }
    const Decimals decimals = decimals_of(problem_, std::abs(greatest) + 1 - gain);
    made_.decimals = decimals.digits;
    made_.exact = decimals.exact;
    const double scale = power_of_ten(decimals.digits);
    const auto up = [scale](double value) {
      const double nearest = std::round(value * scale);
      return (nearest / scale == value ? nearest : std::ceil(value * scale)) / scale;
    };
    top_ = up(std::min(greatest + 1, upper_bound));
    // What is gained is written rounded.
    const double margin = gain < 0 ? static_cast<double>(functions_.size() + 2) / scale : 0;
    forbidden_ = up(std::max(0.0, top_ - gain + margin));
  }

  void number(double cost) {
    cost = sign_ * (cost < forbidden ? cost : forbidden_);
    std::array<char, 400> buffer{};
    const char* end =
        std::to_chars(buffer.data(), buffer.data() + buffer.size(), cost, std::chars_format::fixed, made_.decimals).ptr;
    const char* first = buffer.data();
    if (*first == '-' && std::all_of(first + 1, end, [](char c) { return c == '0' || c == '.'; })) ++first;
    made_.text.append(first, end);
  }

  bool stopped() const { return stop_ && stop_(); }

  void separate(bool& first) {
    if (!first) made_.text += ',';
    first = false;
  }

  void variable(Index v) {
    const LabelingVariable& variable = problem_.variables[v];
    separate(first_variable_);
    variables_.push_back(variable_names_.add(variable.name, "x" + std::to_string(v)));
    made_.text += "\n\"" + variables_.back() + "\": ";
    if (variable.value_names.empty() && !variable.optional) {
      made_.text += std::to_string(variable.domain());
      return;
    }
    Names names;
    made_.text += '[';
    for (Index value = 0; value < variable.domain(); ++value) {
      const std::string fallback = variable.missing(value) ? "missing" : "c" + std::to_string(value);
      if (value > 0) made_.text += ", ";
      made_.text +=
          '"' + names.add(variable.value_names.empty() ? fallback : variable.value_names[value], fallback) + '"';
    }
    made_.text += ']';
  }

  void function(const CostFunction& function) {
    fill_table(problem_, function, table_);
    separate(first_function_);
    made_.text += "\n\"" + function_names_.add(function.name, "f") + "\": {\"scope\": [";
    for (std::size_t i = 0; i < function.scope.size(); ++i)
      made_.text += (i > 0 ? ", \"" : "\"") + variables_[function.scope[i]] + '"';
    made_.text += ']';
    const double frequent = frequent_entry(table_);
    const auto others = static_cast<std::size_t>(
        std::count_if(table_.begin(), table_.end(), [&](double cost) { return cost != frequent; }));
    // toulbar2 1.1 gets dense tables of four variables and more wrong where their least cost is not 0.
    const bool sparse = function.scope.size() > 3 || others * (function.scope.size() + 1) < table_.size();
    if (sparse) {
      made_.text += ", \"defaultcost\": ";
      number(frequent);
    }
    made_.text += ", \"costs\": [";
    std::vector<Index> digits(function.scope.size(), 0);
    bool first = true;
    for (const double cost : table_) {
      if (!sparse || cost != frequent) {
        separate(first);
        if (sparse)
          for (const Index value : digits) made_.text += std::to_string(value) + ',';
        number(cost);
      }
      for (std::size_t k = digits.size(); k-- > 0;) {
        if (++digits[k] < problem_.variables[function.scope[k]].domain()) break;
        digits[k] = 0;
      }
    }
    made_.text += "]}";
  }

  const LabelingProblem& problem_;
  double sign_;
  const std::function<bool()>& stop_;
  std::vector<CostFunction> functions_;
  WrittenProblem made_;
  double top_ = 0, forbidden_ = 0;
  Names variable_names_, function_names_;
  std::vector<std::string> variables_;
  std::vector<double> table_;
  bool first_variable_ = true, first_function_ = true;
};

}  // namespace

WrittenProblem write_cfn(const LabelingProblem& problem, double upper_bound, bool maximize,
                         const std::function<bool()>& stop) {
  check(problem);
  return CfnWriter(problem, upper_bound, maximize, stop).write();
}

}  // namespace toposcope
