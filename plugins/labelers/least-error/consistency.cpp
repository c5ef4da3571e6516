// SPDX-License-Identifier: BSD-3-Clause
#include "consistency.h"

#include <algorithm>

namespace toposcope::least_error {

int Consistency::Queue::pop_last() {
  const int v = items.back();
  items.pop_back();
  in[static_cast<std::size_t>(v)] = 0;
  return v;
}

int Consistency::Queue::pop_greatest() {
  std::iter_swap(std::max_element(items.begin(), items.end()), items.end() - 1);
  return pop_last();
}

int Consistency::Queue::pop_least() {
  std::iter_swap(std::min_element(items.begin(), items.end()), items.end() - 1);
  return pop_last();
}

void Consistency::Queue::clear() {
  for (const int v : items) in[static_cast<std::size_t>(v)] = 0;
  items.clear();
}

Consistency::Consistency(SoftNetwork& network, Deadline& deadline) : network_(network), deadline_(deadline) {
  const auto n = static_cast<std::size_t>(network.variables());
  for (Queue* queue : {&arc_, &directional_, &existential_}) queue->in.assign(n, 0);
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

int Consistency::support(int variable) {
  gather(variable, false);
  int best = network_.values(variable)[0];
  const auto level = [&](int a) { return level_[static_cast<std::size_t>(a)]; };
  for (const int a : network_.values(variable))
    if (level(a) < level(best) || (level(a) == level(best) && a < best)) best = a;
  return best;
}

// Per value: its unary cost and the least that it costs together with each neighbour; the least of these.
Cost Consistency::gather(int variable, bool earlier_only) {
  const Cost* unary = network_.unary(variable);
  for (const int a : network_.values(variable)) level_[static_cast<std::size_t>(a)] = unary[a];
  for (const SoftNetwork::Use use : network_.uses(variable)) {
    const BinaryFunction& f = network_.function(use.function);
    if (earlier_only && f.variable[1 - use.side] > variable) continue;
    const Cost* weight = weights(use.function, 1 - use.side, true);
    const Cost* moved = network_.moved(f, use.side);
    for (const int a : network_.values(variable)) {
      Cost& level = level_[static_cast<std::size_t>(a)];
      level = std::min(infinite, level + row_least(f, use.side, a, weight) - moved[a]);
    }
  }
  Cost least = infinite;
  for (const int a : network_.values(variable)) least = std::min(least, level_[static_cast<std::size_t>(a)]);
  return least;
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

// Per value of the function's other variable: what is to be added to the table's entry, infinite where it is gone.
const Cost* Consistency::weights(int function, int other_side, bool with_unary) {
  const BinaryFunction& f = network_.function(function);
  const int other = f.variable[other_side];
  const Cost* unary = network_.unary(other);
  const Cost* moved = network_.moved(f, other_side);
  if (with_unary) {
    for (int b = 0; b < network_.size(other); ++b)
      weight_[static_cast<std::size_t>(b)] = std::min(infinite, unary[b] - moved[b]);
  } else {
    for (int b = 0; b < network_.size(other); ++b)
      weight_[static_cast<std::size_t>(b)] = is_forbidden(unary[b]) ? infinite : -moved[b];
  }
  return weight_.data();
}

Cost Consistency::row_least(const BinaryFunction& f, int side, int value, const Cost* weight) const {
  const int other = f.variable[1 - side], size = network_.size(other);
  const Cost* row = f.table[side].data() + static_cast<std::size_t>(value) * static_cast<std::size_t>(size);
  if (network_.count(other) * 4 > size) return least_sum(row, weight, size);
  Cost least = infinite;
  for (const int b : network_.values(other)) least = std::min(least, row[b] + weight[b]);
  return least;
}

// Every value of the variable on `side` gets a value of the other with which the function costs nothing.
bool Consistency::simple_supports(int function, int side) {
  BinaryFunction& f = network_.function(function);
  const int variable = f.variable[side];
  const Cost* weight = weights(function, 1 - side, false);
  Cost* unary = network_.unary(variable);
  Cost* moved = network_.moved(f, side);
  bool changed = false, raised = false;
  for (const int a : network_.values(variable)) {
    const Cost gain = row_least(f, side, a, weight) - moved[a];
    if (gain == 0) continue;
    if (!changed) {
      changed = true;
      network_.save_unary(variable);
      network_.save_moved(function, side);
    }
    if (is_forbidden(gain)) {
      unary[a] = infinite;  // dropped by node consistency
      raised = true;
      continue;
    }
    raised = raised || unary[a] == 0;
    moved[a] += gain;
    unary[a] += gain;
  }
  return !changed || settle(variable, raised);
}

// As simple_supports, counting the unary costs of the other variable, which give what is needed.
bool Consistency::full_supports(int function, int side) {
  BinaryFunction& f = network_.function(function);
  const int variable = f.variable[side], other = f.variable[1 - side];
  const int size = network_.size(other);
  const Cost* weight = weights(function, 1 - side, true);
  Cost* unary = network_.unary(variable);
  Cost* moved = network_.moved(f, side);
  bool changed = false;
  for (const int a : network_.values(variable)) {
    gain_[static_cast<std::size_t>(a)] = row_least(f, side, a, weight) - moved[a];
    changed = changed || gain_[static_cast<std::size_t>(a)] != 0;
  }
  if (!changed) return true;
  // What each value of the other must give: the most that any entry lacks of its row's gain.
  Cost* other_unary = network_.unary(other);
  Cost* other_moved = network_.moved(f, 1 - side);
  std::fill_n(need_.begin(), size, -infinite);
  bool raised = false;
  network_.save_unary(variable);
  network_.save_moved(function, side);
  for (const int a : network_.values(variable)) {
    const Cost gain = gain_[static_cast<std::size_t>(a)];
    if (is_forbidden(gain)) {
      unary[a] = infinite;
      raised = true;
      continue;
    }
    const Cost* row = f.table[side].data() + static_cast<std::size_t>(a) * static_cast<std::size_t>(size);
    raise(need_.data(), row, gain + moved[a], size);
    raised = raised || (gain > 0 && unary[a] == 0);
    moved[a] += gain;
    unary[a] += gain;
  }
  bool extended = false;
  for (const int b : network_.values(other)) {
    const Cost need = need_[static_cast<std::size_t>(b)] + other_moved[b];  // max over a of gain - cost(a, b)
    if (need <= 0) continue;
    if (!extended) {
      extended = true;
      network_.save_unary(other);
      network_.save_moved(function, 1 - side);
    }
    other_unary[b] -= need;
    other_moved[b] -= need;
  }
  return settle(variable, raised);
}

// Some value of the variable must cost nothing with every neighbour's best: else their costs come together in it.
bool Consistency::existential_support(int variable) {
  if (gather(variable, true) == 0) return true;
  for (const SoftNetwork::Use use : network_.uses(variable))
    if (network_.function(use.function).variable[1 - use.side] < variable && !full_supports(use.function, use.side))
      return false;
  return true;
}

bool Consistency::spread(Cost cutoff, int sweeps, double least_gain) {
  cutoff_ = cutoff;
  for (int sweep = 0; sweep < sweeps && !out_of_time(); ++sweep) {
    const Cost before = network_.constant();
    bool alive = true;
    for (int v = 0; v < network_.variables() && alive; ++v) alive = spread_from(v, true);
    for (int v = network_.variables() - 1; v >= 0 && alive; --v) alive = spread_from(v, false);
    if (!alive) {
      forget();
      return false;
    }
    if (network_.constant() - before < least_gain * (cutoff - before)) break;
  }
  return true;
}

bool Consistency::spread_from(int variable, bool to_later) {
  int later = 0, earlier = 0;
  const auto comes_later = [&](const SoftNetwork::Use use) {
    return network_.function(use.function).variable[1 - use.side] > variable;
  };
  for (const SoftNetwork::Use use : network_.uses(variable)) {
    ++(comes_later(use) ? later : earlier);
    if (!simple_supports(use.function, use.side)) return false;
  }
  if (!node_consistent(variable)) return false;
  const int shares = std::max(later, earlier);
  if (shares == 0) return true;
  const auto values = network_.values(variable);
  Cost* unary = network_.unary(variable);
  network_.save_unary(variable);
  for (const int a : values) gain_[static_cast<std::size_t>(a)] = unary[a] / shares;
  for (const SoftNetwork::Use use : network_.uses(variable)) {
    if (comes_later(use) != to_later) continue;
    network_.save_moved(use.function, use.side);
    Cost* moved = network_.moved(network_.function(use.function), use.side);
    for (const int a : values) {
      moved[a] -= gain_[static_cast<std::size_t>(a)];
      unary[a] -= gain_[static_cast<std::size_t>(a)];
    }
  }
  arc_.push(variable);
  return true;
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
      const int v = arc_.pop_last();
      if (!others(v, false, [&](int f, int side) { return simple_supports(f, side); })) return false;
    } else if (!directional_.empty()) {
      const int v = directional_.pop_greatest();
      if (!others(v, true, [&](int f, int side) { return full_supports(f, side); })) return false;
    } else if (!existential_.empty()) {
      if (!existential_support(existential_.pop_least())) return false;
    } else {
      return true;
    }
  }
}

}  // namespace toposcope::least_error
