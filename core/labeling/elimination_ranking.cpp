// SPDX-License-Identifier: BSD-3-Clause
// The k best labellings from an elimination's tables.

#include <algorithm>
#include <set>
#include <tuple>

#include "toposcope/labeling/elimination.h"

namespace toposcope::factors {

/// Each labelling stands for a set of them, of which it is the best: those that agree with an earlier one before some
/// variable, in reverse order of elimination, and take another value there. What is left of a set without its best is
/// cut into such sets again.
class Elimination::Ranking {
 public:
  Ranking(const Elimination& elimination, double least, const Listing& listing)
      : order_(elimination.order_),
        buckets_(elimination.buckets_),
        graph_(elimination.graph_),
        watch_(elimination.watch_),
        listing_(listing),
        capacity_(listing.k + std::clamp<std::size_t>(ties_work / std::max<std::size_t>(1, order_.size()), fewest_ties,
                                                      most_ties)) {
    waiting_.insert({least, 0, 0, order_.size(), 0});
  }

  void run() {
    while (!waiting_.empty()) {
      const Set set = *waiting_.begin();
      waiting_.erase(waiting_.begin());
      if (set.cost > limit() || best_.size() == capacity_) return;
      complete(set);
      listing_.offer(best_.back());
      cut(set);
    }
  }

 private:
  struct Set {
    double cost;  ///< of its best
    std::uint64_t number;
    std::size_t parent;  ///< among `best_`
    std::size_t
        level;  ///< of the variable that takes another value, in the order of elimination; beyond it as the parent
    Index value;
    bool operator<(const Set& other) const { return std::tie(cost, number) < std::tie(other.cost, other.number); }
  };

  double limit() const { return listing_.list.limit() + listing_.slack; }

  const double* row(const Bucket& bucket, const std::vector<Index>& at, std::size_t& number) const {
    number = 0;
    for (const Index w : bucket.bound) number = number * graph_.domain(w) + at[w];
    return bucket.table.data() + number * graph_.domain(bucket.variable);
  }

  void complete(const Set& set) {
    best_.push_back(best_.empty() ? std::vector<Index>(order_.size(), 0) : best_[set.parent]);
    std::vector<Index>& at = best_.back();
    std::size_t number = 0;
    if (set.level < order_.size()) at[order_[set.level]] = set.value;
    for (std::size_t level = set.level; level-- > 0;) {
      const Bucket& bucket = buckets_[order_[level]];
      const double* costs = row(bucket, at, number);
      const std::size_t width = graph_.domain(bucket.variable);
      at[bucket.variable] = static_cast<Index>(std::min_element(costs, costs + width) - costs);
      watch_.poll(width);
    }
  }

  // At the set's own level the values that were taken before are others' sets.
  void cut(const Set& set) {
    const std::size_t parent = best_.size() - 1;
    const std::vector<Index>& at = best_.back();
    std::size_t number = 0;
    for (std::size_t level = set.level; level-- > 0;) {
      const Bucket& bucket = buckets_[order_[level]];
      const double* costs = row(bucket, at, number);
      const std::size_t width = graph_.domain(bucket.variable);
      for (Index value = 0; value < width; ++value)
        if (value != at[bucket.variable])
          wait({set.cost + (costs[value] - bucket.message[number]), ++made_, parent, level, value});
      watch_.poll(2 * width);
    }
  }

  void wait(const Set& set) {
    if (!(set.cost < forbidden) || set.cost > limit()) return;
    // Each set that waits has a labelling of its own: more than are wanted need not wait.
    if (waiting_.size() + best_.size() >= capacity_) {
      if (waiting_.empty() || !(set < *waiting_.rbegin())) return;
      waiting_.erase(std::prev(waiting_.end()));
    }
    waiting_.insert(set);
  }

  // So many more than are wanted are looked at where costs are equal but for rounding.
  static constexpr std::size_t ties_work = 1'000'000, fewest_ties = 100, most_ties = 100'000;

  const std::vector<Index>& order_;
  const std::vector<Bucket>& buckets_;
  const FactorGraph& graph_;
  Watch& watch_;
  const Listing& listing_;
  std::size_t capacity_;
  std::uint64_t made_ = 0;
  std::set<Set> waiting_;
  std::vector<std::vector<Index>> best_;
};

void Elimination::k_best(double least, const Listing& listing) {
  Ranking(*this, least, listing).run();
}

}  // namespace toposcope::factors
