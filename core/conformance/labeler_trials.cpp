// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <numeric>

#include "base/errors.h"
#include "inputs.h"
#include "pipeline/solve.h"
#include "toposcope/labeling/make_problem.h"
#include "toposcope/labeling/tools.h"

namespace toposcope {
namespace {

constexpr double enough_s = 1e6;

struct Shape {
  int variables, candidates, constraints, arity;
};

/// Of one labelling that is good everywhere and others that are better here and there; costs without ties.
LabelingProblem random_problem(const Shape& shape, std::uint64_t seed) {
  Random random(seed);
  LabelingProblem problem;
  problem.name = "random";
  problem.candidate_count = static_cast<Index>(shape.candidates);
  for (Index c = 0; c < problem.candidate_count; ++c) {
    set_conflict(problem, c, c);
    if (random.uniform() < 0.3) set_conflict(problem, c, static_cast<Index>(random.below(problem.candidate_count)));
  }
  for (int i = 0; i < shape.variables; ++i) {
    LabelingVariable& variable = problem.variables.emplace_back();
    variable.name = "f" + std::to_string(i);
    variable.detectability = random.uniform(0.5, 0.99);
    variable.costs.push_back(-std::log(1 - variable.detectability));
    for (Index c = 0; c < problem.candidate_count; ++c) {
      if (random.uniform() < 0.2) continue;
      variable.candidates.push_back(c);
      variable.costs.push_back(random.uniform() < 0.05 ? forbidden : random.uniform(-3, 4));
    }
  }
  for (int k = 0; k < shape.constraints; ++k) {
    std::vector<Index> scope(problem.variables.size());
    std::iota(scope.begin(), scope.end(), Index{0});
    random.shuffle(scope);
    scope.resize(std::min<std::size_t>(scope.size(), 2 + random.below(static_cast<std::size_t>(shape.arity - 1))));
    LabelingConstraint constraint = empty_constraint(problem, scope);
    constraint.name = "r" + std::to_string(problem.constraints.size());
    std::vector<Index> digits(scope.size(), 0);
    std::size_t entry = 0;
    do {
      bool missing = false;
      for (std::size_t i = 0; i < scope.size(); ++i)
        missing = missing || problem.variables[scope[i]].missing(digits[i]);
      if (!missing) {
        const bool no = random.uniform() < 0.1;
        constraint.costs[entry] = no ? forbidden : random.uniform(-2, 4);
        constraint.violations[entry] = no ? std::numeric_limits<float>::infinity()  //
                                          : static_cast<float>(random.uniform(0, 1.6));
      }
      ++entry;
    } while (next_entry(problem, constraint, digits));
    problem.constraints.push_back(std::move(constraint));
  }
  return problem;
}

/// The same problem with its variables, values, candidates and constraints in another order.
LabelingProblem shuffled(const LabelingProblem& problem, std::uint64_t seed) {
  Random random(seed);
  LabelingProblem result = problem;
  std::vector<Index> old_of(problem.variables.size()), new_of(old_of.size());
  std::iota(old_of.begin(), old_of.end(), Index{0});
  random.shuffle(old_of);
  std::vector<std::vector<Index>> new_value(problem.variables.size());  // per old variable, of its old values
  for (Index v = 0; v < old_of.size(); ++v) {
    new_of[old_of[v]] = v;
    const LabelingVariable& old = problem.variables[old_of[v]];
    LabelingVariable& variable = result.variables[v] = old;
    std::vector<Index> order(old.domain());
    std::iota(order.begin(), order.end(), Index{0});
    std::vector<Index> movable(order.begin() + (old.optional ? 1 : 0), order.end());
    random.shuffle(movable);
    std::copy(movable.begin(), movable.end(), order.begin() + (old.optional ? 1 : 0));
    new_value[old_of[v]].resize(order.size());
    for (Index value = 0; value < order.size(); ++value) {
      new_value[old_of[v]][order[value]] = value;
      variable.costs[value] = old.costs[order[value]];
      if (!variable.missing(value) && !old.candidates.empty())
        variable.candidates[value - (old.optional ? 1 : 0)] = old.candidate(order[value]);
    }
  }
  for (LabelingConstraint& constraint : result.constraints) {
    const LabelingConstraint old = constraint;
    for (Index& v : constraint.scope) v = new_of[v];
    std::vector<Index> digits(old.scope.size(), 0);
    std::vector<Index> values(result.variables.size(), 0);
    std::size_t entry = 0;
    do {
      for (std::size_t i = 0; i < digits.size(); ++i) values[constraint.scope[i]] = new_value[old.scope[i]][digits[i]];
      const std::size_t to = table_entry(result, constraint, values);
      constraint.costs[to] = old.costs[entry];
      if (!old.violations.empty()) constraint.violations[to] = old.violations[entry];
      ++entry;
    } while (next_entry(problem, old, digits));
  }
  random.shuffle(result.constraints);
  return result;
}

/// Sums over all labellings, one by one.
struct Sums {
  double log_evidence;
  std::vector<std::vector<double>> posteriors;
};
Sums sums_of(const LabelingProblem& problem) {
  std::vector<Labeling> all;
  Labeling now{std::vector<Index>(problem.variables.size(), 0), 0};
  double least = forbidden;
  for (bool more = true; more;) {
    now.cost = cost_of(problem, now.values);
    least = std::min(least, now.cost);
    if (now.cost < forbidden) all.push_back(now);
    more = false;
    for (std::size_t v = now.values.size(); v-- > 0 && !more;) {
      more = ++now.values[v] < problem.variables[v].domain();
      if (!more) now.values[v] = 0;
    }
  }
  Sums sums;
  for (const LabelingVariable& each : problem.variables) sums.posteriors.emplace_back(each.domain(), 0.0);
  double total = 0;
  for (const Labeling& labeling : all) {
    const double weight = std::exp(least - labeling.cost);
    total += weight;
    for (Index v = 0; v < labeling.values.size(); ++v) sums.posteriors[v][labeling.values[v]] += weight;
  }
  for (auto& posterior : sums.posteriors)
    for (double& p : posterior) p /= total;
  sums.log_evidence = all.empty() ? -forbidden : std::log(total) - least;
  return sums;
}

class LabelerTrial final : public Trial {
 public:
  LabelerTrial(std::string called, LabelingProblem problem, double time_limit_s = enough_s)
      : Trial(std::move(called)), problem_(std::move(problem)), time_limit_s_(time_limit_s) {}

