// SPDX-License-Identifier: BSD-3-Clause
// The project's own format: loses nothing. What is forbidden is written as null.

#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "formats/problem_formats.h"

namespace toposcope {
namespace {

class Writer {
 public:
  std::string write(const ProblemFile& file) {
    const LabelingProblem& problem = file.problem;
    text_ = "{\n\"schema\": \"toposcope.problem/1\",\n\"name\": ";
    quoted(problem.name);
    if (problem.constant != 0) field(",\n\"constant\": ", problem.constant);
    if (file.top < infinite) field(",\n\"top\": ", file.top);
    if (file.maximize) text_ += ",\n\"maximize\": true";
    text_ += ",\n\"variables\": [";
    for (std::size_t v = 0; v < problem.variables.size(); ++v) {
      text_ += v > 0 ? ",\n" : "\n";
      variable(problem.variables[v]);
    }
    text_ += "\n],\n\"constraints\": [";
    for (std::size_t c = 0; c < problem.constraints.size(); ++c) {
      text_ += c > 0 ? ",\n" : "\n";
      constraint(problem.constraints[c]);
    }
    text_ += "\n]";
    if (problem.candidate_count > 0) conflicts(problem);
    text_ += "\n}\n";
    return std::move(text_);
  }

 private:
  static constexpr double infinite = std::numeric_limits<double>::infinity();

  void quoted(const std::string& word) {
    text_ += nlohmann::json(word).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  }

  // The shortest that reads back the same.
  template <class Number>
  void number(Number value) {
    if constexpr (std::is_floating_point_v<Number>)
      if (!std::isfinite(value)) {
        text_ += "null";
        return;
      }
    if constexpr (std::is_floating_point_v<Number>)
      if (value == 0 && std::signbit(value)) {  // "-0" would be read as a whole number
        text_ += "-0.0";
        return;
      }
    std::array<char, 32> buffer{};
    text_.append(buffer.data(), std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr);
  }

  template <class Number>
  void field(const char* key, Number value) {
    text_ += key;
    number(value);
  }

  template <class Number>
  void list(const char* key, const std::vector<Number>& numbers) {
    text_ += key;
    text_ += '[';
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      if (i > 0) text_ += ',';
      number(numbers[i]);
    }
    text_ += ']';
  }

  void variable(const LabelingVariable& variable) {
    text_ += "{\"name\": ";
    quoted(variable.name);
    if (variable.detectability != 1) field(", \"detectability\": ", variable.detectability);
    if (!variable.optional) text_ += ", \"optional\": false";
    if (!variable.value_names.empty()) {
      text_ += ", \"value_names\": [";
      for (std::size_t i = 0; i < variable.value_names.size(); ++i) {
        if (i > 0) text_ += ',';
        quoted(variable.value_names[i]);
      }
      text_ += ']';
    }
    list(", \"costs\": ", variable.costs);
    if (!variable.candidates.empty()) list(", \"candidates\": ", variable.candidates);
    text_ += '}';
  }

  void constraint(const LabelingConstraint& constraint) {
    text_ += "{\"name\": ";
    quoted(constraint.name);
    list(", \"scope\": ", constraint.scope);
    list(", \"costs\": ", constraint.costs);
    if (!constraint.violations.empty()) list(", \"violations\": ", constraint.violations);
    text_ += '}';
  }

  void conflicts(const LabelingProblem& problem) {
    text_ += ",\n\"candidate_count\": " + std::to_string(problem.candidate_count) + ",\n\"conflicts\": [";
    bool first = true;
    for (Index a = 0; a < problem.candidate_count; ++a)
      for (Index b = a; b < problem.candidate_count; ++b) {
        if (!problem.conflict(a, b)) continue;
        text_ += first ? "\n[" : ",[";
        text_ += std::to_string(a) + "," + std::to_string(b) + "]";
        first = false;
      }
    text_ += "\n]";
  }

  std::string text_;
};

}  // namespace

std::string problem_json(const ProblemFile& file) {
  return Writer().write(file);
}

}  // namespace toposcope
