// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Exact inference by elimination: a tree of buckets, one per variable. Each holds a table over its variable and those
// that the variable's elimination binds; messages go up the tree (sums, or minima) and, for the marginals, down again.
// All numbers are costs, -log of weights.

#include <algorithm>
#include <cmath>
#include <vector>

#include "elimination_order.h"
#include "factors.h"
#include "log_sum.h"
#include "toposcope/geometry/large_array.h"
#include "watch.h"

namespace toposcope::posterior {

class Elimination {
 public:
  /// \param plan  feasible \throw OutOfTime
  Elimination(const FactorGraph& graph, const EliminationPlan& plan, Watch& watch)
      : graph_(graph), watch_(watch), order_(plan.order), buckets_(graph.variables()) {
    std::vector<std::size_t> rank(graph.variables());
    for (std::size_t i = 0; i < order_.size(); ++i) rank[order_[i]] = i;
    const auto earliest = [&](const std::vector<Index>& scope) {
      return *std::min_element(scope.begin(), scope.end(), [&](Index a, Index b) { return rank[a] < rank[b]; });
    };
    for (Index v = 0; v < graph.variables(); ++v) {
      Bucket& bucket = buckets_[v];
      bucket.variable = v;
      bucket.bound = plan.neighbors[v];
      bucket.rows = 1;
      for (const Index w : bucket.bound) bucket.rows *= graph.domain(w);
      bucket.table = large_array<double>(bucket.rows * graph.domain(v));
      bucket.message.resize(bucket.rows);
      watch.poll(bucket.table.size());
    }
    for (const Factor& factor : graph.factors) buckets_[earliest(factor.scope)].factors.push_back(&factor);
    for (const Index v : order_)
      if (!buckets_[v].bound.empty()) {
        buckets_[v].parent = &buckets_[earliest(buckets_[v].bound)];
        buckets_[v].parent->children.push_back(&buckets_[v]);
      }
  }

  /// Least cost of all labellings; the tables then hold what `k_best` reads. \throw OutOfTime
  double minimize() {
    return constant_and_roots([](const double* costs, std::size_t n) { return *std::min_element(costs, costs + n); });
  }

  /// -log of the sum over all labellings of exp(-cost). \throw OutOfTime
  double sum() { return constant_and_roots(soft_min); }

  /// Per variable, per value of the graph; after `sum`, which must have been finite. \throw OutOfTime
  std::vector<std::vector<double>> marginals() {
    std::vector<std::vector<double>> made(buckets_.size());
    std::vector<double> down, costs;
    for (std::size_t i = order_.size(); i-- > 0;) {
      Bucket& bucket = buckets_[order_[i]];
      if (bucket.parent) {
        project(*bucket.parent, bucket.bound, down);
        // What the rest of the tree says, without the bucket's own message.
        for (std::size_t row = 0; row < bucket.rows; ++row)
          down[row] = down[row] < forbidden ? down[row] - bucket.message[row] : forbidden;
        add(bucket, bucket.bound, down);
      }
      project(bucket, {bucket.variable}, costs);
      made[bucket.variable].resize(costs.size());
      normalize(costs.data(), costs.size(), made[bucket.variable].data());
    }
    return made;
  }

  /// After `minimize`: offers the k best labellings to `best`, as positions among the graph's values; each costs the
  /// least cost and what its values lie above the minima of their buckets.
  /// \return false when the list is not proven: more nodes were needed than `most_nodes`
  template <class Offer, class Limit>
  bool k_best(double least, const Offer& offer, const Limit& limit, std::size_t most_nodes) {
    std::vector<Index> at(buckets_.size(), 0);
    std::vector<std::vector<std::pair<double, Index>>> children(buckets_.size());
    std::size_t nodes = 0;
    return descend(order_.size(), least, at, children, offer, limit, most_nodes, nodes);
  }

 private:
  struct Bucket {
    Index variable = 0;
    std::vector<Index> bound;  ///< ascending
    std::size_t rows = 0;
    std::vector<double> table;    ///< over `bound`, then the variable
    std::vector<double> message;  ///< over `bound`
    std::vector<const Factor*> factors;
    Bucket* parent = nullptr;
    std::vector<Bucket*> children;
  };

  /// Strides of the variables of `scope` (ascending) in a table over it; 0 for a variable that is not of it.
  std::size_t stride(const std::vector<Index>& scope, Index variable) const {
    std::size_t stride = 1;
    for (std::size_t k = scope.size(); k-- > 0;) {
      if (scope[k] == variable) return stride;
      stride *= graph_.domain(scope[k]);
    }
    return 0;
  }

