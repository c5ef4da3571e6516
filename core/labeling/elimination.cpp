// SPDX-License-Identifier: BSD-3-Clause
#include "toposcope/labeling/elimination.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "toposcope/geometry/large_array.h"
#include "toposcope/labeling/log_sum.h"

namespace toposcope::factors {

Elimination::Elimination(const FactorGraph& graph, const EliminationPlan& plan, Watch& watch)
    : graph_(graph), watch_(watch), order_(plan.order), buckets_(graph.variables()) {
  std::vector<std::size_t> rank(graph.variables());
  for (std::size_t i = 0; i < order_.size(); ++i) rank[order_[i]] = i;
  // Variables of one value bind nothing: a table goes to the first of the others.
  const auto earliest = [&](const std::vector<Index>& scope) {
    return *std::min_element(scope.begin(), scope.end(), [&](Index a, Index b) {
      return std::pair(graph.domain(a) < 2, rank[a]) < std::pair(graph.domain(b) < 2, rank[b]);
    });
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

double Elimination::minimize() {
  return constant_and_roots([](const double* costs, std::size_t n) { return *std::min_element(costs, costs + n); });
}

double Elimination::sum() {
  return constant_and_roots(soft_min);
}

std::vector<std::vector<double>> Elimination::marginals() {
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

// Strides of the variables of `scope` (ascending) in a table over it; 0 for a variable that is not of it.
std::size_t Elimination::stride(const std::vector<Index>& scope, Index variable) const {
  std::size_t stride = 1;
  for (std::size_t k = scope.size(); k-- > 0;) {
    if (scope[k] == variable) return stride;
    stride *= graph_.domain(scope[k]);
  }
  return 0;
}

// For each row of a bucket's table: `visit(row, at)`, where `at` is the row's place in a table over `scope`.
template <class Visit>
void Elimination::each_row(const Bucket& bucket, const std::vector<Index>& scope, const Visit& visit) {
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

void Elimination::add(Bucket& bucket, const std::vector<Index>& scope, std::span<const double> costs) {
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
double Elimination::constant_and_roots(const Reduce& reduce) {
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

// -log of the sums of exp(-table) over all variables but those of `scope`, which are of the bucket.
void Elimination::project(const Bucket& bucket, const std::vector<Index>& scope, std::vector<double>& costs) {
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

}  // namespace toposcope::factors
