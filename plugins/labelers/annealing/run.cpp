// SPDX-License-Identifier: BSD-3-Clause
#include "run.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace toposcope::annealing {
namespace {

class Run {
 public:
  Run(const CostTables& tables, const Schedule& schedule, std::uint64_t seed, const LabelingRequest& request,
      Deadline deadline)
      : tables_(tables),
        schedule_(schedule),
        random_(seed),
        deadline_(deadline),
        costs_(tables),
        k_best_(std::max<std::size_t>(request.k_best, 1)),
        best_(k_best_, request.within) {}

  void anneal(std::uint64_t sweeps) {
    start(random_values(tables_, random_));
    Schedule schedule = schedule_;
    for (int reheat = 0; reheat <= reheats; ++reheat) {
      cool(sweeps, schedule);
      if (stopped_ || !best_.labelings().empty()) return;
      // What is left breaks a constraint: again from there, hotter, and with dearer ones where they compete with costs.
      schedule.start *= 2;
      schedule.end *= 2;
      if (!schedule.hard_only) schedule.penalty *= 4;
    }
  }

  RunResult take() { return {best_.take(), moves_, stopped_}; }

 private:
  static constexpr int reheats = 3;

  void start(std::span<const Index> values) {
    costs_.reset(values);
    signature_ = 0;
    for (Index v = 0; v < values.size(); ++v) signature_ ^= splitmix64(tables_.offset(v) + values[v]);
    offer();
  }

  void cool(std::uint64_t sweeps, const Schedule& schedule) {
    const double steps = static_cast<double>(std::max<std::uint64_t>(sweeps, 2) - 1);
    for (std::uint64_t sweep = 0; sweep < sweeps && !stopped_ && !done(); ++sweep) {
      const double part = static_cast<double>(sweep) / steps;
      this->sweep(schedule.start * std::pow(schedule.end / schedule.start, part), schedule.penalty);
    }
    finish();
  }

  bool done() const {
    return best_.labelings().size() == k_best_ && best_.labelings().front().cost <= tables_.lower_bound();
  }

  // As many proposals as there are values.
  void sweep(double temperature, double penalty) {
    const std::span<const std::uint32_t> allowed = tables_.allowed();
    for (std::size_t i = 0; i < allowed.size(); ++i) {
      if ((i & 511U) == 0 && (stopped_ = deadline_.reached())) return;
      const std::uint32_t position = allowed[random_.below(allowed.size())];
      const Index v = tables_.owner(position);
      const auto value = static_cast<Index>(position - tables_.offset(v));
      if (value == costs_.values()[v]) continue;
      const double change = costs_.cost_change(v, value) + penalty * costs_.broken_change(v, value);
      if (accept(change, temperature)) {
        move(v, value);
        offer();
      } else if (const Index opponent = costs_.sole_opponent(v, value); opponent != v) {
        oust(v, value, opponent, temperature, penalty);
      }
    }
  }

  bool accept(double change, double temperature) {
    if (change <= 0) return true;
    // Beyond 40 temperatures the chance is below 1e-17.
    return change < 40 * temperature && change <= -temperature * std::log(random_.positive());
  }

  void move(Index v, Index value) {
    signature_ ^= splitmix64(tables_.offset(v) + costs_.values()[v]) ^ splitmix64(tables_.offset(v) + value);
    costs_.assign(v, value);
    ++moves_;
  }

  // Where one variable stands in the way, by its candidate or a forbidden pair: it makes way as cheaply as it can.
  void oust(Index v, Index value, Index opponent, double temperature, double penalty) {
    const Index from = costs_.values()[v];
    const double change = costs_.cost_change(v, value) + penalty * (costs_.broken_change(v, value) - 1);
    if (!accept(change, temperature)) return;
    move(v, value);
    Index best = costs_.values()[opponent];
    double least = forbidden;
    for (const std::uint32_t position : tables_.allowed(opponent)) {
      const auto other = static_cast<Index>(position - tables_.offset(opponent));
      const double loss = costs_.cost_change(opponent, other) + penalty * costs_.broken_change(opponent, other);
      if (other == costs_.values()[opponent] || loss >= least) continue;
      best = other;
      least = loss;
    }
    // `change` left out what is broken until the opponent has moved.
    if (least < forbidden && accept(change + penalty + least, temperature)) {
      move(opponent, best);
      offer();
    } else {
      move(v, from);
    }
  }

  // What may enter the list does, but for the labellings last seen.
  void offer() {
    if (costs_.broken() != 0 || costs_.cost() > best_.limit() + tables_.slack()) return;
    std::uint64_t& seen = seen_[signature_ % seen_.size()];
    if (seen == signature_) return;
    seen = signature_;
    offered_.values = costs_.values();
    offered_.cost = cost_of(tables_.problem(), offered_.values);
    best_.offer(offered_);
  }

  // Down to a local optimum, from the last labelling and from the best one, whose neighbours are looked at too.
  void finish() {
    settle();
    if (best_.labelings().empty()) return;
    const std::vector<Index> values = best_.labelings().front().values;
    start(values);
    settle();
  }

  void settle() {
    if (!descend(tables_, costs_, deadline_)) stopped_ = true;
    start(std::vector<Index>(costs_.values()));
    if (!offer_neighbours(tables_, costs_, best_, deadline_)) stopped_ = true;
  }

  const CostTables& tables_;
  const Schedule schedule_;
  Random random_;
  Deadline deadline_;
  ConditionalCosts costs_;
  std::size_t k_best_;
  BestLabelings best_;
  Labeling offered_;
  std::array<std::uint64_t, 1024> seen_{};
  std::uint64_t signature_ = 0, moves_ = 0;
  bool stopped_ = false;
};

}  // namespace

RunResult run(const RunSettings& settings, const CostTables& tables, const Schedule& schedule,
              const LabelingRequest& request, Deadline deadline) {
  Run run(tables, schedule, settings.seed, request, deadline);
  run.anneal(settings.sweeps);
  return run.take();
}

}  // namespace toposcope::annealing
