// SPDX-License-Identifier: BSD-3-Clause
// Backtracking tree search for labellings that meet all constraints (dissertation 3.4.2, category 1).

#include "ranking.h"
#include "toposcope/labeling/conflict_set.h"
#include "toposcope/labeling/crisp_outcome.h"
#include "toposcope/plugin.h"

namespace {

using namespace toposcope;
using namespace toposcope::backtracking;

enum class Find : std::uint8_t { first, all, count };
enum class Missing : std::uint8_t { only_if_needed, allowed, never };

struct Settings {
  Find find;
  Missing missing;
  bool by_violation;
  CrispRules rules;
};

// One run over one problem.
class Run {
 public:
  Run(const Settings& settings, const LabelingProblem& problem, const LabelingRequest& request, Deadline& deadline,
      const Context& context)
      : settings_(settings),
        context_(context),
        problem_(problem),
        request_(request),
        deadline_(deadline),
        network_(problem, deadline, settings.missing == Missing::never),
        rules_(settings.rules) {
    rules_.missing_last = settings.missing == Missing::only_if_needed;
  }

  LabelingOutcome outcome() {
    const double least = sum_of_minima(problem_, deadline_);
    const bool fewest = settings_.missing == Missing::only_if_needed;
    const FirstConsistent first = first_consistent(network_, settings_.rules, fewest, deadline_);
    nodes_ = first.nodes;
    LabelingOutcome outcome;
    if (!first.found) {
      outcome = without_labeling(problem_, first.proven);
      none_ = first.proven;
      if (none_) {
        outcome.facts.push_back({"consistent labellings", "0"});
        tell_conflict(settings_.missing != Missing::never, outcome);
      }
    } else {
      if (fewest) {
        fewest_proven_ = first.proven;
        rules_.missing_limit = count_missing(problem_, first.values);
        outcome.facts.push_back(
            {"fewest missing", (first.proven ? "" : "at most ") + std::to_string(rules_.missing_limit)});
      }
      list_labelings(first.values, outcome);
      if (fewest && first.proven && rules_.missing_limit > 0) tell_conflict(false, outcome);
    }
    outcome.nodes = nodes_;
    find_lower_bound(least, outcome);
    return outcome;
  }

 private:
  void tell_conflict(bool missing_allowed, LabelingOutcome& outcome) const {
    add_conflict_fact(problem_, {.missing_allowed = missing_allowed}, request_, deadline_, context_, outcome);
  }

  CrispSearch::End search(CrispVisitor& visitor) {
    CrispSearch made(network_, rules_, visitor, deadline_);
    return run(made);
  }

  CrispSearch::End run(CrispSearch& made) {
    const CrispSearch::End end = made.run();
    nodes_ += made.nodes();
    return end;
  }

  void list_labelings(const std::vector<Index>& first, LabelingOutcome& outcome) {
    const Ranked seed = ranked(problem_, first, settings_.by_violation);
    // Ranked by violation, what is too costly is known when the best is: then a second search lists the others.
    const bool two_passes = settings_.by_violation && request_.within < forbidden;
    RankedList list(two_passes ? 1 : request_.k_best, two_passes ? forbidden : request_.within, forbidden);
    list.offer(seed);
    bool proven = fewest_proven_;
    if (settings_.find == Find::first) {
      proven = false;
    } else if (settings_.find == Find::count && proven) {
      Counter counter(problem_, settings_.by_violation, list);
      proven = search(counter) == CrispSearch::End::exhausted;
      outcome.facts.push_back({"consistent labellings", (proven ? "" : "at least ") + std::to_string(counter.count())});
    } else if (proven) {
      proven = branch_and_bound(list);
    }
    outcome.optimal = proven;
    if (two_passes) {
      RankedList rest(request_.k_best, forbidden, list.list().front().labeling.cost + request_.within);
      rest.offer(list.list().front());
      if (settings_.find != Find::first && proven) proven = branch_and_bound(rest);
      list = rest;
    }
    for (const Ranked& each : list.list()) outcome.labelings.push_back(each.labeling);
    describe(outcome, proven);
  }

  bool branch_and_bound(RankedList& list) {
    const std::vector<Index> order = detectability_order(problem_);
    Objective cost, violation;
    if (!cost.make(network_, false, order, deadline_)) return false;
    if (settings_.by_violation && !violation.make(network_, true, order, deadline_)) return false;
    BranchAndBound visitor(network_, cost, settings_.by_violation ? &violation : nullptr, list);
    CrispSearch made(network_, rules_, visitor, deadline_);
    visitor.follow(made.domains());
    return run(made) == CrispSearch::End::exhausted;
  }