  Answer run(const void* object, const Options&, Context& context) const override {
    const LabelingRequest request{.k_best = 4, .time_limit_s = time_limit_s_};
    auto outcome =
        std::make_shared<LabelingOutcome>(static_cast<const Labeler*>(object)->solve(problem_, request, context));
    Answer answer;
    append_bytes(answer.bytes, outcome->labelings.size());
    for (const Labeling& labeling : outcome->labelings) {
      append_bytes(answer.bytes, labeling.values);
      append_bytes(answer.bytes, labeling.cost);
    }
    append_bytes(answer.bytes, outcome->lower_bound);
    append_bytes(answer.bytes, outcome->log_evidence);
    append_bytes(answer.bytes, outcome->posteriors);
    answer.flaw = flaw(*outcome);
    answer.value = std::move(outcome);
    return answer;
  }

  std::unique_ptr<Trial> moved(const Motion& motion) const override {
    return std::make_unique<LabelerTrial>(name, shuffled(problem_, motion.shuffle), time_limit_s_);
  }

  /// What is proven cannot depend on the order; a heuristic's answer may.
  std::string change(const Answer& before, const Answer& after, const Motion&) const override {
    const auto& first = *static_cast<const LabelingOutcome*>(before.value.get());
    const auto& second = *static_cast<const LabelingOutcome*>(after.value.get());
    const double slack = rounding_slack(problem_);
    if (first.optimal && second.optimal && !first.labelings.empty() && !second.labelings.empty() &&
        std::abs(first.labelings[0].cost - second.labelings[0].cost) > slack)
      return fmt::format("on {}, both answers are said to be proven best, and cost {:.17g} and {:.17g}", name,
                         first.labelings[0].cost, second.labelings[0].cost);
    return "";
  }

 private:
  std::string flaw(const LabelingOutcome& outcome) const {
    try {
      check_outcome(problem_, outcome, "");
    } catch (const PluginError& error) {
      return std::string(error.what()).substr(std::string("plugin '': ").size());
    }
    for (const Labeling& labeling : outcome.labelings)
      if (const double cost = cost_of(problem_, labeling.values); cost != labeling.cost)
        return fmt::format("gave a labelling the cost {:.17g}; cost_of sums it to {:.17g}", labeling.cost, cost);
    if (outcome.guarantee.empty()) return "does not say in 'guarantee' what it promises of its outcome";
    return false_promise(outcome);
  }