  /// For each row of a bucket's table: `visit(row, at)`, where `at` is the row's place in a table over `scope`.
  template <class Visit>
  void each_row(const Bucket& bucket, const std::vector<Index>& scope, const Visit& visit) {
    const std::size_t bound = bucket.bound.size();
    std::vector<std::size_t> strides(bound), digits(bound, 0);
    for (std::size_t k = 0; k < bound; ++k) strides[k] = stride(scope, bucket.bound[k]);
    std::size_t at = 0;
    const std::size_t width = graph_.domain(bucket.variable);
    for (std::size_t row = 0; row < bucket.rows; ++row) {
      visit(row, at);
      watch_.poll(width);
      for (std::size_t k = bound; k-- > 0;) {
        at += strides[k];
        if (++digits[k] < graph_.domain(bucket.bound[k])) break;
        at -= strides[k] * digits[k];
        digits[k] = 0;
      }
    }
  }

  void add(Bucket& bucket, const std::vector<Index>& scope, std::span<const double> costs) {
    const std::size_t width = graph_.domain(bucket.variable), step = stride(scope, bucket.variable);
    each_row(bucket, scope, [&](std::size_t row, std::size_t at) {
      double* to = bucket.table.data() + row * width;
      const double* from = costs.data() + at;
      if (step == 0)
        for (std::size_t i = 0; i < width; ++i) to[i] += *from;
      else
        for (std::size_t i = 0; i < width; ++i) to[i] += from[i * step];
    });
  }

  template <class Reduce>
  double constant_and_roots(const Reduce& reduce) {
    double total = graph_.constant;
    for (const Index v : order_) {
      Bucket& bucket = buckets_[v];
      const std::vector<double>& unary = graph_.unary[v];
      const std::size_t width = unary.size();
      for (std::size_t row = 0; row < bucket.rows; ++row) {
        std::copy(unary.begin(), unary.end(), bucket.table.begin() + static_cast<std::ptrdiff_t>(row * width));
        watch_.poll(width);
      }
      for (const Factor* factor : bucket.factors) add(bucket, factor->scope, factor->costs);
      for (const Bucket* child : bucket.children) add(bucket, child->bound, child->message);
      for (std::size_t row = 0; row < bucket.rows; ++row) {
        bucket.message[row] = reduce(bucket.table.data() + row * width, width);
        watch_.poll(10 * width);
      }
      if (!bucket.parent) total += bucket.message[0];
    }
    return total;
  }

  /// -log of the sums of exp(-table) over all variables but those of `scope`, which are of the bucket.
  void project(const Bucket& bucket, const std::vector<Index>& scope, std::vector<double>& costs) {
    std::size_t entries = 1;
    for (const Index v : scope) entries *= graph_.domain(v);
    const std::size_t width = graph_.domain(bucket.variable), step = stride(scope, bucket.variable);
    least_.assign(entries, forbidden);
    sums_.assign(entries, 0);
    each_row(bucket, scope, [&](std::size_t row, std::size_t at) {
      const double* from = bucket.table.data() + row * width;
      for (std::size_t i = 0; i < width; ++i) least_[at + i * step] = std::min(least_[at + i * step], from[i]);
    });
    each_row(bucket, scope, [&](std::size_t row, std::size_t at) {
      const double* from = bucket.table.data() + row * width;
      for (std::size_t i = 0; i < width; ++i)
        if (from[i] < forbidden) sums_[at + i * step] += std::exp(least_[at + i * step] - from[i]);
      watch_.poll(10 * width);
    });
    costs.resize(entries);
    for (std::size_t e = 0; e < entries; ++e)
      costs[e] = least_[e] < forbidden ? least_[e] - std::log(sums_[e]) : forbidden;
  }

  template <class Offer, class Limit>
  bool descend(std::size_t left, double cost, std::vector<Index>& at,
               std::vector<std::vector<std::pair<double, Index>>>& children, const Offer& offer, const Limit& limit,
               std::size_t most_nodes, std::size_t& nodes) {
    if (left == 0) {
      offer(at);
      return true;
    }
    const Bucket& bucket = buckets_[order_[left - 1]];
    std::size_t row = 0;
    for (const Index w : bucket.bound) row = row * graph_.domain(w) + at[w];
    const std::size_t width = graph_.domain(bucket.variable);
    auto& here = children[left - 1];
    here.clear();
    for (Index i = 0; i < width; ++i) {
      const double excess = bucket.table[row * width + i] - bucket.message[row];
      if (cost + excess < forbidden) here.emplace_back(cost + excess, i);
    }
    std::sort(here.begin(), here.end());
    for (std::size_t i = 0; i < here.size() && here[i].first <= limit(); ++i) {
      watch_.poll(width);
      // The first path down is always gone to its end.
      if (++nodes > most_nodes && nodes > buckets_.size()) return false;
      at[bucket.variable] = here[i].second;
      if (!descend(left - 1, here[i].first, at, children, offer, limit, most_nodes, nodes)) return false;
    }
    return true;
  }

  const FactorGraph& graph_;
  Watch& watch_;
  std::vector<Index> order_;
  std::vector<Bucket> buckets_;
  std::vector<double> least_, sums_;
};

}  // namespace toposcope::posterior
