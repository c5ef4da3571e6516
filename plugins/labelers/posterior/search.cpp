// SPDX-License-Identifier: BSD-3-Clause
#include "search.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace toposcope::posterior {

Search::Search(const FactorGraph& graph, const SearchTables& tables, double slack, Watch& watch, std::uint64_t& nodes)
    : graph_(graph),
      tables_(tables),
      slack_(slack),
      watch_(watch),
      nodes_(nodes),
      width_(tables.offsets.back()),
      at_(tables.depths(), 0),
      costs_(tables.depths() * width_),
      weights_(tables.depths() * width_),
      least_(tables.depths() * tables.depths()),
      log_mass_(least_.size()),
      touched_(tables.depths(), std::vector<char>(tables.depths(), 0)),
      children_(tables.depths()) {
  for (Index depth = 0; depth < tables.depths(); ++depth) {
    children_[depth].reserve(tables.domain(depth));
    log_domain_.push_back(std::log(static_cast<double>(tables.domain(depth))));
  }
  for (Index depth = 0; depth < tables.depths(); ++depth)
    for (const Increment& increment : tables.after[depth]) touched_[depth][increment.depth] = 1;
}

double Search::bytes(const FactorGraph& graph) {
  double values = 0;
  for (const std::vector<double>& unary : graph.unary) values += static_cast<double>(unary.size());
  const auto depths = static_cast<double>(graph.variables());
  return sizeof(double) * 2 * (depths * values + depths * depths + entries(graph)) + depths * depths;
}

bool Search::best(const Offer& offer, const BestLabelings& list, std::uint64_t most_nodes) {
  most_nodes_ = nodes_ + most_nodes;
  std::copy(tables_.root.begin(), tables_.root.end(), costs_.begin());
  labeling_.resize(tables_.depths());
  return descend(0, graph_.constant, offer, list);
}

Sums Search::sum(double reference, double tolerance, std::uint64_t most_nodes) {
  most_nodes_ = nodes_ + most_nodes;
  reference_ = reference;
  sums_ = Sums();
  sums_.values.assign(width_, 0);
  sums_.finished = true;
  sums_.omitted = std::exp(-underflow / 4);  // what underflows in all nodes together is far less
  std::copy(tables_.root.begin(), tables_.root.end(), costs_.begin());
  double rest = 0, rest_mass = 0;
  for (Index later = 0; later < tables_.depths(); ++later) {
    find_least(0, later);
    if (!(least(0, later) < forbidden)) return std::move(sums_);
    weigh(0, later);
    rest += least(0, later);
    rest_mass += log_mass(0, later);
  }
  sums_.total = add_up(0, graph_.constant, rest, rest_mass, tolerance);
  return std::move(sums_);
}

void Search::find_least(Index depth, Index later) {
  const double* cost = costs(depth);
  least(depth, later) = least_of(cost + tables_.offsets[later], tables_.domain(later));
}

void Search::weigh(Index depth, Index later) {
  const std::size_t first = tables_.offsets[later], last = tables_.offsets[later + 1];
  const double* cost = costs(depth);
  double* weight = weights(depth);
  const double low = least(depth, later);
  double sum = 0;
  for (std::size_t v = first; v < last; ++v) sum += weight[v] = std::exp(low - cost[v]);
  log_mass(depth, later) = std::log(sum);
  watch_.poll(10 * (last - first));
}

// The costs of the later values once the variable at `depth` has its value.
void Search::assign(Index depth, Index value) {
  at_[depth] = value;
  const std::size_t later = tables_.offsets[depth + 1];
  double* cost = costs(depth + 1);
  std::copy(costs(depth) + later, costs(depth) + width_, cost + later);
  for (const Increment& increment : tables_.after[depth]) {
    const double* row = increment.row(at_);
    double* to = cost + tables_.offsets[increment.depth];
    const std::size_t width = tables_.domain(increment.depth);
    for (std::size_t v = 0; v < width; ++v) to[v] += row[v];
  }
  ++nodes_;
  watch_.poll(2 * (width_ - later));
}

