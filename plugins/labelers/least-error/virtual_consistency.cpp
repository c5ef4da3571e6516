// SPDX-License-Identifier: BSD-3-Clause
#include "virtual_consistency.h"

#include <algorithm>

namespace toposcope::least_error {
namespace {

constexpr std::int64_t most_needed = std::int64_t{1} << 24;
constexpr double least_gain = 1e-4;  // of the gap, over all steps of a threshold that go on

}  // namespace

VirtualConsistency::VirtualConsistency(SoftNetwork& network) : network_(network) {
  std::size_t values = 0, moves = 0;
  for (int v = 0; v < network.variables(); ++v) {
    first_.push_back(values);
    values += static_cast<std::size_t>(network.size(v));
  }
  for (std::size_t f = 0; f < network.function_count(); ++f)
    for (const int v : network.function(static_cast<int>(f)).variable) {
      block_.push_back(moves);
      moves += static_cast<std::size_t>(network.size(v));
    }
  alive_.resize(values);
  wanted_.resize(values);
  need_.resize(values);
  moves_.resize(moves);
  extended_.resize(moves);
  queued_.resize(static_cast<std::size_t>(network.variables()));
}

Cost VirtualConsistency::cost(const BinaryFunction& f, int a, int b) const {
  const auto width = static_cast<std::size_t>(network_.size(f.variable[1]));
  return f.table[0][static_cast<std::size_t>(a) * width + static_cast<std::size_t>(b)] - network_.moved(f, 0)[a] -
         network_.moved(f, 1)[b];
}

void VirtualConsistency::enforce(Cost cutoff, Deadline& deadline) {
  Cost threshold = 1;
  while (threshold < (cutoff - network_.constant()) / 2) threshold *= 2;
  for (; threshold >= 1; threshold /= 2)
    while (!deadline.reached()) {
      const int variable = wiped_out(threshold);
      if (variable < 0) break;
      trace(variable, threshold);
      const Cost gain = step(variable);
      if (gain < 1) break;
      take(variable, gain);
      if (network_.constant() >= cutoff) return;
      if (gain < least_gain * (cutoff - network_.constant())) break;
    }
}

// Arc consistency of the problem in which what costs less than the threshold is allowed. \return a variable without
// values, or -1
int VirtualConsistency::wiped_out(Cost threshold) {
  removed_.clear();
  queue_.clear();
  for (int v = 0; v < network_.variables(); ++v) {
    const auto v_index = static_cast<std::size_t>(v);
    std::fill_n(alive_.begin() + static_cast<std::ptrdiff_t>(first_[v_index]), network_.size(v), 0);
    for (const int a : network_.values(v))
      alive_[first_[v_index] + static_cast<std::size_t>(a)] = network_.unary(v)[a] < threshold;
    queued_[v_index] = 1;
    queue_.push_back(v);
  }
  for (std::size_t next = 0; next < queue_.size(); ++next) {
    const int v = queue_[next];
    queued_[static_cast<std::size_t>(v)] = 0;
    const char* support = alive_.data() + first_[static_cast<std::size_t>(v)];
    for (const SoftNetwork::Use use : network_.uses(v)) {
      const BinaryFunction& f = network_.function(use.function);
      const int side = 1 - use.side, other = f.variable[side], width = network_.size(v);
      const Cost* moved = network_.moved(f, use.side);
      char* alive = alive_.data() + first_[static_cast<std::size_t>(other)];
      bool lost = false, some = false;
      for (const int a : network_.values(other)) {
        if (!alive[a]) continue;
        const Cost* row = f.table[side].data() + static_cast<std::size_t>(a) * static_cast<std::size_t>(width);
        const Cost limit = threshold + network_.moved(f, side)[a];
        bool supported = false;
        for (int b = 0; b < width && !supported; ++b) supported = support[b] && row[b] - moved[b] < limit;
        if (supported) {
          some = true;
        } else {
          alive[a] = 0;
          lost = true;
          removed_.push_back({other, a, use.function, side});
        }
      }
      if (!some) return other;
      if (lost && !queued_[static_cast<std::size_t>(other)]) {
        queued_[static_cast<std::size_t>(other)] = 1;
        queue_.push_back(other);
      }
    }
  }
  return -1;
}

// From the variable that lost all values back to the costs that made them fall: how much of each a unit of gain asks.
void VirtualConsistency::trace(int variable, Cost threshold) {
  std::fill(wanted_.begin(), wanted_.end(), 0);
  std::fill(need_.begin(), need_.end(), 0);
  std::fill(moves_.begin(), moves_.end(), 0);
  std::fill(extended_.begin(), extended_.end(), 0);
  for (const int a : network_.values(variable)) {
    const std::size_t at = first_[static_cast<std::size_t>(variable)] + static_cast<std::size_t>(a);
    need_[at] = 1;
    wanted_[at] = network_.unary(variable)[a] < threshold;
  }
  for (std::size_t k = removed_.size(); k-- > 0;) {
    const Removed& removed = removed_[k];
    const std::size_t at = first_[static_cast<std::size_t>(removed.variable)] + static_cast<std::size_t>(removed.value);
    if (!wanted_[at]) continue;
    const BinaryFunction& f = network_.function(removed.function);
    const int other_side = 1 - removed.side, other = f.variable[other_side];
    const std::size_t other_block =
        block_[2 * static_cast<std::size_t>(removed.function) + static_cast<std::size_t>(other_side)];
    moves_[block_[2 * static_cast<std::size_t>(removed.function) + static_cast<std::size_t>(removed.side)] +
           static_cast<std::size_t>(removed.value)] += need_[at];
    for (const int b : network_.values(other)) {
      const Cost tuple = removed.side == 0 ? cost(f, removed.value, b) : cost(f, b, removed.value);
      if (tuple >= threshold) continue;
      std::int64_t& extended = extended_[other_block + static_cast<std::size_t>(b)];
      if (need_[at] <= extended) continue;
      const std::size_t other_at = first_[static_cast<std::size_t>(other)] + static_cast<std::size_t>(b);
      const std::int64_t more = need_[at] - extended;
      need_[other_at] = std::min(most_needed, need_[other_at] + more);
      moves_[other_block + static_cast<std::size_t>(b)] -= more;
      extended = need_[at];
      if (network_.unary(other)[b] < threshold) wanted_[other_at] = 1;
    }
  }
}

// The longest step along the moves that leaves no cost negative.
Cost VirtualConsistency::step(int variable) const {
  std::int64_t longest = infinite / 4;
  const auto allow = [&](std::int64_t cost, std::int64_t taken) {
    if (taken > 0 && !is_forbidden(static_cast<Cost>(std::min<std::int64_t>(cost, infinite))))
      longest = std::min(longest, cost / taken);
  };
  for (int v = 0; v < network_.variables(); ++v)
    for (const int a : network_.values(v)) {
      std::int64_t taken = v == variable ? 1 : 0;
      for (const SoftNetwork::Use use : network_.uses(v))
        taken -= moves_[block_[2 * static_cast<std::size_t>(use.function) + static_cast<std::size_t>(use.side)] +
                        static_cast<std::size_t>(a)];
      allow(network_.unary(v)[a], taken);
    }
  for (std::size_t f = 0; f < network_.function_count() && longest > 0; ++f) {
    const BinaryFunction& function = network_.function(static_cast<int>(f));
    const std::int64_t* x = moves_.data() + block_[2 * f];
    const std::int64_t* y = moves_.data() + block_[2 * f + 1];
    for (const int a : network_.values(function.variable[0]))
      for (const int b : network_.values(function.variable[1]))
        if (x[a] + y[b] > 0) allow(cost(function, a, b), x[a] + y[b]);
  }
  return static_cast<Cost>(longest);
}

void VirtualConsistency::take(int variable, Cost step) {
  for (std::size_t f = 0; f < network_.function_count(); ++f)
    for (int side = 0; side < 2; ++side) {
      const BinaryFunction& function = network_.function(static_cast<int>(f));
      const int v = function.variable[side];
      const std::int64_t* moves = moves_.data() + block_[2 * f + static_cast<std::size_t>(side)];
      Cost* moved = network_.moved(function, side);
      Cost* unary = network_.unary(v);
      for (const int a : network_.values(v)) {
        moved[a] += static_cast<Cost>(step * moves[a]);
        unary[a] += static_cast<Cost>(step * moves[a]);
      }
    }
  Cost* unary = network_.unary(variable);
  for (const int a : network_.values(variable)) unary[a] -= step;
  network_.add_constant(step);
}

}  // namespace toposcope::least_error
