// SPDX-License-Identifier: BSD-3-Clause
// toulbar2's .cfn: JSON in which commas, colons and quotes may be left out and '#' begins a comment.

#include <algorithm>
#include <map>
#include <utility>

#include "base/errors.h"
#include "problem/problem_builder.h"
#include "problem/problem_formats.h"
#include "problem/problem_words.h"

namespace toposcope {
namespace {

struct Node {
  enum class Kind { scalar, list, object } kind = Kind::scalar;
  std::string text;
  std::vector<Node> items;
  std::vector<std::pair<std::string, Node>> members;
  std::size_t line = 0;

  const Node* find(std::string_view name) const {
    for (const auto& member : members)
      if (member.first == name) return &member.second;
    return nullptr;
  }
};

class CfnParser {
 public:
  CfnParser(const std::string& where, std::string_view text) : where_(where), text_(text) {}

  Node parse() {
    Node root = value(0);
    if (!token().empty()) fail("more follows after the problem's closing bracket");
    return root;
  }

 private:
  [[noreturn]] void fail(const std::string& message) const {
    throw UsageError(where_ + ":" + std::to_string(line_) + ": " + message);
  }

  std::string_view token() {
    constexpr std::string_view skipped = " \t\r\n,:";
    constexpr std::string_view brackets = "{}[]";
    while (at_ < text_.size()) {
      if (text_[at_] == '#')
        while (at_ < text_.size() && text_[at_] != '\n') ++at_;
      else if (skipped.find(text_[at_]) != skipped.npos)
        line_ += text_[at_++] == '\n';
      else
        break;
    }
    quoted_ = false;
    if (at_ == text_.size()) return {};
    const std::size_t begin = at_;
    if (brackets.find(text_[at_]) != brackets.npos) return text_.substr(at_++, 1);
    if (text_[at_] == '"') {
      const std::size_t end = text_.find('"', at_ + 1);
      if (end == text_.npos) fail("a quote is not closed");
      quoted_ = true;
      at_ = end + 1;
      return text_.substr(begin + 1, end - begin - 1);
    }
    while (at_ < text_.size() && skipped.find(text_[at_]) == skipped.npos && brackets.find(text_[at_]) == brackets.npos)
      ++at_;
    return text_.substr(begin, at_ - begin);
  }

  Node value(int depth) { return value(token(), depth); }
  Node value(std::string_view first, int depth) {
    Node node;
    node.line = line_;
    if (depth > 16) fail("brackets are nested too deeply");
    if (first.empty() && !quoted_) fail("the file ends within the problem; it is cut short");
    if (!quoted_ && (first == "}" || first == "]")) fail("'" + std::string(first) + "' stands where a value should");
    if (!quoted_ && first == "{") {
      node.kind = Node::Kind::object;
      for (std::string_view key = token(); quoted_ || key != "}"; key = token()) {
        if (key.empty() && !quoted_) fail("the file ends within the problem; it is cut short");
        if (!quoted_ && (key == "{" || key == "[" || key == "]")) fail("a name should stand here");
        std::string name(key);
        node.members.emplace_back(std::move(name), value(depth + 1));
      }
    } else if (!quoted_ && first == "[") {
      node.kind = Node::Kind::list;
      for (std::string_view next = token(); quoted_ || next != "]"; next = token())
        node.items.push_back(value(next, depth + 1));
    } else {
      node.text = std::string(first);
    }
    return node;
  }

  const std::string& where_;
  std::string_view text_;
  std::size_t at_ = 0, line_ = 1;
  bool quoted_ = false;
};

class CfnReader {
 public:
  explicit CfnReader(const std::string& where) : where_(where) {}

  ProblemFile read(const Node& root) {
    header(need(root, "problem", Node::Kind::object));
    for (const auto& [name, domain] : need(root, "variables", Node::Kind::object).members) variable(name, domain);
    for (const auto& [name, given] : need(root, "functions", Node::Kind::object).members) function(name, given);
    return std::move(file_);
  }