  void describe(LabelingOutcome& outcome, bool all_proven) const {
    std::string& text = outcome.guarantee;
    text = settings_.find == Find::first ? "first consistent labelling"
           : settings_.by_violation      ? "constraints best satisfied"
                                         : "least cost of the consistent labellings";
    if (settings_.missing == Missing::only_if_needed)
      text += fewest_proven_ ? ", fewest missing proven" : ", fewest missing not proven, stopped early";
    if (settings_.missing == Missing::never) text += ", none missing";
    if (settings_.find == Find::first) return;
    text += outcome.optimal ? ": proven" : ": not proven, stopped early";
    if (request_.k_best > 1) text += all_proven ? "; alternatives proven" : "; alternatives may lack some";
  }

  void find_lower_bound(double least, LabelingOutcome& outcome) const {
    // Where costs alone forbid, a proof that there is no consistent labelling is one that none has finite cost; and the
    // best of the consistent ones is the best of all where the rules leave all of them in.
    const bool none =
        none_ && network_.by_cost_alone() && (settings_.missing != Missing::never || !any_optional(problem_));
    const bool best_of_all = outcome.optimal && !outcome.labelings.empty() && settings_.missing == Missing::allowed &&
                             !settings_.by_violation && network_.by_cost_alone();
    outcome.lower_bound = none ? forbidden : best_of_all ? outcome.labelings[0].cost : least;
  }

  const Settings& settings_;
  const Context& context_;
  const LabelingProblem& problem_;
  const LabelingRequest& request_;
  Deadline& deadline_;
  CrispNetwork network_;
  CrispRules rules_;
  std::uint64_t nodes_ = 0;
  bool fewest_proven_ = true;
  bool none_ = false;  ///< proven
};

class Backtracking final : public Labeler {
 public:
  explicit Backtracking(const Options& options) {
    const std::string &find = options.text("find"), &missing = options.text("missing");
    settings_.find = find == "first" ? Find::first : find == "all" ? Find::all : Find::count;
    settings_.missing = missing == "only-if-needed" ? Missing::only_if_needed
                        : missing == "allowed"      ? Missing::allowed
                                                    : Missing::never;
    settings_.by_violation = options.text("rank") == "violation";
    const std::string &relaxation = options.text("relaxation"), &order = options.text("order");
    settings_.rules.relaxation = relaxation == "none"     ? CrispRules::Relaxation::none
                                 : relaxation == "before" ? CrispRules::Relaxation::before
                                                          : CrispRules::Relaxation::maintained;
    settings_.rules.order = order == "weighted"          ? CrispRules::Order::weighted
                            : order == "smallest-domain" ? CrispRules::Order::smallest_domain
                                                         : CrispRules::Order::detectability;
    settings_.rules.backjumping = options.boolean("backjumping");
  }

  LabelingOutcome solve(const LabelingProblem& problem, const LabelingRequest& request,
                        Context& context) const override {
    Deadline deadline(request.time_limit_s, context);  // the making of the tables counts too
    check(problem);
    if (problem.variables.empty()) return without_variables(problem);
    return Run(settings_, problem, request, deadline, context).outcome();
  }

 private:
  Settings settings_;
};

constexpr OptionSpec options[] = {
    {"find", OptionType::text, "", "all", "", "",
     "the first consistent labelling; all, of which the k best are listed; or their number too", "first|all|count"},
    {"missing", OptionType::text, "", "only-if-needed", "", "",
     "labellings with the fewest missing features (the dissertation); all; or those where nothing is missing",
     "only-if-needed|allowed|never"},
    {"rank", OptionType::text, "", "violation", "", "",
     "consistent labellings are ranked by the sum of their violations, then by cost (the dissertation); or by cost",
     "violation|cost"},
    {"relaxation", OptionType::text, "", "maintained", "", "",
     "arc consistency: not at all (forward checking alone), before the search, or at every node",
     "none|before|maintained"},
    {"order", OptionType::text, "", "weighted", "", "",
     "next variable: smallest domain over weight of failures, smallest domain, or the dissertation's fixed order",
     "weighted|smallest-domain|detectability"},
    {"backjumping", OptionType::boolean, "", "true", "", "",
     "go back at once to a decision that is to blame for a failure"},
};

}  // namespace

TOPOSCOPE_PLUGIN(Labeler, Backtracking,
                 {.id = "backtracking",
                  .version = "1.0.0",
                  .summary = "Tree search for labellings that meet all constraints: first, best, or how many",
                  .citation = "Neal 1999, section 3.4.2",
                  .options = options})
