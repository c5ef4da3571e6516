// SPDX-License-Identifier: BSD-3-Clause
#include "search_tables.h"

#include <cmath>
#include <utility>

namespace toposcope::posterior {

SearchTables::SearchTables(const FactorGraph& graph, std::vector<Index> search_order, Watch& watch)
    : order(std::move(search_order)), after(order.size()), graph_(graph), watch_(watch) {
  std::vector<Index> depth_of(order.size());
  offsets.push_back(0);
  for (Index depth = 0; depth < order.size(); ++depth) {
    depth_of[order[depth]] = depth;
    offsets.push_back(offsets.back() + graph.domain(order[depth]));
  }
  for (const Index v : order) root.insert(root.end(), graph.unary[v].begin(), graph.unary[v].end());
  std::vector<std::vector<Ordered>> ending(order.size());  // by the last variable of the scope
  for (const Factor& factor : graph.factors) {
    std::vector<Index> scope;
    for (const Index v : factor.scope) scope.push_back(depth_of[v]);
    std::sort(scope.begin(), scope.end());
    std::vector<Ordered>& here = ending[scope.back()];
    auto same = std::find_if(here.begin(), here.end(), [&](const Ordered& other) { return other.scope == scope; });
    if (same == here.end()) same = here.insert(here.end(), {scope, {}});
    for (Index& depth : scope) depth = order[depth];
    add_reordered(graph, factor, scope, same->table, watch);
    same->graded = same->graded || std::any_of(factor.costs.begin(), factor.costs.end(),
                                               [](double cost) { return cost != 0 && cost < forbidden; });
  }
  std::vector<double> shared;
  // From the last variable to the first: what its values cost is shared out among the factors that end at it, so that
  // their minima know of it. That moves costs about without changing any labelling's.
  for (Index depth = depths(); depth-- > 0;) {
    const auto informed = std::count_if(ending[depth].begin(), ending[depth].end(),
                                        [](const Ordered& ordered) { return ordered.graded; });
    const std::size_t width = domain(depth);
    double* own = root.data() + offsets[depth];
    for (Ordered& ordered : ending[depth]) {
      if (ordered.graded) {
        shared.resize(width);
        for (std::size_t v = 0; v < width; ++v) shared[v] = own[v] / static_cast<double>(informed);
        for (std::size_t entry = 0; entry < ordered.table.size(); entry += width) {
          double* row = ordered.table.data() + entry;
          for (std::size_t v = 0; v < width; ++v) row[v] += shared[v];
          watch_.poll(width);
        }
      }
      add_increments(ordered.scope, std::move(ordered.table));
    }
    if (informed > 0)
      for (std::size_t v = 0; v < width; ++v)
        if (own[v] < forbidden) own[v] = 0;
  }
}

double SearchTables::bound() const {
  double sum = graph_.constant;
  for (std::size_t depth = 0; depth < order.size(); ++depth)
    sum += *std::min_element(root.data() + offsets[depth], root.data() + offsets[depth + 1]);
  return sum;
}

// Minima over the last variable, the last two, ... and the differences between one such table and the next.
void SearchTables::add_increments(const std::vector<Index>& scope, std::vector<double> table) {
  for (std::size_t k = scope.size(); k-- > 0;) {
    const std::size_t width = domain(scope[k]);
    if (k == 0) {
      for (std::size_t v = 0; v < width; ++v) root[offsets[scope[0]] + v] += table[v];
      return;
    }
    std::vector<double> least(table.size() / width);
    for (std::size_t row = 0; row < least.size(); ++row) {
      double* first = table.data() + row * width;
      least[row] = least_of(first, width);
      if (least[row] < forbidden)  // else the value before is forbidden and the row never asked for
        for (std::size_t v = 0; v < width; ++v) first[v] -= least[row];
      watch_.poll(2 * width);
    }
    Increment increment;
    increment.depth = scope[k];
    increment.earlier.assign(scope.begin(), scope.begin() + static_cast<std::ptrdiff_t>(k));
    increment.strides.assign(k, width);
    for (std::size_t i = k - 1; i-- > 0;) increment.strides[i] = increment.strides[i + 1] * domain(scope[i + 1]);
    increment.table = std::move(table);
    after[scope[k - 1]].push_back(std::move(increment));
    table = std::move(least);
  }
}

}  // namespace toposcope::posterior