 private:
  [[noreturn]] void fail(const Node& node, const std::string& message) const {
    throw UsageError(where_ + ":" + std::to_string(node.line) + ": " + message);
  }
  const Node& need(const Node& node, const char* name, Node::Kind kind) const {
    const Node* found = node.find(name);
    if (!found) fail(node, std::string("'") + name + "' is missing");
    if (found->kind != kind) fail(*found, std::string("'") + name + "' is of the wrong kind");
    return *found;
  }
  double number(const Node& node) const {
    double value = 0;
    if (node.kind != Node::Kind::scalar || !parse_number(node.text, value))
      fail(node, "'" + node.text + "' stands where a number should");
    return value;
  }

  void header(const Node& problem) {
    if (const Node* name = problem.find("name")) file_.problem.name = name->text;
    const Node& bound = need(problem, "mustbe", Node::Kind::scalar);
    if (bound.text.empty() || bound.text[0] != '<')
      fail(bound, "'mustbe: " + bound.text + "': only '<' is supported; to maximise, negate all costs and write '<'");
    if (!parse_number(std::string_view(bound.text).substr(1), file_.top))
      fail(bound, "'mustbe: " + bound.text + "' must be '<' and a number");
  }

  void variable(const std::string& name, const Node& domain) {
    if (variables_.count(name)) fail(domain, "variable '" + name + "' is given twice");
    variables_[name] = static_cast<Index>(file_.problem.variables.size());
    if (domain.kind == Node::Kind::list) {
      if (domain.items.empty()) fail(domain, "variable '" + name + "' has no values");
      add_variable(file_.problem, name, static_cast<Index>(domain.items.size()));
      for (const Node& value : domain.items) file_.problem.variables.back().value_names.push_back(value.text);
      return;
    }
    const double size = number(domain);
    if (!(size >= 1 && size <= 1e6))
      fail(domain,
           "variable '" + name + "' must have a list of values or their number, 1 to 1000000, not " + domain.text);
    add_variable(file_.problem, name, static_cast<Index>(size));
  }

  Index variable_of(const Node& node) const {
    if (const auto found = variables_.find(node.text); found != variables_.end()) return found->second;
    double index = 0;
    if (parse_number(node.text, index) && index >= 0 && index < static_cast<double>(variables_.size()))
      return static_cast<Index>(index);
    fail(node, "'" + node.text + "' is no variable of the problem");
  }
  Index value_of(Index v, const Node& node) const {
    const LabelingVariable& variable = file_.problem.variables[v];
    const auto named = std::find(variable.value_names.begin(), variable.value_names.end(), node.text);
    if (named != variable.value_names.end()) return static_cast<Index>(named - variable.value_names.begin());
    double index = 0;
    if (parse_number(node.text, index) && index >= 0 && index < variable.domain()) return static_cast<Index>(index);
    fail(node, "'" + node.text + "' is no value of variable '" + variable.name + "'");
  }

