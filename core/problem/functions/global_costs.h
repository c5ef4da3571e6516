// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// What a tuple costs under the global cost functions of toulbar2's formats, as its documentation defines them.
// Each object is called for one tuple after the other and keeps its working memory.

#include <map>
#include <span>
#include <string>
#include <vector>

#include "toposcope/types.h"

namespace toposcope {

/// A transition of an automaton on a symbol; or a state (`from`) where it may begin or end.
struct Transition {
  Index from = 0, symbol = 0, to = 0;
  double cost = 0;
};

/// An automaton over the values of a scope, in its order.
struct Automaton {
  Index states = 0;
  std::vector<Transition> starts, ends, transitions;
};

/// Least cost of a path that reads the tuple; infinite where there is none. With a `substitution` cost any symbol may
/// be read as another at that cost: the Hamming distance to the language.
class RegularCost {
 public:
  /// \param substitution  infinite: symbols are read as they are
  /// \param edit  values may also be left out, and symbols be put in, at the cost of a substitution: the edit distance
  RegularCost(Automaton automaton, double substitution, bool edit);
  double operator()(std::span<const Index> values);

 private:
  void insert(std::vector<double>& states) const;

  Automaton automaton_;
  double substitution_;
  bool edit_;
  std::vector<double> here_, next_;
};

/// A grammar in Chomsky normal form.
struct Grammar {
  struct Terminal {
    Index from = 0, symbol = 0;
    double cost = 0;
  };
  struct Production {
    Index from = 0, left = 0, right = 0;
    double cost = 0;
  };
  Index symbols = 0, start = 0;
  std::vector<Terminal> terminals;
  std::vector<Production> productions;
};

/// Least cost of a derivation of the tuple (Cocke-Younger-Kasami); infinite where there is none. A terminal may stand
/// for any symbol at a cost of `substitution`.
class GrammarCost {
 public:
  GrammarCost(Grammar grammar, double substitution) : grammar_(std::move(grammar)), substitution_(substitution) {}
  double operator()(std::span<const Index> values);

 private:
  Grammar grammar_;
  double substitution_;
  std::vector<double> table_;  ///< first, length - 1, symbol
};

/// How far a value misses its bounds.
enum class Measure { hard, linear, quadratic };

/// What missing the mark by `gap` costs.
double violation_cost(Measure measure, double cost, double gap);

/// How far `value` is from meeting `value <comparator> right`. \param comparator  == != < <= > >=
double comparison_gap(const std::string& comparator, double value, double right);

/// How often a value may occur in a tuple, and what missing that costs per occurrence.
struct Occurrence {
  Index lower = 0, upper = 0;
  double shortage = 0, excess = 0;
};

/// Occurrences of each value in a tuple.
class ValueCounts {
 public:
  explicit ValueCounts(Index values) : counts_(values, 0) {}
  const std::vector<Index>& of(std::span<const Index> values);

 private:
  std::vector<Index> counts_;
};

/// True where each position of the tuple names its parent, one names itself, and there is no cycle.
bool is_spanning_tree(std::span<const Index> parents);

}  // namespace toposcope
