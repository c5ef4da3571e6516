// SPDX-License-Identifier: BSD-3-Clause
// What a value can lean on: the values of its neighbours with which it costs least.

#include <algorithm>

#include "consistency.h"

namespace toposcope::least_error {

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

int Consistency::support(int variable) {
  gather(variable, false);
  int best = network_.values(variable)[0];
  const auto level = [&](int a) { return level_[static_cast<std::size_t>(a)]; };
  for (const int a : network_.values(variable))
    if (level(a) < level(best) || (level(a) == level(best) && a < best)) best = a;
  return best;
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

}  // namespace toposcope::least_error
