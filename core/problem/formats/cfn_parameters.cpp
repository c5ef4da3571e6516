// SPDX-License-Identifier: BSD-3-Clause
#include "formats/cfn_parameters.h"

#include <map>
#include <string_view>

namespace toposcope {
namespace {

// Tags in their order and the form of what follows: w a word; l a counted list of words; f the same without its count;
// t a counted list of tuples; T of tuples that begin with a variable; s lists that each have their count.
const std::map<std::string_view, std::string_view>& forms() {
  static constexpr std::string_view measure = "metric:w cost:w", bounds = "metric:w cost:w bounds:t",
                                    automaton = "metric:w cost:w nb_states:w starts:l ends:l transitions:t",
                                    among = "metric:w cost:w min:w max:w values:l", maximum = "defaultcost:w tuples:T",
                                    diverse = "distance:w values:f";
  static const std::map<std::string_view, std::string_view> table = {
      {"salldiff", measure},
      {"salldiffdp", measure},
      {"salldiffkp", measure},
      {"walldiff", measure},
      {"walldifferent", measure},
      {"wsame", measure},
      {"sgcc", bounds},
      {"sgccdp", bounds},
      {"wgcc", bounds},
      {"wsamegcc", bounds},
      {"sregular", automaton},
      {"sregulardp", automaton},
      {"wregular", "nb_states:w starts:t ends:t transitions:t"},
      {"samong", among},
      {"samongdp", among},
      {"wamong", "metric:w cost:w values:l min:w max:w"},
      {"wvaramong", "metric:w cost:w values:l"},
      {"woverlap", "metric:w cost:w comparator:w to:w"},
      {"wsum", "metric:w cost:w comparator:w to:w"},
      {"wvarsum", "metric:w cost:w comparator:w"},
      {"max", maximum},
      {"smaxdp", maximum},
      {"MST", ""},
      {"smstdp", ""},
      {"clique", "rhs:w values:s"},
      {"knapsack", "capacity:w weights:f"},
      {"knapsackv", "capacity:w weightedvalues:T"},
      {"wdiverse", diverse},
      {"whdiverse", diverse},
      {"wtdiverse", diverse},
  };
  return table;
}

}  // namespace

bool opens(const ProblemToken& token) {
  return !token.quoted && (token.is("{") || token.is("["));
}
bool closes(const ProblemToken& token) {
  return !token.quoted && (token.is("}") || token.is("]"));
}

void need_open(ProblemText& text, std::string_view what) {
  const ProblemToken token = text.need(what);
  if (!opens(token))
    text.fail(token, "expected '{' or '[' before " + std::string(what) + " but found " + ProblemText::name(token));
}

void need_close(ProblemText& text, std::string_view what) {
  const ProblemToken token = text.need("'}' or ']'");
  if (!closes(token))
    text.fail(token, "expected '}' or ']' after " + std::string(what) + " but found " + ProblemText::name(token));
}

void CfnParameters::tag(std::string_view name) {
  if (!tagged_) return;
  const ProblemToken token = text_.need("'" + std::string(name) + "'");
  if (!token.is(name))
    text_.fail(token, "expected '" + std::string(name) + "' but found " + ProblemText::name(token) +
                          "; parameters have a fixed order");
}

ProblemToken CfnParameters::made_word(const ProblemToken& at, std::string word) {
  ProblemToken token = at;
  token.text = made_.emplace_back(std::move(word));
  token.end = false;
  return token;
}

ProblemToken CfnParameters::variable(const ProblemToken& word) {
  return made_word(word, index_of_(word));
}

void CfnParameters::list(bool variables, bool counted) {
  const ProblemToken begin = text_.peek();
  need_open(text_, "a list");
  std::vector<ProblemToken> items;
  for (ProblemToken word = text_.need("a list's item"); !closes(word); word = text_.need("a list's item"))
    items.push_back(variables ? variable(word) : word);
  if (counted) words_.push_back(made_word(begin, std::to_string(items.size())));
  words_.insert(words_.end(), items.begin(), items.end());
}

void CfnParameters::tuples(bool variables) {
  const ProblemToken begin = text_.peek();
  need_open(text_, "a list of tuples");
  std::vector<ProblemToken> items;
  std::size_t count = 0;
  for (; !closes(text_.peek()); ++count) {
    need_open(text_, "a tuple");
    bool first = true;
    for (ProblemToken word = text_.need("a tuple's item"); !closes(word); word = text_.need("a tuple's item")) {
      items.push_back(variables && first ? variable(word) : word);
      first = false;
    }
  }
  text_.next();
  words_.push_back(made_word(begin, std::to_string(count)));
  words_.insert(words_.end(), items.begin(), items.end());
}

void CfnParameters::lists() {
  need_open(text_, "a list of lists");
  while (!closes(text_.peek())) list(false, true);
  text_.next();
}

std::size_t CfnParameters::rules(bool terminals, std::vector<ProblemToken>& made) {
  tag(terminals ? "terminals" : "non_terminals");
  need_open(text_, "a list of rules");
  const bool weighted = words_.front().is("weight");
  const std::string kind = terminals ? (weighted ? "2" : "0") : weighted ? "3" : "1";
  std::size_t count = 0;
  for (; !closes(text_.peek()); ++count) {
    const ProblemToken begin = text_.peek();
    need_open(text_, "a rule");
    made.push_back(made_word(begin, kind));
    for (ProblemToken word = text_.need("a rule's item"); !closes(word); word = text_.need("a rule's item"))
      made.push_back(word);
  }
  text_.next();
  return count;
}

void CfnParameters::read(const ProblemToken& keyword) {
  if (keyword.is("ssame")) {
    tag("cost");
    words_.push_back(text_.need("a cost"));
    // .wcsp has both counts before both lists.
    for (const char* name : {"vars1", "vars2"}) {
      tag(name);
      list(true, true);
    }
    const auto second = static_cast<std::ptrdiff_t>(2 + std::stoul(std::string(words_[1].text)));
    const ProblemToken count = words_[static_cast<std::size_t>(second)];
    words_.erase(words_.begin() + second);
    words_.insert(words_.begin() + 2, count);
  } else if (keyword.is("sgrammar") || keyword.is("sgrammardp")) {
    for (const char* name : {"metric", "cost", "nb_symbols", "nb_values", "start"}) {
      tag(name);
      words_.push_back(text_.need(name));
    }
    std::vector<ProblemToken> made;
    const ProblemToken begin = text_.peek();
    const std::size_t count = rules(true, made) + rules(false, made);
    words_.push_back(made_word(begin, std::to_string(count)));
    words_.insert(words_.end(), made.begin(), made.end());
  } else if (const auto form = forms().find(keyword.text); form != forms().end()) {
    for (std::string_view rest = form->second; !rest.empty();) {
      const std::size_t colon = rest.find(':');
      tag(rest.substr(0, colon));
      switch (rest[colon + 1]) {
        case 'w':
          words_.push_back(text_.need("a parameter"));
          break;
        case 'l':
          list(false, true);
          break;
        case 'f':
          list(false, false);
          break;
        case 's':
          lists();
          break;
        default:
          tuples(rest[colon + 1] == 'T');
      }
      rest = rest.substr(std::min(rest.size(), colon + 3));
    }
  } else {  // arithmetic functions: words alone; what is unknown is refused by whoever asks for its parameters
    while (!closes(text_.peek()) && !opens(text_.peek()) && !text_.peek().end) words_.push_back(text_.next());
    if (opens(text_.peek())) return;
  }
  end_ = text_.peek();
  need_close(text_, "the parameters of '" + std::string(keyword.text) + "'");
}

ProblemToken CfnParameters::next(std::string_view what) {
  if (at_end()) text_.fail(end_, "the parameters end where " + std::string(what) + " should follow");
  return words_[at_++];
}

}  // namespace toposcope
