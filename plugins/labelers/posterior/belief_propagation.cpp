// SPDX-License-Identifier: BSD-3-Clause
#include "belief_propagation.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "toposcope/labeling/log_sum.h"

namespace toposcope::posterior {

BeliefPropagation::BeliefPropagation(const FactorGraph& graph, Watch& watch)
    : graph_(graph), watch_(&watch), beliefs_(graph.unary), messages_(graph.factors.size()) {
  std::size_t widest = 0;
  for (std::size_t f = 0; f < graph.factors.size(); ++f)
    for (const Index v : graph.factors[f].scope) {
      messages_[f].emplace_back(graph.domain(v), 0.0);
      widest = std::max(widest, graph.domain(v));
    }
  sums_.resize(widest);
  fresh_.resize(widest);
}

bool BeliefPropagation::forest() const {
  std::vector<std::size_t> root(graph_.variables() + graph_.factors.size());
  std::iota(root.begin(), root.end(), std::size_t{0});
  const auto find = [&](std::size_t i) {
    while (root[i] != i) i = root[i] = root[root[i]];
    return i;
  };
  for (std::size_t f = 0; f < graph_.factors.size(); ++f)
    for (const Index v : graph_.factors[f].scope) {
      const std::size_t a = find(graph_.variables() + f), b = find(v);
      if (a == b) return false;
      root[a] = b;
    }
  return true;
}

double BeliefPropagation::sweep(double damping) {
  double residual = 0;
  const std::size_t count = graph_.factors.size();
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t f = sweeps_ % 2 == 0 ? i : count - 1 - i;
    for (std::size_t k = 0; k < graph_.factors[f].scope.size(); ++k) residual = std::max(residual, send(f, k, damping));
  }
  ++sweeps_;
  // Beliefs were kept up to date by differences; now afresh, so that rounding does not gather.
  beliefs_ = graph_.unary;
  for (std::size_t f = 0; f < count; ++f)
    for (std::size_t k = 0; k < messages_[f].size(); ++k) {
      std::vector<double>& belief = beliefs_[graph_.factors[f].scope[k]];
      for (std::size_t i = 0; i < belief.size(); ++i) belief[i] += messages_[f][k][i];
    }
  return residual;
}

std::vector<std::vector<double>> BeliefPropagation::marginals() const {
  std::vector<std::vector<double>> made(beliefs_.size());
  for (Index v = 0; v < beliefs_.size(); ++v) {
    made[v].resize(beliefs_[v].size());
    normalize(beliefs_[v].data(), beliefs_[v].size(), made[v].data());
  }
  return made;
}

bool BeliefPropagation::contradiction() const {
  return std::any_of(beliefs_.begin(), beliefs_.end(), [](const std::vector<double>& belief) {
    return !(*std::min_element(belief.begin(), belief.end()) < forbidden);
  });
}

double BeliefPropagation::bethe_log_evidence() {
  double log_z = -graph_.constant;
  for (const std::vector<double>& belief : beliefs_) log_z -= soft_min(belief.data(), belief.size());
  for (std::size_t f = 0; f < graph_.factors.size(); ++f) {
    const Factor& factor = graph_.factors[f];
    incoming_.resize(factor.scope.size());
    for (std::size_t k = 0; k < factor.scope.size(); ++k) {
      incoming(f, k);
      const std::vector<double>& belief = beliefs_[factor.scope[k]];
      log_z += soft_min(belief.data(), belief.size());
    }
    log_z -= reduce(factor, factor.scope.size());
  }
  return log_z;
}

// What the variable at place k says to the factor: its belief without the factor's own message.
void BeliefPropagation::incoming(std::size_t f, std::size_t k) {
  const std::vector<double>& belief = beliefs_[graph_.factors[f].scope[k]];
  const std::vector<double>& own = messages_[f][k];
  incoming_[k].resize(belief.size());
  for (std::size_t i = 0; i < belief.size(); ++i)
    incoming_[k][i] = belief[i] < forbidden ? belief[i] - own[i] : forbidden;
}

