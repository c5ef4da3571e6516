// SPDX-License-Identifier: BSD-3-Clause
#include "branch_and_bound.h"

#include <algorithm>
#include <cmath>

#include "virtual_consistency.h"

namespace toposcope::least_error {
namespace {

// As in the paper: between one node in twenty and one in ten is spent on coming back.
constexpr std::uint64_t largest_burst = 16384;
// A sweep that gains less than this part of the gap is the last one.
constexpr double root_gain = 1e-5, node_gain = 0.03;
// Sweeps at every node pay on hard problems alone, which are those that have taken so many nodes.
constexpr std::uint64_t easy_nodes = 256;

}  // namespace

BranchAndBound::BranchAndBound(const LabelingProblem& problem, SoftNetwork& network, BestLabelings& best,
                               std::size_t k_best, const Settings& settings, Deadline& deadline, Context& context)
    : problem_(problem),
      network_(network),
      best_(best),
      k_best_(k_best),
      settings_(settings),
      deadline_(deadline),
      context_(context),
      consistency_(network, deadline),
      favourite_(static_cast<std::size_t>(network.variables()), -1) {
  labeling_.values.resize(problem.variables.size());
}

Cost BranchAndBound::cutoff() const {
  const bool full = best_.labelings().size() >= k_best_;
  return network_.cutoff(best_.limit(), !full);
}

bool BranchAndBound::propagate() {
  const bool alive = consistency_.propagate(cutoff());
  stopped_ = stopped_ || consistency_.interrupted();
  return alive;
}

bool BranchAndBound::root() {
  if (!propagate()) return false;
  // Functions that only forbid cannot use what is spread over them: there the proofs come first.
  const bool proofs_first = network_.mostly_crisp();
  const auto prove = [&] {
    if (settings_.virtual_consistency) VirtualConsistency(network_).enforce(cutoff(), deadline_);
  };
  if (proofs_first) prove();
  if (!consistency_.spread(cutoff(), settings_.root_sweeps, root_gain)) return false;
  if (!proofs_first) prove();
  consistency_.touch_all();
  return propagate();
}

bool BranchAndBound::search() {
  if (!root()) {
    lower_bound_ = root_bound_ = forbidden;
    return true;
  }
  root_bound_ = lower_bound_ = network_.bound(network_.constant());
  heap_.push_back({network_.constant(), made_++, {}});
  while (!heap_.empty() && !stopped_) {
    std::pop_heap(heap_.begin(), heap_.end());
    const Open node = std::move(heap_.back());
    heap_.pop_back();
    lower_bound_ = std::max(lower_bound_, network_.bound(node.bound));
    if (node.bound >= cutoff()) {
      heap_.clear();
      break;
    }
    report_bound();
    limit_ = backtracks_ + burst_;
    network_.mark();
    const std::size_t base = network_.depth();
    path_ = node.path;
    if (restore(node.path)) dive();
    while (network_.depth() >= base) network_.undo();
    redone_ += node.path.size();
    if (nodes_ > 0) {
      if (redone_ * 10 > nodes_ && burst_ < largest_burst)
        burst_ *= 2;
      else if (redone_ * 20 < nodes_ && burst_ > 1)
        burst_ /= 2;
    }
  }
  if (!stopped_) {
    lower_bound_ = forbidden;
    return true;
  }
  // The dive that was stopped has left its open nodes in the heap.
  if (!heap_.empty()) lower_bound_ = std::max(lower_bound_, network_.bound(heap_.front().bound));
  return false;
}

bool BranchAndBound::apply(const Decision& decision) {
  if (decision.assign)
    consistency_.assign(decision.variable, decision.value);
  else
    consistency_.remove(decision.variable, decision.value);
  return network_.count(decision.variable) > 0;
}

bool BranchAndBound::restore(const std::vector<Decision>& path) {
  for (const Decision& decision : path) {
    // Propagation of a later cutoff may have done it already, or made it impossible.
    if (!network_.has(decision.variable, decision.value)) {
      if (decision.assign) return false;
      continue;
    }
    if (!apply(decision)) return false;
  }
  return propagate();
}

bool BranchAndBound::deduce() {
  if (!propagate()) return false;
  if (nodes_ < easy_nodes || settings_.node_sweeps == 0) return true;
  return consistency_.spread(cutoff(), settings_.node_sweeps, node_gain) && propagate();
}

// Depth first from the present node; beyond the burst's backtracks the right branches are left open.
void BranchAndBound::dive() {
  struct Level {
    Decision right;
    Cost bound;
    std::size_t path;
  };
  std::vector<Level> levels;
  bool alive = true;
  while (true) {
    if (alive) ++nodes_;
    if (alive && stopped_) {
      open(network_.constant());
      alive = false;
    }
    if (alive) {
      const int variable = choose_variable();
      if (variable < 0) {
        offer();
        alive = false;
      } else {
        const Decision left{variable, choose_value(variable), true};
        levels.push_back({{left.variable, left.value, false}, network_.constant(), path_.size()});
        network_.mark();
        path_.push_back(left);
        alive = apply(left) && deduce();
        if (!alive) last_conflict_ = variable;
        continue;
      }
    }
    if (levels.empty()) return;
    // Back: the right branch of the last level, now or later.
    const Level level = levels.back();
    levels.pop_back();
    network_.undo();
    path_.resize(level.path);
    path_.push_back(level.right);
    if (level.bound >= cutoff()) continue;
    if (stopped_ || ++backtracks_ > limit_) {
      open(level.bound);
      continue;
    }
    // In the mark of the level before: undone with it.
    alive = apply(level.right) && deduce();
  }
}

void BranchAndBound::open(Cost bound) {
  heap_.push_back({bound, made_++, path_});
  std::push_heap(heap_.begin(), heap_.end());
}

// Fewest values for the failures met; first what failed last (Lecoutre et al. 2009).
int BranchAndBound::choose_variable() {
  if (last_conflict_ >= 0 && network_.count(last_conflict_) > 1) return last_conflict_;
  last_conflict_ = -1;
  int chosen = -1;
  double least = forbidden;
  for (int v = 0; v < network_.variables(); ++v) {
    if (network_.count(v) <= 1) continue;
    double weight = 1e-3;
    for (const SoftNetwork::Use use : network_.uses(v)) {
      const BinaryFunction& f = network_.function(use.function);
      if (network_.count(f.variable[1 - use.side]) > 1) weight += f.weight;
    }
    const double ratio = network_.count(v) / weight;
    if (ratio < least) {
      least = ratio;
      chosen = v;
    }
  }
  return chosen;
}

int BranchAndBound::choose_value(int variable) {
  const int favourite = favourite_[static_cast<std::size_t>(variable)];
  const int support = consistency_.support(variable);
  if (favourite >= 0 && network_.has(variable, favourite) &&
      consistency_.level(favourite) <= consistency_.level(support))
    return favourite;
  return support;
}

void BranchAndBound::offer() {
  for (int v = 0; v < static_cast<int>(labeling_.values.size()); ++v)
    labeling_.values[static_cast<std::size_t>(v)] = network_.value_of(v, network_.values(v)[0]);
  labeling_.cost = cost_of(problem_, labeling_.values);
  const bool first = best_.labelings().empty() || labeling_.cost < best_.labelings().front().cost;
  best_.offer(labeling_);
  if (first)
    for (int v = 0; v < network_.variables(); ++v) favourite_[static_cast<std::size_t>(v)] = network_.values(v)[0];
}

void BranchAndBound::report_bound() {
  if (best_.labelings().empty()) return;
  const double gap = best_.labelings().front().cost - lower_bound_,
               start = best_.labelings().front().cost - root_bound_;
  context_.progress(start > 0 ? std::clamp(1 - gap / start, 0.0, 1.0) : 0);
}

}  // namespace toposcope::least_error
