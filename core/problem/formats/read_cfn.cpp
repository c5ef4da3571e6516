// SPDX-License-Identifier: BSD-3-Clause

// Cost function network format of toulbar2: JSON with freedoms, see docs/guide/problems.md.

#include <map>
#include <optional>
#include <unordered_map>

#include "formats/cfn_parameters.h"
#include "formats/problem_formats.h"
#include "functions/global_functions.h"

namespace toposcope {
namespace {

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}
bool begins_number(std::string_view word) {
  return !word.empty() && (is_digit(word[0]) || word[0] == '-' || word[0] == '+' || word[0] == '.');
}

class CfnReader {
 public:
  CfnReader(const std::string& name, std::string_view bytes, std::uint64_t memory_budget)
      : text_(name, bytes, {":,", "{}[]", true, true}), builder_(text_, memory_budget) {}

  ProblemFile read() {
    need_open(text_, "the problem");
    // Without the first tag there are no tags at all.
    tagged_ = text_.peek().is("problem");
    header();
    tag("variables");
    need_open(text_, "the variables");
    while (!closes(text_.peek())) variable();
    text_.next();
    tag("functions");
    need_open(text_, "the functions");
    while (!closes(text_.peek())) function();
    text_.next();
    // As toulbar2: what follows is not looked at.
    if (closes(text_.peek())) text_.next();
    if (const ProblemToken rest = text_.peek(); !rest.end)
      builder_.file().warnings.push_back(text_.file() + ":" + std::to_string(rest.line) +
                                         ": the file goes on after the problem; the rest was not read");
    share();
    return builder_.finish();
  }

 private:
  // Where the table of a function is; that of one variable is kept.
  struct Table {
    std::vector<Index> scope;
    std::size_t constraint = 0;
    std::vector<double> costs;
  };
  struct Sharing {
    ProblemToken of;
    std::string name;
    std::vector<Index> scope;
  };

  void tag(std::string_view name) {
    if (!tagged_) return;
    const ProblemToken token = text_.need("'" + std::string(name) + "'");
    if (!token.is(name))
      text_.fail(token, "expected '" + std::string(name) + "' but found " + ProblemText::name(token) +
                            "; fields have a fixed order");
  }

  void header() {
    tag("problem");
    need_open(text_, "the problem's name and bound");
    tag("name");
    builder_.problem().name = text_.need("the problem's name").text;
    tag("mustbe");
    ProblemToken bound = text_.need("the bound ('<' or '>' and a number)");
    if (bound.end || bound.text.empty() || (bound.text[0] != '<' && bound.text[0] != '>'))
      text_.fail(bound, "the bound is " + ProblemText::name(bound) +
                            "; it must be '<' (minimise) or '>' (maximise) followed at once by a number, as in <12.5");
    builder_.file().maximize = bound.text[0] == '>';
    bound.text.remove_prefix(1);
    const double value = text_.number(bound, "the bound after '<' or '>'");
    builder_.file().top = builder_.cost(value);
    need_close(text_, "the bound");
  }

  void variable() {
    ProblemToken token = text_.need("a variable");
    const std::size_t index = builder_.problem().variables.size();
    std::string name = std::to_string(index);
    const ProblemToken at = token;
    if (!opens(token) && !begins_number(token.text)) {
      name = token.text;
      token = text_.need("the values of variable '" + name + "', or their number");
    }
    if (!indices_.emplace(name, static_cast<Index>(index)).second)
      text_.fail(at, "there are two variables '" + name + "'; rename one of them");
    std::unordered_map<std::string, Index>& values = values_.emplace_back();
    if (!opens(token)) {
      constexpr std::int64_t most = 1 << 30;  // a negative number is an interval from 0
      const std::int64_t size = text_.integer(token, "the number of values of variable '" + name + "'", -most, most);
      return builder_.add_variable(token, name, std::abs(size));
    }
    std::vector<std::string> names;
    for (ProblemToken value = text_.need("a value"); !closes(value); value = text_.need("a value")) {
      if (opens(value) || value.text.empty() || is_digit(value.text[0]))
        text_.fail(value, "a value of variable '" + name + "' cannot be called " + ProblemText::name(value) +
                              ": names do not begin with a digit");
      if (!values.emplace(value.text, static_cast<Index>(names.size())).second)
        text_.fail(value,
                   "variable '" + name + "' has two values " + ProblemText::name(value) + "; rename one of them");
      names.emplace_back(value.text);
    }
    const auto count = static_cast<std::int64_t>(names.size());
    builder_.add_variable(token, name, count, std::move(names));
  }

  Index index_of(const ProblemToken& word) const {
    if (!word.text.empty() && is_digit(word.text[0])) {
      const auto count = static_cast<std::int64_t>(values_.size());
      return static_cast<Index>(text_.integer(word, "the index of a variable", 0, count - 1));
    }
    const auto found = indices_.find(std::string(word.text));
    if (found == indices_.end())
      text_.fail(word, "there is no variable " + ProblemText::name(word) + "; give the name or index of one");
    return found->second;
  }

  Index value_of(Index variable, const ProblemToken& word) const {
    const std::string& name = builder_.problem().variables[variable].name;
    if (!word.text.empty() && is_digit(word.text[0]))
      return static_cast<Index>(text_.integer(word, "a value of variable '" + name + "'", 0,
                                              static_cast<std::int64_t>(builder_.domain(variable)) - 1));
    const auto found = values_[variable].find(std::string(word.text));
    if (found == values_[variable].end())
      text_.fail(word, "variable '" + name + "' has no value " + ProblemText::name(word));
    return found->second;
  }

