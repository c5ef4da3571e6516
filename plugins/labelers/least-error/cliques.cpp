// SPDX-License-Identifier: BSD-3-Clause
// Values of which at most one can be taken. A bound from pairs alone lets half of each be taken; one from the whole set
// does not. So each such set gets a variable of its own that says which of them is taken.

#include <algorithm>
#include <set>

#include "soft_network.h"

namespace toposcope::least_error {
namespace {

constexpr std::size_t smallest = 3, largest = 200;

/// Sets of mutually exclusive variables, each of them by its best value, that cover the exclusions greedily.
class Cover {
 public:
  explicit Cover(std::size_t variables) : of_(variables) {}

  void exclude(int x, int y) {
    of_[static_cast<std::size_t>(x)].insert(y);
    of_[static_cast<std::size_t>(y)].insert(x);
  }

  /// \return cliques, the variables of each ascending
  std::vector<std::vector<int>> cliques() const {
    std::vector<std::vector<int>> found;
    std::set<std::pair<int, int>> covered;
    for (int x = 0; x < static_cast<int>(of_.size()); ++x)
      for (const int y : of_[static_cast<std::size_t>(x)]) {
        if (y < x || covered.contains({x, y})) continue;
        std::vector<int> clique = {x, y};
        extend(clique, covered);
        if (clique.size() < smallest) continue;
        std::sort(clique.begin(), clique.end());
        for (std::size_t i = 0; i < clique.size(); ++i)
          for (std::size_t j = i + 1; j < clique.size(); ++j) covered.insert({clique[i], clique[j]});
        found.push_back(std::move(clique));
      }
    return found;
  }

 private:
  /// By whoever excludes all members; those first whose pairs with them are not covered yet.
  void extend(std::vector<int>& clique, const std::set<std::pair<int, int>>& covered) const {
    std::vector<int> open;
    for (const int z : of_[static_cast<std::size_t>(clique[0])])
      if (of_[static_cast<std::size_t>(clique[1])].contains(z)) open.push_back(z);
    while (!open.empty() && clique.size() < largest) {
      const auto fresh = [&](int z) {
        return std::count_if(clique.begin(), clique.end(), [&](int c) {
          return !covered.contains({std::min(c, z), std::max(c, z)});
        });
      };
      const int next = *std::max_element(open.begin(), open.end(), [&](int a, int b) { return fresh(a) < fresh(b); });
      clique.push_back(next);
      std::erase_if(open, [&](int z) { return z == next || !of_[static_cast<std::size_t>(next)].contains(z); });
    }
  }

  std::vector<std::set<int>> of_;
};

}  // namespace

// -1 where no value is better than all others.
int SoftNetwork::best_value(int variable) const {
  const Cost* costs = unary(variable);
  const int best = static_cast<int>(std::min_element(costs, costs + size(variable)) - costs);
  return size(variable) > 1 && std::count(costs, costs + size(variable), costs[best]) == 1 ? best : -1;
}

void SoftNetwork::add_cliques() {
  const int count = variables();
  std::vector<int> best;
  for (int v = 0; v < count; ++v) best.push_back(best_value(v));
  Cover cover(static_cast<std::size_t>(count));
  for (const BinaryFunction& f : functions_) {
    const int a = best[static_cast<std::size_t>(f.variable[0])], b = best[static_cast<std::size_t>(f.variable[1])];
    if (a >= 0 && b >= 0 && is_forbidden(f.table[0][static_cast<std::size_t>(a * size_[f.variable[1]] + b)]))
      cover.exclude(f.variable[0], f.variable[1]);
  }
  std::set<std::pair<int, int>> covered;
  for (const std::vector<int>& clique : cover.cliques()) {
    const int chooser = add_variable(static_cast<int>(clique.size()) + 1);  // its last value: none is taken
    for (std::size_t i = 0; i < clique.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) covered.insert({clique[j], clique[i]});
      const int member = clique[i], columns = size_[member], own = best[static_cast<std::size_t>(member)];
      BinaryFunction& f = functions_[static_cast<std::size_t>(function_between(chooser, member))];
      // The member comes first: it was made before.
      for (int value = 0; value < columns; ++value)
        for (int choice = 0; choice < size_[chooser]; ++choice)
          if ((value == own) != (choice == static_cast<int>(i)))
            f.table[0][static_cast<std::size_t>(value * size_[chooser] + choice)] = infinite;
    }
  }
  if (!covered.empty()) drop_covered(std::move(covered));
}

// Functions between two variables of one clique that say nothing but that they exclude each other. A function of many
// variables may want to join them later.
void SoftNetwork::drop_covered(std::set<std::pair<int, int>> covered) {
  for (const DelayedFunction& delayed : delayed_)
    for (std::size_t i = 0; i < delayed.variables.size(); ++i)
      for (std::size_t j = 0; j < delayed.variables.size(); ++j)
        covered.erase({delayed.variables[i], delayed.variables[j]});
  std::erase_if(functions_, [&](const BinaryFunction& f) {
    return covered.contains({f.variable[0], f.variable[1]}) &&
           std::count(f.table[0].begin(), f.table[0].end(), 0) + 1 == std::ssize(f.table[0]);
  });
  between_.clear();
  for (std::size_t f = 0; f < functions_.size(); ++f)
    between_[{functions_[f].variable[0], functions_[f].variable[1]}] = static_cast<int>(f);
}

int SoftNetwork::add_variable(int size) {
  const int variable = variables();
  first_.push_back(static_cast<int>(values_.size()));
  unary_.push_back(costs_.size());
  for (int a = 0; a < size; ++a) {
    values_.push_back(static_cast<Index>(a));
    candidates_.push_back(no_candidate);
    costs_.push_back(0);
    order_.push_back(a);
    place_.push_back(a);
  }
  size_.push_back(size);
  count_.push_back(size);
  uses_.emplace_back();
  delayed_uses_.emplace_back();
  return variable;
}

}  // namespace toposcope::least_error