bool Search::descend(Index depth, double cost, const Offer& offer, const BestLabelings& list) {
  double rest = 0;  // what the later variables cost at least
  for (Index later = depth + 1; later < tables_.depths(); ++later)
    rest += least_of(costs(depth) + tables_.offsets[later], tables_.domain(later));
  const double* own = costs(depth) + tables_.offsets[depth];
  std::vector<Child>& children = children_[depth];
  children.clear();
  for (Index v = 0; v < tables_.domain(depth); ++v)
    if (cost + own[v] + rest <= list.limit() + slack_) children.push_back({cost + own[v] + rest, v});
  std::sort(children.begin(), children.end());
  for (std::size_t i = 0; i < children.size(); ++i) {
    const Child child = children[i];
    if (!(child.key <= list.limit() + slack_)) break;
    if (depth + 1 == tables_.depths()) {
      at_[depth] = child.value;
      for (Index d = 0; d < tables_.depths(); ++d) labeling_[tables_.order[d]] = at_[d];
      offer(labeling_);
      watch_.poll(100);
      continue;
    }
    if (nodes_ >= most_nodes_) return false;
    const double now = cost + own[child.value];
    assign(depth, child.value);
    if (!descend(depth + 1, now, offer, list)) return false;
  }
  return true;
}

// Sum over the labellings below a node but for what may be left out; adds each value's share.
// \param rest, rest_mass  least costs and log masses of this variable and the later ones, summed
double Search::add_up(Index depth, double cost, double rest, double rest_mass, double budget) {
  const std::size_t first = tables_.offsets[depth], domain = tables_.domain(depth);
  const double* weight = weights(depth) + first;
  double* shares = sums_.values.data() + first;
  if (depth + 1 == tables_.depths()) {
    const double scale = std::exp(reference_ - cost - rest);
    for (std::size_t v = 0; v < domain; ++v) shares[v] += scale * weight[v];
    return scale * std::exp(rest_mass);
  }
  const double exponent = reference_ - cost - rest + rest_mass - log_mass(depth, depth);
  const double* own = costs(depth) + first;
  const double top = bounded_exp(exponent), low = least(depth, depth);
  std::vector<Child>& children = children_[depth];
  children.clear();
  double open = 0;
  for (Index v = 0; v < domain; ++v) {
    // Where the bound lies far below the least cost, weights may underflow that are all there is.
    const double mass = exponent < underflow / 2 ? top * weight[v] : bounded_exp(exponent + low - own[v]);
    if (!(mass > 0)) continue;
    children.push_back({mass, v});
    open += mass;
  }
  std::sort(children.begin(), children.end());
  // The children of least mass may take half of what may be left out; each other has its part of what then is left.
  std::size_t kept = 0;
  const double half = budget / 2;
  for (double taken = 0; kept < children.size(); ++kept) {
    const double mass = children[kept].key;
    if (taken + mass > half) break;
    taken += mass;
    leave_out(mass, budget);
    open -= mass;
  }
  double total = 0;
  for (std::size_t i = children.size(); i-- > kept && sums_.finished;) {
    const Child child = children[i];
    const double allowed = budget * std::min(1.0, child.key / open);
    open -= child.key;
    const double share = visit(depth, child.value, cost + own[child.value], allowed, budget);
    shares[child.value] += share;
    total += share;
  }
  return total;
}

void Search::leave_out(double mass, double& budget) {
  sums_.omitted += mass;
  budget -= mass;
}

// One child of a node: what is left out of it is taken from its parent's `budget`.
double Search::visit(Index depth, Index value, double cost, double allowed, double& budget) {
  if (nodes_ >= most_nodes_) {
    sums_.finished = false;
    return 0;
  }
  assign(depth, value);
  double rest = 0, rest_mass = 0;
  for (Index later = depth + 1; later < tables_.depths(); ++later) {
    if (touched_[depth][later]) {
      find_least(depth + 1, later);
      rest_mass += log_domain_[later];
    } else {
      least(depth + 1, later) = least(depth, later);
      rest_mass += log_mass(depth, later);
    }
    rest += least(depth + 1, later);
  }
  if (!(rest < forbidden)) return 0;
  if (const double mass = bounded_exp(reference_ - cost - rest + rest_mass); mass <= allowed) {
    leave_out(mass, budget);
    return 0;
  }
  rest_mass = 0;
  for (Index later = depth + 1; later < tables_.depths(); ++later) {
    if (touched_[depth][later]) {
      weigh(depth + 1, later);
    } else {
      log_mass(depth + 1, later) = log_mass(depth, later);
      std::copy(weights(depth) + tables_.offsets[later], weights(depth) + tables_.offsets[later + 1],
                weights(depth + 1) + tables_.offsets[later]);
    }
    rest_mass += log_mass(depth + 1, later);
  }
  if (const double mass = bounded_exp(reference_ - cost - rest + rest_mass); mass <= allowed) {
    leave_out(mass, budget);
    return 0;
  }
  const double before = sums_.omitted;
  const double total = add_up(depth + 1, cost, rest, rest_mass, allowed);
  budget -= sums_.omitted - before;
  return total;
}

}  // namespace toposcope::posterior