// Visits the factor's rows over its last variable with the incoming costs of all variables of the row but `without`.
template <class Visit>
void BeliefPropagation::each_row(const Factor& factor, std::size_t without, const Visit& visit) {
  const std::size_t last = factor.scope.size() - 1, width = graph_.domain(factor.scope[last]);
  digits_.assign(factor.scope.size(), 0);
  for (std::size_t entry = 0; entry < factor.costs.size(); entry += width) {
    double row = 0;
    for (std::size_t k = 0; k < last; ++k)
      if (k != without) row += incoming_[k][digits_[k]];
    if (row < forbidden) visit(factor.costs.data() + entry, row);
    watch_->poll(10 * width);
    for (std::size_t k = last; k-- > 0;) {
      if (++digits_[k] < graph_.domain(factor.scope[k])) break;
      digits_[k] = 0;
    }
  }
}

// -log of the sum of exp(-cost) over the factor with all that comes in; with `k` of the scope, per value of that
// variable into `fresh_`, without what comes from it.
double BeliefPropagation::reduce(const Factor& factor, std::size_t k) {
  const std::size_t last = factor.scope.size() - 1, width = graph_.domain(factor.scope[last]);
  const std::size_t domain = k <= last ? graph_.domain(factor.scope[k]) : 1;
  const double* tail = incoming_[last].data();
  std::fill_n(fresh_.begin(), domain, forbidden);
  std::fill_n(sums_.begin(), domain, 0.0);
  const auto place = [&](std::size_t i) { return k > last ? 0 : k == last ? i : digits_[k]; };
  each_row(factor, k, [&](const double* costs, double row) {
    for (std::size_t i = 0; i < width; ++i) {
      const double cost = costs[i] + row + (k == last ? 0 : tail[i]);
      fresh_[place(i)] = std::min(fresh_[place(i)], cost);
    }
  });
  each_row(factor, k, [&](const double* costs, double row) {
    for (std::size_t i = 0; i < width; ++i) {
      const double cost = costs[i] + row + (k == last ? 0 : tail[i]);
      if (cost < forbidden) sums_[place(i)] += std::exp(fresh_[place(i)] - cost);
    }
  });
  for (std::size_t i = 0; i < domain; ++i)
    if (fresh_[i] < forbidden) fresh_[i] -= std::log(sums_[i]);
  return fresh_[0];
}

// The message of a factor to the variable at place k of its scope. \return its largest change
double BeliefPropagation::send(std::size_t f, std::size_t k, double damping) {
  const Factor& factor = graph_.factors[f];
  incoming_.resize(factor.scope.size());
  for (std::size_t j = 0; j < factor.scope.size(); ++j) incoming(f, j);
  reduce(factor, k);
  std::vector<double>& message = messages_[f][k];
  std::vector<double>& belief = beliefs_[factor.scope[k]];
  const double least = *std::min_element(fresh_.begin(), fresh_.begin() + static_cast<std::ptrdiff_t>(message.size()));
  if (!(least < forbidden)) {
    std::fill(belief.begin(), belief.end(), forbidden);
    std::fill(message.begin(), message.end(), forbidden);
    return 0;
  }
  double change = 0;
  for (std::size_t i = 0; i < message.size(); ++i) {
    double value = fresh_[i] - least;
    if (value < forbidden && message[i] < forbidden) {
      value = (1 - damping) * value + damping * message[i];
      change = std::max(change, std::abs(value - message[i]));
    } else if (message[i] < forbidden) {
      change = forbidden;
    }
    belief[i] = value < forbidden && belief[i] < forbidden ? belief[i] - message[i] + value : forbidden;
    message[i] = value < forbidden && message[i] < forbidden ? value : forbidden;
  }
  return change;
}

}  // namespace toposcope::posterior
