// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "consistency.h"

namespace toposcope::least_error {

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

}  // namespace toposcope::least_error
