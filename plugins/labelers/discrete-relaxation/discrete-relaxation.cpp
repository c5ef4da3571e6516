// SPDX-License-Identifier: BSD-3-Clause
// Discrete relaxation: strikes from each domain what cannot stand with anything left in another (dissertation 3.4.2).

#include "toposcope/labeling/conflict_set.h"
#include "toposcope/labeling/crisp_outcome.h"
#include "toposcope/labeling/crisp_search.h"
#include "toposcope/plugin.h"

namespace {

using namespace toposcope;

enum class Missing : std::uint8_t { only_if_needed, allowed, never };

constexpr std::size_t listed_values = 20;  ///< of a domain in a fact

std::string value_name(const LabelingVariable& variable, Index value) {
  if (!variable.value_names.empty()) return variable.value_names[value];
  return variable.missing(value) ? "missing" : std::to_string(value);
}

class Run {
 public:
  Run(Missing missing, bool search, const LabelingProblem& problem, Deadline& deadline)
      : missing_(missing),
        search_(search),
        problem_(problem),
        deadline_(deadline),
        network_(problem, deadline, missing != Missing::allowed) {}

  LabelingOutcome outcome(const LabelingRequest& request, const Context& context) {
    const double least = sum_of_minima(problem_, deadline_);
    ArcConsistency consistency(network_, deadline_);
    const CrispDomains& domains = consistency.domains();
    const bool open = network_.complete() && consistency.relax();
    const bool stopped = deadline_.reached();
    LabelingOutcome outcome = label(domains, !stopped && !open, stopped);
    outcome.lower_bound = none_ && network_.by_cost_alone() ? forbidden : least;
    if (network_.complete()) {
      outcome.removed = consistency.removed();
      tell_domains(domains, outcome);
    }
    if (inconsistent_)
      add_conflict_fact(problem_, {.missing_allowed = missing_ == Missing::allowed}, request, deadline_, context,
                        outcome);
    return outcome;
  }

 private:
  // What is proven of the relaxed problem is proven under the rules: fewer than all are not allowed.
  bool binding() const { return missing_ != Missing::only_if_needed || !any_optional(problem_); }

  LabelingOutcome label(const CrispDomains& domains, bool wiped_out, bool stopped) {
    if (stopped) return without_labeling(problem_, false);
    std::vector<Index> values;
    for (Index v = 0; v < network_.variables() && !wiped_out; ++v)
      if (domains.size(v) == 1) for_each_value(domains.domain(v), [&](Index value) { values.push_back(value); });
    const std::string of = missing_ == Missing::allowed ? "" : " with nothing missing";
    if (!wiped_out && values.size() == network_.variables())
      return labelled(values, true, "arc consistency leaves one labelling" + of);
    inconsistent_ = wiped_out;
    none_ = wiped_out && (missing_ == Missing::allowed || !any_optional(problem_));
    if (!search_) {
      LabelingOutcome outcome = without_labeling(problem_, wiped_out && binding());
      outcome.guarantee = wiped_out ? "arc consistency proves that there is no consistent labelling" + of
                                    : "arc consistent" + of + "; not searched for a labelling";
      return outcome;
    }
    FirstConsistent first;
    first.proven = wiped_out;
    if (!wiped_out) first = first_consistent(network_, {}, false, deadline_);
    nodes_ += first.nodes;
    inconsistent_ = !first.found && first.proven;
    none_ = inconsistent_ && (missing_ == Missing::allowed || !any_optional(problem_));
    if (first.found) return labelled(first.values, false, "first consistent labelling" + of);
    if (binding() || !first.proven) return without_labeling(problem_, first.proven);
    const CrispNetwork whole(problem_, deadline_);
    first = first_consistent(whole, {}, true, deadline_);
    nodes_ += first.nodes;
    none_ = !first.found && first.proven;
    if (!first.found) return without_labeling(problem_, first.proven);
    return labelled(first.values, false,
                    std::string("none with nothing missing; first consistent labelling with ") +
                        (first.proven ? "the fewest missing" : "few missing, stopped early"));
  }

  LabelingOutcome labelled(const std::vector<Index>& values, bool only_one, const std::string& guarantee) const {
    LabelingOutcome outcome;
    outcome.labelings = {{values, cost_of(problem_, values)}};
    outcome.optimal = only_one;
    outcome.guarantee = guarantee;
    return outcome;
  }

  void tell_domains(const CrispDomains& domains, LabelingOutcome& outcome) const {
    outcome.nodes = nodes_;
    for (Index v = 0; v < network_.variables(); ++v) {
      const LabelingVariable& variable = problem_.variables[v];
      if (domains.size(v) == 0) outcome.facts.push_back({"emptied domain", variable.name});
      std::string text = std::to_string(domains.size(v)) + " of " + std::to_string(variable.domain());
      std::size_t told = 0;
      for_each_value(domains.domain(v), [&](Index value) {
        if (told < listed_values) text += (told == 0 ? ": " : ", ") + value_name(variable, value);
        if (told == listed_values) text += ", ...";
        ++told;
      });
      outcome.facts.push_back({"domain of '" + variable.name + "'", text});
    }
  }

  Missing missing_;
  bool search_;
  const LabelingProblem& problem_;
  Deadline& deadline_;
  CrispNetwork network_;
  std::uint64_t nodes_ = 0;
  bool inconsistent_ = false;  ///< the relaxed problem is proven to be
  bool none_ = false;          ///< proven: no consistent labelling, with or without something missing
};

class DiscreteRelaxation final : public Labeler {
 public:
  explicit DiscreteRelaxation(const Options& options)
      : missing_(options.text("missing") == "allowed" ? Missing::allowed
                 : options.text("missing") == "never" ? Missing::never
                                                      : Missing::only_if_needed),
        search_(options.boolean("search")) {}

  LabelingOutcome solve(const LabelingProblem& problem, const LabelingRequest& request,
                        Context& context) const override {
    Deadline deadline(request.time_limit_s, context);
    check(problem);
    if (problem.variables.empty()) return without_variables(problem);
    return Run(missing_, search_, problem, deadline).outcome(request, context);
  }

 private:
  Missing missing_;
  bool search_;
};

constexpr OptionSpec options[] = {
    {"missing", OptionType::text, "", "only-if-needed", "", "",
     "the domains are relaxed with nothing missing, and where that has no labelling the fewest may be; or with "
     "*missing* a value like others; or with nothing missing ever",
     "only-if-needed|allowed|never"},
    {"search", OptionType::boolean, "", "true", "", "",
     "look for the first consistent labelling, arc consistency maintained; false: relaxation alone"},
};

}  // namespace

TOPOSCOPE_PLUGIN(Labeler, DiscreteRelaxation,
                 {.id = "discrete-relaxation",
                  .version = "1.0.0",
                  .summary = "Arc consistency: what no consistent labelling can have, and why",
                  .citation = "Neal 1999, section 3.4.2",
                  .options = options})
