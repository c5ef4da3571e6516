// SPDX-License-Identifier: BSD-3-Clause
#include "tree_search.h"

#include <algorithm>

namespace toposcope {
namespace {

bool has(const VariableSet& set, Index variable) {
  return ((set[variable / 64] >> (variable % 64)) & 1U) != 0;
}

void add(VariableSet& set, Index variable) {
  set[variable / 64] |= std::uint64_t{1} << (variable % 64);
}

void take(VariableSet& set, Index variable) {
  set[variable / 64] &= ~(std::uint64_t{1} << (variable % 64));
}

void merge(VariableSet& set, const VariableSet& other) {
  for (std::size_t w = 0; w < set.size(); ++w) set[w] |= other[w];
}

}  // namespace

TreeSearch::TreeSearch(const CompiledNetwork& network, const CrispRules& rules, CrispVisitor& visitor,
                       Deadline& deadline)
    : network_(network),
      rules_(rules),
      visitor_(visitor),
      deadline_(deadline),
      domains_(network, deadline),
      rank_(network.variables()),
      pair_weights_(network.pairs().size(), 1),
      table_weights_(network.tables().size(), 1),
      values_(network.variables(), 0),
      children_(network.variables()),
      decisions_((network.variables() + 63) / 64, 0) {
  const std::vector<Index> order = detectability_order(network.problem());
  for (Index at = 0; at < order.size(); ++at) rank_[order[at]] = at;
  conflicts_.assign(network.variables() + 1, decisions_);
}

TreeSearch::End TreeSearch::run() {
  end_ = End::exhausted;
  if (!network_.complete()) return End::out_of_time;
  if (root()) descend(0);
  return end_;
}

bool TreeSearch::root() {
  if (!domains_.open()) return false;
  bool going = true;
  const bool limited = rules_.missing_limit != no_candidate;
  for (std::size_t before = domains_.trail().size() + 1; going && before != domains_.trail().size();) {
    before = domains_.trail().size();
    going = rules_.relaxation == CrispRules::Relaxation::none || domains_.relax();
    if (going && limited) going = domains_.limit_missing(rules_.missing_limit);
  }
  domains_.set_root();
  return going;
}

bool TreeSearch::propagate(Index variable) {
  const bool limited = rules_.missing_limit != no_candidate;
  bool going = true;
  if (rules_.relaxation != CrispRules::Relaxation::maintained) {
    going = domains_.check_forward(variable);
    if (going && limited) going = domains_.limit_missing(rules_.missing_limit);
  } else {
    for (std::size_t before = domains_.trail().size() + 1; going && before != domains_.trail().size();) {
      before = domains_.trail().size();
      going = domains_.relax();
      if (going && limited) going = domains_.limit_missing(rules_.missing_limit);
    }
  }
  if (going) return true;
  const StrikeCause cause = domains_.failure();
  if (cause.kind == StrikeCause::Kind::pair) ++pair_weights_[cause.at];
  if (cause.kind == StrikeCause::Kind::table) ++table_weights_[cause.at];
  return false;
}

double TreeSearch::weight(Index variable) const {
  double sum = 0;
  for (const CrispArc& arc : network_.arcs(variable))
    if (!domains_.assigned(arc.other)) sum += pair_weights_[arc.pair];
  for (const Index t : network_.tables_of(variable)) {
    const std::vector<Index>& scope = network_.tables()[t].scope;
    if (std::any_of(scope.begin(), scope.end(), [&](Index v) { return v != variable && !domains_.assigned(v); }))
      sum += table_weights_[t];
  }
  return sum;
}

Index TreeSearch::choose() const {
  Index best = no_candidate;
  double best_score = 0;
  for (Index v = 0; v < network_.variables(); ++v) {
    if (domains_.assigned(v)) continue;
    double score = domains_.size(v);
    if (rules_.order == CrispRules::Order::detectability) score = rank_[v];
    if (rules_.order == CrispRules::Order::weighted && domains_.size(v) > 1) score = 1 + score / (1 + weight(v));
    if (best == no_candidate || score < best_score || (score == best_score && rank_[v] < rank_[best])) {
      best = v;
      best_score = score;
    }
  }
  return best;
}

void TreeSearch::list_values(std::size_t depth, Index variable) {
  std::vector<Index>& values = children_[depth];
  values.clear();
  for_each_value(domains_.domain(variable), [&](Index value) { values.push_back(value); });
  visitor_.order(variable, values);
  if (!rules_.missing_last || !network_.problem().variables[variable].optional) return;
  std::stable_partition(values.begin(), values.end(), [](Index value) { return value != 0; });
}

// Everything decided so far: of what a bound cuts off no single decision can be acquitted.
void TreeSearch::blame_all(std::size_t depth) {
  for (Index v = 0; v < network_.variables(); ++v)
    if (domains_.assigned(v)) add(conflicts_[depth], v);
}

// False when the search ends. Leaves in conflicts_[depth] decisions above that explain why no more is to be found here.
bool TreeSearch::descend(std::size_t depth) {
  VariableSet& conflict = conflicts_[depth];
  std::fill(conflict.begin(), conflict.end(), 0);
  if (depth == network_.variables()) {
    blame_all(depth);
    if (visitor_.solution(values_)) return true;
    end_ = End::ended_by_visitor;
    return false;
  }
  const Index variable = choose();
  list_values(depth, variable);
  const std::size_t listed = children_[depth].size();
  if (rules_.backjumping && listed < domains_.size(variable)) blame_all(depth);
  for (std::size_t k = 0; k < listed; ++k) {
    const Index value = children_[depth][k];
    ++nodes_;
    if (deadline_.reached()) {
      end_ = End::out_of_time;
      return false;
    }
    const Propagation::Mark mark = domains_.mark();
    domains_.assign(variable, value);
    values_[variable] = value;
    VariableSet& below = conflicts_[depth + 1];
    bool going = true;
    if (!propagate(variable)) {
      std::fill(below.begin(), below.end(), 0);
      if (rules_.backjumping) domains_.explain_failure(below);
    } else {
      if (visitor_.enter(variable, value)) {
        going = descend(depth + 1);
      } else {
        std::fill(below.begin(), below.end(), 0);
        blame_all(depth + 1);
      }
      visitor_.leave(variable);
    }
    domains_.undo(mark);
    if (!going) return false;
    if (!rules_.backjumping) continue;
    if (!has(below, variable)) {  // no other value helps: back to what is to blame
      conflict = below;
      return true;
    }
    take(below, variable);
    merge(conflict, below);
  }
  if (rules_.backjumping) domains_.explain_strikes(variable, conflict);
  return true;
}

void FirstFound::order(Index variable, std::vector<Index>& values) {
  order_by_cost(problem_.variables[variable], values);
}

bool FirstFound::solution(std::span<const Index> values) {
  found_.assign(values.begin(), values.end());
  return false;
}

}  // namespace toposcope