  void function(const std::string& name, const Node& given) {
    if (given.kind == Node::Kind::scalar) return add_table(file_, name, {}, {number(given)});
    std::vector<Index> scope;
    for (const Node& item : need(given, "scope", Node::Kind::list).items) {
      scope.push_back(variable_of(item));
      if (std::count(scope.begin(), scope.end(), scope.back()) > 1)
        fail(item, "variable '" + item.text + "' stands twice in the scope of '" + name + "'");
    }
    if (const Node* type = given.find("type")) return global(name, type->text, scope, given);
    const Node* listed = given.find("costs");
    if (!listed) fail(given, "function '" + name + "' has no costs");
    if (listed->kind == Node::Kind::scalar && !scope.empty()) {
      const auto shared = tables_.find(listed->text);
      if (shared == tables_.end()) fail(*listed, "'" + listed->text + "' is no function above");
      if (table_size(file_.problem, scope) != shared->second.size())
        fail(*listed, "the costs of '" + listed->text + "' do not fit the domains of '" + name + "'");
      return add_table(file_, name, scope, shared->second);
    }
    const auto entries = table_size(file_.problem, scope);
    if (!entries)
      fail(given, "function '" + name + "' needs a table of over " + std::to_string(most_entries) +
                      " entries, which is not supported");
    std::vector<double> costs(*entries, 0);
    if (const Node* base = given.find("defaultcost")) {
      std::fill(costs.begin(), costs.end(), number(*base));
      if (listed->items.size() % (scope.size() + 1) != 0)
        fail(*listed, "the costs of '" + name + "' must be tuples of " + std::to_string(scope.size()) +
                          " values and a cost, as it has a 'defaultcost'");
      for (std::size_t k = 0; k < listed->items.size();) {
        std::size_t entry = 0;
        for (const Index v : scope)
          entry = entry * file_.problem.variables[v].domain() + value_of(v, listed->items[k++]);
        costs[entry] = number(listed->items[k++]);
      }
    } else {
      if (listed->items.size() != costs.size())
        fail(*listed, "function '" + name + "' has " + std::to_string(listed->items.size()) +
                          " costs; its scope needs " + std::to_string(costs.size()));
      for (std::size_t k = 0; k < costs.size(); ++k) costs[k] = number(listed->items[k]);
    }
    tables_[name] = costs;
    add_table(file_, name, scope, std::move(costs));
  }

  void global(const std::string& name, const std::string& type, const std::vector<Index>& scope, const Node& given) {
    const Node& parameters = need(given, "params", Node::Kind::object);
    GlobalArguments arguments;
    if (const Node* metric = parameters.find("metric")) arguments.metric = metric->text;
    if (const Node* cost = parameters.find("cost")) arguments.cost = number(*cost);
    const auto append = [&](const char* parameter) { flatten(need_any(parameters, parameter), arguments); };
    if (type == "max") {
      append("defaultcost");
      append("tuples");
    } else if (type == "sgcc") {
      append("bounds");
    } else if (type == "samong" || type == "wamong") {
      append("min");
      append("max");
      append("values");
    } else if (type == "sregular") {
      append("nb_states");
      for (const char* part : {"starts", "ends", "transitions"}) {
        const Node& list = need(parameters, part, Node::Kind::list);
        arguments.numbers.push_back(static_cast<double>(list.items.size()));
        flatten(list, arguments);
      }
    } else if (type == "knapsack") {
      append("capacity");
      append("weights");
    } else if (type == "ssame") {
      for (const char* part : {"vars1", "vars2"})
        for (const Node& item : need(parameters, part, Node::Kind::list).items) {
          const auto at = std::find(scope.begin(), scope.end(), variable_of(item));
          if (at == scope.end()) fail(item, "'" + item.text + "' is not in the scope of '" + name + "'");
          arguments.numbers.push_back(static_cast<double>(at - scope.begin()));
        }
    }
    if (const std::string why = add_global(file_, type, scope, arguments); !why.empty())
      fail(given, "function '" + name + "': the global function '" + type + "' " + why);
  }

  const Node& need_any(const Node& node, const char* name) const {
    const Node* found = node.find(name);
    if (!found) fail(node, std::string("'") + name + "' is missing");
    return *found;
  }
  void flatten(const Node& node, GlobalArguments& arguments) const {
    if (node.kind == Node::Kind::scalar) return arguments.numbers.push_back(number(node));
    for (const Node& item : node.items) flatten(item, arguments);
  }

  const std::string& where_;
  ProblemFile file_;
  std::map<std::string, Index> variables_;
  std::map<std::string, std::vector<double>> tables_;
};

}  // namespace

ProblemFile read_cfn(const std::string& where, std::string_view text) {
  return CfnReader(where).read(CfnParser(where, text).parse());
}

}  // namespace toposcope