  double cost(const ProblemToken& word) const { return builder_.cost(text_.number(word, "a cost")); }

  void function() {
    ProblemToken token = text_.need("a function");
    const ProblemToken at = token;
    std::string name = "f" + std::to_string(functions_++);
    if (!opens(token)) {
      name = token.text;
      need_open(text_, "function '" + name + "'");
    }
    tag("scope");
    need_open(text_, "the scope of function '" + name + "'");
    std::vector<Index> scope;
    for (ProblemToken word = text_.need("a variable"); !closes(word); word = text_.need("a variable"))
      scope.push_back(index_of(word));
    builder_.check_scope(at, scope);

    token = text_.need("the costs of function '" + name + "'");
    std::optional<double> default_cost;
    if (tagged_ ? token.is("defaultcost") : begins_number(token.text)) {
      if (tagged_) token = text_.need("the default cost");
      default_cost = cost(token);
      token = text_.need("the costs of function '" + name + "'");
    }
    if (tagged_ && token.is("type")) return global(text_.need("the type of function '" + name + "'"), name, scope);
    if (tagged_) {
      if (!token.is("costs"))
        text_.fail(token, "expected 'defaultcost', 'costs' or 'type' in function '" + name + "' but found " +
                              ProblemText::name(token));
      token = text_.need("the costs of function '" + name + "'");
    }
    if (opens(token)) {
      table(at, name, !opens(at), std::move(scope), default_cost);
    } else if (!tagged_ && opens(text_.peek())) {
      return global(token, name, scope);
    } else {
      sharings_.push_back({token, name, std::move(scope)});
    }
    need_close(text_, "function '" + name + "'");
  }

  void global(const ProblemToken& keyword, const std::string& name, std::vector<Index> scope) {
    tag("params");
    need_open(text_, "the parameters of '" + std::string(keyword.text) + "'");
    CfnParameters parameters(text_, tagged_,
                             [this](const ProblemToken& word) { return std::to_string(index_of(word)); });
    parameters.read(keyword);
    add_global_function(builder_, text_, keyword, name, std::move(scope),
                        [&](std::string_view what) { return parameters.next(what); });
    if (!parameters.at_end())
      text_.fail(parameters.place(), "'" + std::string(keyword.text) + "' has more parameters than it takes, from " +
                                         ProblemText::name(parameters.place()) + " on");
    need_close(text_, "function '" + name + "'");
  }

  // From after the opening to after the closing bracket of the costs.
  void table(const ProblemToken& at, const std::string& name, bool named, std::vector<Index> scope,
             std::optional<double> default_cost) {
    std::vector<double> costs(builder_.table_size(at, scope, most_table_entries), default_cost.value_or(0));
    std::size_t given = 0;
    std::vector<bool> seen(default_cost ? costs.size() : 0, false);
    for (ProblemToken word = text_.need("a cost"); !closes(word); word = text_.need("a cost")) {
      std::size_t entry = given++;
      if (default_cost) {
        entry = 0;
        for (const Index v : scope) {
          entry = entry * builder_.domain(v) + value_of(v, word);
          word = text_.need("the rest of a tuple and its cost");
        }
        if (seen[entry]) text_.fail(word, "function '" + name + "' has this tuple twice; keep one of them");
        seen[entry] = true;
      } else if (entry >= costs.size()) {
        text_.fail(word,
                   "function '" + name + "' has more than the " + std::to_string(costs.size()) + " costs of its scope");
      }
      costs[entry] = cost(word);
    }
    if (!default_cost && given != costs.size())
      text_.fail(at, "function '" + name + "' has " + std::to_string(given) + " costs; its scope has " +
                         std::to_string(costs.size()) + " tuples. Give all, or a defaultcost");
    if (named) {
      Table& place = tables_[name];
      place = {scope, builder_.problem().constraints.size(), {}};
      if (scope.size() < 2) place.costs = costs;
    }
    builder_.add_table(at, name, std::move(scope), std::move(costs));
  }

  // Functions that use the table of another, which may stand before or after them.
  void share() {
    for (Sharing& sharing : sharings_) {
      const auto found = tables_.find(std::string(sharing.of.text));
      if (found == tables_.end())
        text_.fail(sharing.of, "function '" + sharing.name + "' uses the costs of " + ProblemText::name(sharing.of) +
                                   ", which is no function with a table");
      bool same = found->second.scope.size() == sharing.scope.size();
      for (std::size_t i = 0; same && i < sharing.scope.size(); ++i)
        same = builder_.domain(found->second.scope[i]) == builder_.domain(sharing.scope[i]);
      if (!same)
        text_.fail(sharing.of, "function '" + sharing.name + "' uses the costs of " + ProblemText::name(sharing.of) +
                                   ", whose variables have other domain sizes");
      builder_.table_size(sharing.of, sharing.scope, most_table_entries);
      std::vector<double> costs = sharing.scope.size() < 2
                                      ? found->second.costs
                                      : builder_.problem().constraints[found->second.constraint].costs;
      builder_.add_table(sharing.of, sharing.name, std::move(sharing.scope), std::move(costs));
    }
  }

  ProblemText text_;
  ProblemBuilder builder_;
  bool tagged_ = false;
  std::size_t functions_ = 0;
  std::unordered_map<std::string, Index> indices_;
  std::vector<std::unordered_map<std::string, Index>> values_;
  std::map<std::string, Table> tables_;
  std::vector<Sharing> sharings_;
};

}  // namespace

ProblemFile read_cfn(const std::string& name, std::string_view text, std::uint64_t memory_budget) {
  return CfnReader(name, text, memory_budget).read();
}

}  // namespace toposcope
