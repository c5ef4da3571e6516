// SPDX-License-Identifier: BSD-3-Clause

// The project's own format: schemas/problem.schema.json.

#include <algorithm>
#include <map>
#include <stdexcept>

#include "base/errors.h"
#include "base/json_text.h"
#include "base/nearest_name.h"
#include "formats/json_place.h"
#include "formats/problem_formats.h"
#include "toposcope/labeling/make_problem.h"
#include "toposcope/labeling/tools.h"

namespace toposcope {
namespace {

using Json = nlohmann::json;

class JsonReader {
 public:
  JsonReader(const std::string& name, std::string_view text, std::uint64_t memory_budget)
      : memory_budget_(memory_budget), name_(name), text_(text), root_(parse_json<Json>(text, name)) {}

  ProblemFile read() {
    if (!root_.is_object() || !root_.contains("schema") || root_["schema"] != "toposcope.problem/1")
      fail("is no labelling problem: \"schema\" must be \"toposcope.problem/1\"");
    known(root_, {"schema", "name", "constant", "top", "maximize", "variables", "constraints", "candidate_count",
                  "conflicts"});
    ProblemFile file;
    LabelingProblem& problem = file.problem;
    if (root_.contains("name")) problem.name = word(root_, "name");
    if (root_.contains("constant")) problem.constant = number(root_, "constant");
    if (root_.contains("top")) file.top = number(root_, "top");
    if (root_.contains("maximize")) file.maximize = truth(root_, "maximize");
    each(root_, "variables", [&](const Json& node) { read_variable(node, problem); });
    if (root_.contains("constraints"))
      each(root_, "constraints", [&](const Json& node) { read_constraint(node, problem); });
    if (root_.contains("candidate_count")) problem.candidate_count = index(root_, "candidate_count");
    read_conflicts(problem);
    try {
      check(problem);
    } catch (const std::invalid_argument& error) {
      throw UsageError(name_ + ": " + error.what());
    }
    return file;
  }

 private:
  [[noreturn]] void fail(const std::string& message) const {
    throw UsageError(name_ + ":" + json_place(text_, path_) + ": " + message);
  }
  [[noreturn]] void fail_at(JsonStep step, const std::string& message) {
    path_.push_back(std::move(step));
    fail(message);
  }

  void known(const Json& node, const std::vector<std::string>& keys) {
    if (!node.is_object()) fail("expected an object {...}");
    for (const auto& [key, value] : node.items())
      if (std::find(keys.begin(), keys.end(), key) == keys.end())
        fail_at({key}, "unknown key '" + key + "'; " + name_remedy(key, keys));
  }
  const Json& member(const Json& node, const std::string& key) {
    if (!node.contains(key)) fail("'" + key + "' is missing");
    return node[key];
  }
  std::string word(const Json& node, const std::string& key) {
    const Json& value = member(node, key);
    if (!value.is_string()) fail_at({key}, "'" + key + "' must be a text in quotes");
    return value.get<std::string>();
  }
  bool truth(const Json& node, const std::string& key) {
    const Json& value = member(node, key);
    if (!value.is_boolean()) fail_at({key}, "'" + key + "' must be true or false");
    return value.get<bool>();
  }
  double number(const Json& node, const std::string& key) {
    const Json& value = member(node, key);
    if (!value.is_number()) fail_at({key}, "'" + key + "' must be a number");
    return value.get<double>();
  }
  Index index_value(const Json& value, JsonStep step, const std::string& what) {
    if (!value.is_number_unsigned() || value.get<std::uint64_t>() >= no_candidate)
      fail_at(std::move(step), what + " must be a whole number of at least 0");
    return value.get<Index>();
  }
  Index index(const Json& node, const std::string& key) {
    return index_value(member(node, key), {key}, "'" + key + "'");
  }

  template <class Read>
  void each(const Json& node, const std::string& key, const Read& read) {
    const Json& list = member(node, key);
    path_.push_back({key});
    if (!list.is_array()) fail("'" + key + "' must be a list [...]");
    for (std::size_t i = 0; i < list.size(); ++i) {
      path_.push_back({"", i});
      read(list[i]);
      path_.pop_back();
    }
    path_.pop_back();
  }

