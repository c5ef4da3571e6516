// SPDX-License-Identifier: BSD-3-Clause
#include "decode.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace toposcope::posterior {
namespace {

class Decoder {
 public:
  Decoder(const FactorGraph& graph, const std::vector<std::vector<double>>& marginals, Watch& watch)
      : graph_(graph), watch_(watch), order_(graph.variables()), ranked_(graph.variables()), due_(graph.variables()) {
    std::iota(order_.begin(), order_.end(), Index{0});
    const auto surest = [&](Index v) { return *std::max_element(marginals[v].begin(), marginals[v].end()); };
    std::stable_sort(order_.begin(), order_.end(), [&](Index a, Index b) { return surest(a) > surest(b); });
    std::vector<std::size_t> depth(order_.size());
    for (std::size_t i = 0; i < order_.size(); ++i) depth[order_[i]] = i;
    for (Index v = 0; v < graph.variables(); ++v) {
      ranked_[v].resize(graph.domain(v));
      std::iota(ranked_[v].begin(), ranked_[v].end(), Index{0});
      std::stable_sort(ranked_[v].begin(), ranked_[v].end(),
                       [&](Index a, Index b) { return marginals[v][a] > marginals[v][b]; });
    }
    // A factor is asked once the last variable of its scope has its value.
    for (const Factor& factor : graph.factors)
      due_[*std::max_element(factor.scope.begin(), factor.scope.end(), [&](Index a, Index b) {
        return depth[a] < depth[b];
      })].push_back(&factor);
  }

  std::vector<Index> labeling(std::size_t most_steps) {
    at_.assign(graph_.variables(), 0);
    steps_ = most_steps;
    if (!extend(0)) return {};
    improve();
    return at_;
  }

 private:
  double cost(const Factor& factor) const {
    std::size_t entry = 0;
    for (const Index v : factor.scope) entry = entry * graph_.domain(v) + at_[v];
    return factor.costs[entry];
  }

  bool extend(std::size_t depth) {
    if (depth == order_.size()) return true;
    const Index v = order_[depth];
    for (const Index value : ranked_[v]) {
      if (steps_ == 0) return false;
      --steps_;
      watch_.poll(10 * due_[v].size());
      at_[v] = value;
      const bool allowed =
          std::all_of(due_[v].begin(), due_[v].end(), [&](const Factor* f) { return cost(*f) < forbidden; });
      if (allowed && extend(depth + 1)) return true;
    }
    return false;
  }

  // One variable at a time, while that lowers the cost.
  void improve() {
    std::vector<std::vector<const Factor*>> touching(graph_.variables());
    for (const Factor& factor : graph_.factors)
      for (const Index v : factor.scope) touching[v].push_back(&factor);
    for (bool improved = true; improved;) {
      improved = false;
      for (const Index v : order_) {
        const Index before = at_[v];
        Index best = before;
        double least = forbidden, now = forbidden;
        for (Index value = 0; value < graph_.domain(v); ++value) {
          at_[v] = value;
          double sum = graph_.unary[v][value];
          for (const Factor* factor : touching[v]) sum += cost(*factor);
          if (value == before) now = sum;
          if (sum < least) {
            least = sum;
            best = value;
          }
          watch_.poll(5 * touching[v].size());
        }
        // By more than rounding: or two labellings could follow each other for ever.
        at_[v] = least < now - 1e-9 * (1 + std::abs(now)) ? best : before;
        improved = improved || at_[v] != before;
      }
    }
  }

  const FactorGraph& graph_;
  Watch& watch_;
  std::vector<Index> order_, at_;
  std::vector<std::vector<Index>> ranked_;  ///< per variable: its values, most probable first
  std::vector<std::vector<const Factor*>> due_;
  std::size_t steps_ = 0;
};

}  // namespace

std::vector<Index> decode(const FactorGraph& graph, const std::vector<std::vector<double>>& marginals,
                          std::size_t most_steps, Watch& watch) {
  return Decoder(graph, marginals, watch).labeling(most_steps);
}

}  // namespace toposcope::posterior
