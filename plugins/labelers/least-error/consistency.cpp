// SPDX-License-Identifier: BSD-3-Clause
#include "consistency.h"

#include <algorithm>
#include <cstdlib>

namespace toposcope::least_error {

void Consistency::Queue::push(int variable) {
  if (in_[static_cast<std::size_t>(variable)]) return;
  in_[static_cast<std::size_t>(variable)] = 1;
  heap_.push_back(order_ == Order::least_first ? -variable : variable);
  if (order_ != Order::any) std::push_heap(heap_.begin(), heap_.end());
}

int Consistency::Queue::pop() {
  if (order_ != Order::any) std::pop_heap(heap_.begin(), heap_.end());
  const int variable = order_ == Order::least_first ? -heap_.back() : heap_.back();
  heap_.pop_back();
  in_[static_cast<std::size_t>(variable)] = 0;
  return variable;
}

void Consistency::Queue::clear() {
  for (const int key : heap_) in_[static_cast<std::size_t>(std::abs(key))] = 0;
  heap_.clear();
}

Consistency::Consistency(SoftNetwork& network, Deadline& deadline)
    : network_(network),
      deadline_(deadline),
      arc_(Order::any, static_cast<std::size_t>(network.variables())),
      directional_(Order::greatest_first, static_cast<std::size_t>(network.variables())),
      existential_(Order::least_first, static_cast<std::size_t>(network.variables())) {
  int widest = 1;
  for (int v = 0; v < network.variables(); ++v) {
    widest = std::max(widest, network.size(v));
    if (network.count(v) == 1) fresh_.push_back(v);
  }
  for (std::vector<Cost>* scratch : {&weight_, &need_, &level_, &gain_})
    scratch->resize(static_cast<std::size_t>(widest));
  touch_all();
}

void Consistency::touch_all() {
  for (int v = 0; v < network_.variables(); ++v) {
    arc_.push(v);
    directional_.push(v);
    existential_.push(v);
  }
}

// A value goes; whoever leaned on it is to look again.
bool Consistency::lose(int variable, int value) {
  network_.save_unary(variable);
  network_.unary(variable)[value] = infinite;
  network_.remove(variable, value);
  arc_.push(variable);
  directional_.push(variable);
  existential_.push(variable);
  for (const SoftNetwork::Use use : network_.uses(variable))
    existential_.push(network_.function(use.function).variable[1 - use.side]);
  if (network_.count(variable) == 1) fresh_.push_back(variable);
  return network_.count(variable) > 0;
}

void Consistency::remove(int variable, int value) {
  lose(variable, value);
}

void Consistency::assign(int variable, int value) {
  const auto values = network_.values(variable);
  std::vector<int> others(values.begin(), values.end());
  for (const int other : others)
    if (other != value) lose(variable, other);
}

// Takes the least unary cost to the constant and drops what is too costly.
bool Consistency::node_consistent(int variable) {
  Cost* unary = network_.unary(variable);
  if (network_.count(variable) == 0) return false;
  Cost least = infinite;
  for (const int a : network_.values(variable)) least = std::min(least, unary[a]);
  if (is_forbidden(least)) return false;
  if (least > 0) {
    network_.save_unary(variable);
    for (const int a : network_.values(variable))
      if (!is_forbidden(unary[a])) unary[a] -= least;
    network_.add_constant(least);
    if (network_.constant() >= cutoff_) return false;
  }
  const Cost room = cutoff_ - network_.constant();
  const auto values = network_.values(variable);
  for (int k = static_cast<int>(values.size()) - 1; k >= 0; --k) {
    const int a = values[static_cast<std::size_t>(k)];
    if (unary[a] >= room && !lose(variable, a)) return false;
  }
  return true;
}

bool Consistency::all_node_consistent() {
  do {
    seen_constant_ = network_.constant();
    for (int v = 0; v < network_.variables(); ++v)
      if (!node_consistent(v)) return false;
  } while (network_.constant() > seen_constant_);
  return true;
}

// What has to be known after unary costs of a variable changed.
bool Consistency::settle(int variable, bool raised) {
  if (raised) {
    directional_.push(variable);
    existential_.push(variable);
    for (const SoftNetwork::Use use : network_.uses(variable))
      existential_.push(network_.function(use.function).variable[1 - use.side]);
  }
  return node_consistent(variable);
}

void Consistency::forget() {
  for (Queue* queue : {&arc_, &directional_, &existential_}) queue->clear();
  fresh_.clear();
}

bool Consistency::out_of_time() {
  interrupted_ = interrupted_ || deadline_.reached();
  return interrupted_;
}

bool Consistency::propagate(Cost cutoff) {
  cutoff_ = cutoff;
  seen_constant_ = -infinite;
  const bool consistent = run();
  if (!consistent || interrupted_) forget();
  return consistent;
}

bool Consistency::run() {
  if (network_.constant() >= cutoff_) return false;
  const auto others = [&](int v, bool smaller_only, auto&& support) {
    for (const SoftNetwork::Use use : network_.uses(v)) {
      const int other = network_.function(use.function).variable[1 - use.side];
      if (smaller_only && other > v) continue;
      if (!support(use.function, 1 - use.side)) {
        network_.function(use.function).weight += 1;
        return false;
      }
    }
    return true;
  };
  while (true) {
    if ((++steps_ & 63U) == 0 && out_of_time()) return true;
    if (network_.constant() > seen_constant_ && !all_node_consistent()) return false;
    if (!fresh_.empty()) {
      const int v = fresh_.back();
      fresh_.pop_back();
      if (network_.count(v) != 1) return false;
      bool alive = true;
      network_.assigned(
          v, [&](int other, int value) { alive = lose(other, value) && alive; },
          [&](int f) {
            for (const int each : network_.function(f).variable) {
              arc_.push(each);
              directional_.push(each);
              existential_.push(each);
            }
          });
      if (!alive) return false;
    } else if (!arc_.empty()) {
      const int v = arc_.pop();
      if (!others(v, false, [&](int f, int side) { return simple_supports(f, side); })) return false;
    } else if (!directional_.empty()) {
      const int v = directional_.pop();
      if (!others(v, true, [&](int f, int side) { return full_supports(f, side); })) return false;
    } else if (!existential_.empty()) {
      if (!existential_support(existential_.pop())) return false;
    } else {
      return true;
    }
  }
}

}  // namespace toposcope::least_error