  // Numbers, and null for what is forbidden.
  template <class Number>
  void read_costs(const Json& node, const std::string& key, std::vector<Number>& costs) {
    const Json& list = member(node, key);
    if (list.is_array()) costs.reserve(list.size());
    each(node, key, [&](const Json& value) {
      if (value.is_number())
        costs.push_back(value.get<Number>());
      else if (value.is_null())
        costs.push_back(std::numeric_limits<Number>::infinity());
      else
        fail("'" + key + "' holds numbers, and null for what is forbidden");
    });
  }

  void read_variable(const Json& node, LabelingProblem& problem) {
    known(node, {"name", "detectability", "optional", "costs", "value_names", "candidates"});
    LabelingVariable variable;
    variable.name = word(node, "name");
    if (node.contains("detectability")) variable.detectability = number(node, "detectability");
    if (node.contains("optional")) variable.optional = truth(node, "optional");
    read_costs(node, "costs", variable.costs);
    if (node.contains("value_names"))
      each(node, "value_names", [&](const Json& value) {
        if (!value.is_string()) fail("'value_names' holds texts in quotes");
        variable.value_names.push_back(value.get<std::string>());
      });
    if (node.contains("candidates"))
      each(node, "candidates", [&](const Json& value) {
        variable.candidates.push_back(index_value(value, {"", 0}, "a candidate"));
      });
    by_name_.emplace(variable.name, static_cast<Index>(problem.variables.size()));
    problem.variables.push_back(std::move(variable));
  }

  void read_constraint(const Json& node, LabelingProblem& problem) {
    known(node, {"name", "scope", "costs", "violations"});
    LabelingConstraint constraint;
    if (node.contains("name")) constraint.name = word(node, "name");
    each(node, "scope", [&](const Json& value) {
      if (value.is_string()) {
        const auto found = by_name_.find(value.get<std::string>());
        if (found == by_name_.end()) fail("there is no variable '" + value.get<std::string>() + "'");
        constraint.scope.push_back(found->second);
        return;
      }
      const Index v = index_value(value, {"", 0}, "a variable");
      if (v >= problem.variables.size())
        fail("there is no variable " + std::to_string(v) + "; the problem has " +
             std::to_string(problem.variables.size()) + ", counted from 0");
      constraint.scope.push_back(v);
    });
    read_costs(node, "costs", constraint.costs);
    if (node.contains("violations")) read_costs(node, "violations", constraint.violations);
    problem.constraints.push_back(std::move(constraint));
  }

  void read_conflicts(LabelingProblem& problem) {
    const Index count = problem.candidate_count;
    if (count > most_candidates)
      fail_at({"candidate_count"}, "'candidate_count' is " + std::to_string(count) + "; at most " +
                                       std::to_string(most_candidates) + " candidates are held in memory");
    const std::uint64_t bytes = std::uint64_t{count} * problem.conflict_words() * sizeof(std::uint64_t);
    if (bytes > memory_budget_)
      fail_at({"candidate_count"}, "the exclusions of " + std::to_string(count) + " candidates need " +
                                       std::to_string(bytes) + " bytes, and a problem may take " +
                                       std::to_string(memory_budget_));
    problem.conflict_bits.assign(count * problem.conflict_words(), 0);
    if (!root_.contains("conflicts")) return;
    each(root_, "conflicts", [&](const Json& pair) {
      if (!pair.is_array() || pair.size() != 2) fail("'conflicts' holds pairs of candidates, [a, b]");
      const auto member = [&](std::size_t i) {
        const Index candidate = index_value(pair[i], {"", i}, "a candidate");
        if (candidate >= count)
          fail_at({"", i}, "there is no candidate " + std::to_string(candidate) + "; 'candidate_count' is " +
                               std::to_string(count));
        return candidate;
      };
      const Index a = member(0), b = member(1);
      set_conflict(problem, a, b);
    });
  }

  static constexpr Index most_candidates = 200'000;  // 5 GB of conflicts
  std::uint64_t memory_budget_;
  const std::string& name_;
  std::string_view text_;
  Json root_;
  std::vector<JsonStep> path_;
  std::map<std::string, Index> by_name_;
};

}  // namespace

ProblemFile read_problem_json(const std::string& name, std::string_view text, std::uint64_t memory_budget) {
  return JsonReader(name, text, memory_budget).read();
}

}  // namespace toposcope
