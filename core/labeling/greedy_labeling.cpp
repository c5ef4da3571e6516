// SPDX-License-Identifier: BSD-3-Clause
#include "toposcope/labeling/greedy_labeling.h"

#include <algorithm>
#include <tuple>

namespace toposcope {
namespace {

class Greedy {
 public:
  Greedy(const LabelingProblem& problem, GreedyRules& rules, Deadline& deadline)
      : problem_(problem),
        rules_(rules),
        deadline_(deadline),
        values_(problem.variables.size(), 0),
        dead_ends_(problem.variables.size(), 0),
        due_(problem.variables.size()),
        offsets_(1, 0),
        excluded_((problem.variables.size() + 1) * problem.conflict_words()) {
    for (const LabelingVariable& variable : problem.variables) offsets_.push_back(offsets_.back() + variable.domain());
    children_.resize(offsets_.back());
    child_counts_.resize(values_.size());
    next_.resize(values_.size());
  }

  std::optional<std::vector<Index>> search() {
    for (std::size_t round = 0; round < rules_.rounds; ++round) {
      if (run()) return values_;
      if (deadline_.reached()) break;
      const auto worst = std::max_element(dead_ends_.begin(), dead_ends_.end());
      const auto variable = static_cast<Index>(worst - dead_ends_.begin());
      const auto at = std::find(rules_.order.begin(), rules_.order.end(), variable);
      if (finished_ || at == rules_.order.begin()) break;  // none exists; or the same search again
      std::rotate(rules_.order.begin(), at, at + 1);
      std::fill(dead_ends_.begin(), dead_ends_.end(), 0);
    }
    return std::nullopt;
  }

 private:
  struct Child {
    double rank;
    Index value;
    bool operator<(const Child& other) const { return std::tie(rank, value) < std::tie(other.rank, other.value); }
  };

  std::size_t depths() const { return rules_.order.size(); }

  // A constraint is due at the last of its variables.
  void place_constraints() {
    std::vector<std::size_t> depth_of(values_.size());
    for (std::size_t depth = 0; depth < depths(); ++depth) depth_of[rules_.order[depth]] = depth;
    for (std::vector<Index>& due : due_) due.clear();
    for (Index c = 0; c < problem_.constraints.size(); ++c) {
      std::size_t last = 0;
      for (const Index v : problem_.constraints[c].scope) last = std::max(last, depth_of[v]);
      due_[last].push_back(c);
    }
  }

  // Lists what the variable of this depth can take, best first.
  void open(std::size_t depth) {
    const Index v = rules_.order[depth];
    const LabelingVariable& variable = problem_.variables[v];
    Child* children = children_.data() + offsets_[v];
    std::size_t count = 0;
    for (Index a = 0; a < variable.domain(); ++a) {
      const Index candidate = variable.candidate(a);
      if (candidate != no_candidate &&
          ((excluded_[depth * problem_.conflict_words() + candidate / 64] >> (candidate % 64)) & 1U) != 0)
        continue;
      double cost = variable.costs[a];
      values_[v] = a;
      for (const Index c : due_[depth]) {
        if (cost == forbidden) break;
        cost += problem_.constraints[c].costs[table_entry(problem_, problem_.constraints[c], values_)];
      }
      if (cost < forbidden) children[count++] = {rules_.rank.empty() ? cost : rules_.rank[offsets_[v] + a], a};
    }
    std::sort(children, children + count);
    child_counts_[depth] = count;
    next_[depth] = 0;
    dead_ends_[v] += count == 0;
  }

  void take(std::size_t depth) {
    const Index v = rules_.order[depth];
    values_[v] = children_[offsets_[v] + next_[depth]++].value;
    const Index candidate = problem_.variables[v].candidate(values_[v]);
    const std::size_t words = problem_.conflict_words();
    for (std::size_t w = 0; w < words; ++w)
      excluded_[(depth + 1) * words + w] =
          excluded_[depth * words + w] |
          (candidate == no_candidate ? 0 : problem_.conflict_bits[candidate * words + w]);
  }

  // The first descent is not bounded by the deadline: it is no dearer than the reading of the problem.
  bool run() {
    place_constraints();
    finished_ = false;
    std::size_t backtracks = 0, depth = 0;
    if (depths() == 0) return true;
    open(0);
    while (true) {
      if (next_[depth] < child_counts_[depth]) {
        take(depth);
        if (++depth == depths()) return true;
        open(depth);
        continue;
      }
      finished_ = depth == 0;
      if (finished_ || ++backtracks > rules_.backtracks || deadline_.reached()) return false;
      --depth;
    }
  }

  const LabelingProblem& problem_;
  GreedyRules& rules_;
  Deadline& deadline_;
  std::vector<Index> values_;
  std::vector<std::size_t> dead_ends_;  ///< by variable: times that nothing was left of it
  std::vector<std::vector<Index>> due_;
  std::vector<std::size_t> offsets_, child_counts_, next_;
  std::vector<std::uint64_t> excluded_;  ///< by depth: candidates excluded by the variables before it
  std::vector<Child> children_;
  bool finished_ = false;
};

}  // namespace

std::optional<std::vector<Index>> greedy_labeling(const LabelingProblem& problem, GreedyRules rules,
                                                  Deadline& deadline) {
  return Greedy(problem, rules, deadline).search();
}

}  // namespace toposcope
