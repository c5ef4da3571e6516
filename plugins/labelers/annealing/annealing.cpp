// SPDX-License-Identifier: BSD-3-Clause
// Simulated annealing over labellings (Kirkpatrick, Gelatt and Vecchi 1983), in runs from random beginnings.

#include <algorithm>
#include <array>
#include <cstdio>
#include <numeric>
#include <string>

#include "run.h"
#include "toposcope/labeling/greedy_labeling.h"
#include "toposcope/plugin.h"

namespace {

using namespace toposcope;
using namespace toposcope::annealing;

struct Settings {
  std::uint64_t sweeps, runs;
};

std::string text(double number) {
  std::array<char, 32> buffer{};
  std::snprintf(buffer.data(), buffer.size(), "%.6g", number);
  return buffer.data();
}

class Search {
 public:
  Search(const Settings& settings, const LabelingProblem& problem, const LabelingRequest& request, Context& context,
         Deadline deadline)
      : settings_(settings),
        problem_(problem),
        request_(request),
        context_(context),
        deadline_(deadline),
        k_best_(std::max<std::size_t>(request.k_best, 1)),
        tables_(problem, deadline_),
        best_(k_best_, request.within) {}

  LabelingOutcome outcome() {
    outcome_.lower_bound = tables_.lower_bound();
    if (outcome_.lower_bound < forbidden) {
      begin();
      if (tables_.complete() && !deadline_.reached()) anneal();
    }
    outcome_.labelings = best_.take();
    conclude();
    return std::move(outcome_);
  }

 private:
  // Nothing better to find, and no more to list.
  bool done() const { return best_.labelings().size() == k_best_ && proven(); }
  bool proven() const { return !best_.labelings().empty() && best_.labelings()[0].cost <= outcome_.lower_bound; }

  // A first labelling before anything else: without tables, in time for any limit.
  void begin() {
    std::vector<Index> order(problem_.variables.size());
    std::iota(order.begin(), order.end(), Index{0});
    if (auto values = greedy_labeling(problem_, {order, {}}, deadline_)) {
      const double cost = cost_of(problem_, *values);
      best_.offer({std::move(*values), cost});
    }
  }

  Schedule schedule() {
    ConditionalCosts costs(tables_);
    if (best_.labelings().empty()) {
      Random random(splitmix64(context_.seed()));
      costs.reset(random_values(tables_, random));
    } else {
      costs.reset(best_.labelings()[0].values);
    }
    descend(tables_, costs, deadline_);
    if (costs.broken() == 0) offer_neighbours(tables_, costs, best_, deadline_);
    return make_schedule(tables_, costs);
  }

  RunResult run(std::size_t number, const Schedule& schedule) const {
    // The first two are short, so that one who stops early finds something that has cooled.
    const std::uint64_t divisor = number == 0 ? 16 : number == 1 ? 4 : 1;
    const RunSettings settings{std::max<std::uint64_t>(settings_.sweeps / divisor, 1),
                               splitmix64(context_.seed() + number)};
    return annealing::run(settings, tables_, schedule, request_, deadline_);
  }

  // Runs are independent of each other and go by their numbers: the same at any thread count. They end where the
  // bound is reached.
  void anneal() {
    const Schedule schedule = this->schedule();
    std::vector<double> least;
    while (least.size() < settings_.runs && !done() && !deadline_.reached()) {
      const std::size_t done = least.size();
      std::vector<RunResult> found(std::min<std::size_t>(wave, settings_.runs - done));
      context_.parallel_for(found.size(), 1, [&](std::size_t first, std::size_t last) {
        for (std::size_t k = first; k < last; ++k) found[k] = run(done + k, schedule);
      });
      for (const RunResult& one : found) {
        for (const Labeling& labeling : one.labelings) best_.offer(labeling);
        least.push_back(one.labelings.empty() ? forbidden : one.labelings[0].cost);
        outcome_.nodes += one.moves;
        stopped_ |= one.stopped;
      }
      context_.progress(static_cast<double>(least.size()) / static_cast<double>(settings_.runs));
    }
    const double limit = best_.labelings().empty() ? -forbidden : best_.labelings()[0].cost + tables_.slack();
    const auto reached = std::count_if(least.begin(), least.end(), [&](double cost) { return cost <= limit; });
    outcome_.facts = {{"runs", std::to_string(least.size()) + " of " + std::to_string(settings_.runs)},
                      {"runs that reached the least cost", std::to_string(reached)},
                      {"start temperature", text(schedule.start)},
                      {"end temperature", text(schedule.end)},
                      {"penalty", text(schedule.penalty)}};
  }

  void conclude() {
    const bool stopped = stopped_ || deadline_.reached();
    const bool none = outcome_.labelings.empty();
    outcome_.optimal = none ? outcome_.lower_bound == forbidden : outcome_.labelings[0].cost <= outcome_.lower_bound;
    std::string& words = outcome_.guarantee;
    if (none && outcome_.optimal)
      words = "every labelling is forbidden: a variable or constraint has no finite cost";
    else if (outcome_.optimal)
      words = "optimal: the cost is that of every table's least entry";
    else
      words = none ? "no labelling of finite cost found, which proves nothing" : "not proven: the best labelling met";
    if (!outcome_.optimal)
      words += stopped ? "; stopped early, another run may differ" : "; the same on every run with this seed";
    if (none) outcome_.labelings = all_missing(problem_);
    if (none && !outcome_.labelings.empty()) words += "; all missing";
    context_.progress(1);
  }

  static constexpr std::size_t wave = 4;

  const Settings& settings_;
  const LabelingProblem& problem_;
  const LabelingRequest& request_;
  Context& context_;
  Deadline deadline_;
  std::size_t k_best_;
  CostTables tables_;
  BestLabelings best_;
  LabelingOutcome outcome_;
  bool stopped_ = false;
};

class Annealing final : public Labeler {
 public:
  explicit Annealing(const Options& options)
      : settings_{static_cast<std::uint64_t>(options.integer("sweeps")),
                  static_cast<std::uint64_t>(options.integer("runs"))} {}

  LabelingOutcome solve(const LabelingProblem& problem, const LabelingRequest& request,
                        Context& context) const override {
    const Deadline deadline(request.time_limit_s, context);
    check(problem);
    return Search(settings_, problem, request, context, deadline).outcome();
  }

 private:
  Settings settings_;
};

constexpr OptionSpec options[] = {
    {"sweeps", OptionType::integer, "", "1000", "1", "1000000000",
     "of a run, from the start to the end temperature; a sweep proposes as many moves as there are values"},
    {"runs", OptionType::integer, "", "16", "1", "100000",
     "from different random beginnings; the first two are a sixteenth and a quarter as long"},
};

}  // namespace

TOPOSCOPE_PLUGIN(Labeler, Annealing,
                 {.id = "annealing",
                  .version = "1.0.0",
                  .summary = "Simulated annealing with restarts, for problems too large to prove",
                  .citation = "Kirkpatrick, Gelatt and Vecchi 1983",
                  .options = options})
