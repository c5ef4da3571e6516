// SPDX-License-Identifier: BSD-3-Clause
#include "soft_network.h"

#include <algorithm>
#include <cmath>

namespace toposcope::least_error {

void SoftNetwork::remove(int variable, int value) {
  const int first = first_[variable], last = --count_[variable];
  const int at = place_[first + value], moved = order_[first + last];
  std::swap(order_[first + at], order_[first + last]);
  place_[first + moved] = at;
  place_[first + value] = last;
  if (!marks_.empty()) removed_.push_back(variable);
}

// Joins a waiting function to the binary one of the (at most) two variables that are still open; -1: it waits on.
int SoftNetwork::release(int d) {
  if (released_[static_cast<std::size_t>(d)]) return -1;
  const DelayedFunction& delayed = delayed_[static_cast<std::size_t>(d)];
  std::size_t pair[2] = {0, 0}, open = 0;
  for (std::size_t k = 0; k < delayed.variables.size(); ++k)
    if (count_[delayed.variables[k]] > 1) {
      if (open == 2) return -1;
      pair[open++] = k;
    }
  for (std::size_t k = 0; open < 2; ++k)  // fill up with assigned ones
    if (open == 0 || k != pair[0]) pair[open++] = k;
  if (pair[0] > pair[1]) std::swap(pair[0], pair[1]);
  std::size_t base = 0;
  for (std::size_t k = 0; k < delayed.variables.size(); ++k)
    if (k != pair[0] && k != pair[1])
      base += delayed.strides[k] * static_cast<std::size_t>(values(delayed.variables[k])[0]);
  const int x = delayed.variables[pair[0]], y = delayed.variables[pair[1]];
  const int index = between_.at(std::minmax(x, y));
  BinaryFunction& f = functions_[static_cast<std::size_t>(index)];
  releases_.push_back({d, index, released_costs_.size()});
  if (!marks_.empty()) released_costs_.insert(released_costs_.end(), f.table[0].begin(), f.table[0].end());
  released_[static_cast<std::size_t>(d)] = 1;
  const std::size_t side = f.variable[0] == x ? 0 : 1;
  const std::size_t rows = static_cast<std::size_t>(size_[x]), columns = static_cast<std::size_t>(size_[y]);
  for (std::size_t a = 0; a < rows; ++a)
    for (std::size_t b = 0; b < columns; ++b) {
      Cost& cost = f.table[side][a * columns + b];
      cost = saturated(cost, delayed.table[base + a * delayed.strides[pair[0]] + b * delayed.strides[pair[1]]]);
      f.table[1 - side][b * rows + a] = cost;
    }
  return index;
}

void SoftNetwork::mark() {
  marks_.push_back({saved_.size(), saved_costs_.size(), removed_.size(), releases_.size(), constant_, now_});
  now_ = ++stamps_;
}

void SoftNetwork::undo() {
  const Mark mark = marks_.back();
  marks_.pop_back();
  while (saved_.size() > mark.saved) {
    const Saved& saved = saved_.back();
    std::copy_n(saved_costs_.begin() + static_cast<std::ptrdiff_t>(saved.data), saved.length,
                costs_.begin() + static_cast<std::ptrdiff_t>(saved.offset));
    *saved.stamp = saved.old_stamp;
    saved_.pop_back();
  }
  saved_costs_.resize(mark.data);
  for (; removed_.size() > mark.removed; removed_.pop_back()) ++count_[removed_.back()];
  for (; releases_.size() > mark.released; releases_.pop_back()) {
    const Release& release = releases_.back();
    released_[static_cast<std::size_t>(release.delayed)] = 0;
    BinaryFunction& f = functions_[static_cast<std::size_t>(release.function)];
    const std::size_t rows = static_cast<std::size_t>(size_[f.variable[0]]);
    const std::size_t columns = static_cast<std::size_t>(size_[f.variable[1]]);
    std::copy_n(released_costs_.begin() + static_cast<std::ptrdiff_t>(release.data), rows * columns,
                f.table[0].begin());
    for (std::size_t a = 0; a < rows; ++a)
      for (std::size_t b = 0; b < columns; ++b) f.table[1][b * rows + a] = f.table[0][a * columns + b];
    released_costs_.resize(release.data);
  }
  constant_ = mark.constant;
  now_ = mark.stamp;
}

double SoftNetwork::bound(Cost constant) const {
  if (step_ > 0) return to_cost(step_ * (std::ceil(constant / step_) - exact_error));
  return to_cost(static_cast<double>(constant) - error_);
}

Cost SoftNetwork::cutoff(double limit, bool inclusive) const {
  double units = (limit - offset_) * scale_;
  if (step_ > 0) {
    // A labelling below the limit is below it by a whole step.
    const double steps = units / step_;
    units = step_ * (inclusive ? std::floor(steps + exact_error) : std::ceil(steps - exact_error) - 1) + 1;
  } else {
    units = inclusive ? std::floor(units + error_) + 1 : std::ceil(units + error_);
  }
  return static_cast<Cost>(std::clamp(units, -static_cast<double>(infinite / 4), largest_sum * 1.5));
}

}  // namespace toposcope::least_error