  /// Of small problems the sums are known.
  std::string false_promise(const LabelingOutcome& outcome) const {
    const auto most = [](Exactness exactness, double error) {
      return exactness == Exactness::exact ? 1e-6 : exactness == Exactness::bound ? error + 1e-6 : forbidden;
    };
    const double evidence_off = most(outcome.evidence_exactness, outcome.evidence_error);
    const double posteriors_off = most(outcome.posterior_exactness, outcome.posterior_error);
    if (!(std::min(evidence_off, posteriors_off) < forbidden) || labelings() > 20'000) return "";
    const Sums sums = sums_of(problem_);
    const auto differ = [](double a, double b, double tolerance) { return a != b && !(std::abs(a - b) <= tolerance); };
    if (differ(outcome.log_evidence, sums.log_evidence, evidence_off))
      return fmt::format("says that its evidence is {} {:.9g}; all labellings together have {:.9g}",
                         outcome.evidence_exactness == Exactness::exact ? "exact:" : "within its bound of",
                         outcome.log_evidence, sums.log_evidence);
    for (Index v = 0; v < outcome.posteriors.size(); ++v)
      for (Index value = 0; value < outcome.posteriors[v].size(); ++value)
        if (differ(outcome.posteriors[v][value], sums.posteriors[v][value], posteriors_off))
          return fmt::format(
              "gives value {} of '{}' the probability {:.9g}, {}; over all labellings it is {:.9g}", value,
              problem_.variables[v].name, outcome.posteriors[v][value],
              outcome.posterior_exactness == Exactness::exact ? "and says that it is exact" : "beyond its own bound",
              sums.posteriors[v][value]);
    return "";
  }

  double labelings() const {
    double count = 1;
    for (const LabelingVariable& each : problem_.variables) count *= each.domain();
    return count;
  }

  LabelingProblem problem_;
  double time_limit_s_;
};

LabelingVariable variable(std::string name, std::vector<Index> candidates, std::vector<double> costs,
                          bool optional = true) {
  return {
      .name = std::move(name), .candidates = std::move(candidates), .costs = std::move(costs), .optional = optional};
}

Trials degenerate_problems() {
  Trials trials;
  const auto add = [&](const char* name, std::vector<LabelingVariable> variables, Index candidates) -> void {
    LabelingProblem problem;
    problem.name = name;
    problem.variables = std::move(variables);
    problem.candidate_count = candidates;
    for (Index c = 0; c < candidates; ++c) set_conflict(problem, c, c);
    trials.push_back(std::make_unique<LabelerTrial>(name, std::move(problem)));
  };
  add("a problem without variables", {}, 0);
  add("variables without candidates", {variable("a", {}, {0.5}), variable("b", {}, {0})}, 0);
  add("one candidate for three variables",
      {variable("a", {0}, {3, -1}), variable("b", {0}, {3, -2}), variable("c", {0}, {3, -1.5})}, 1);
  add("values that are all forbidden but missing", {variable("a", {0, 1}, {1, forbidden, forbidden})}, 2);
  add("variables that may not be missing, with one candidate for two",
      {variable("a", {0}, {-1}, false), variable("b", {0}, {-2}, false)}, 1);
  add("values that all cost the same", {variable("a", {0, 1}, {0, 0, 0}), variable("b", {0, 1}, {0, 0, 0})}, 2);
  return trials;
}

}  // namespace

TrialSet labeler_trials(const PluginManifest&) {
  TrialSet set;
  set.pose = false;
  for (std::uint64_t seed = 1; seed <= 6; ++seed)
    set.ordinary.push_back(std::make_unique<LabelerTrial>(
        "random problem " + std::to_string(seed), random_problem({3 + static_cast<int>(seed) % 3, 5, 5, 3}, seed)));
  set.degenerate = degenerate_problems();
  LabelingProblem poisoned = random_problem({4, 5, 4, 2}, 9);
  poisoned.variables[1].costs[1] = std::numeric_limits<double>::quiet_NaN();
  poisoned.constraints[0].costs.back() = std::numeric_limits<double>::quiet_NaN();
  set.poisoned.push_back(std::make_unique<LabelerTrial>("a problem with costs that are NaN", std::move(poisoned)));
  set.large.push_back(
      std::make_unique<LabelerTrial>("a random problem of 30 variables", random_problem({30, 40, 60, 2}, 5)));
  return set;
}

}  // namespace toposcope
