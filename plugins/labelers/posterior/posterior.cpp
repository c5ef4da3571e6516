// SPDX-License-Identifier: BSD-3-Clause
// Marginals and evidence of a labelling problem: exact by elimination or by exhaustive search, else by belief
// propagation.

#include "run.h"
#include "toposcope/labeling/tools.h"
#include "toposcope/plugin.h"

namespace {

using namespace toposcope;
using namespace toposcope::posterior;

class Posterior final : public Labeler {
 public:
  explicit Posterior(const Options& options)
      : settings_{options.text("method"), options.real("max_entries"), options.real("tolerance"),
                  options.real("damping"), static_cast<std::uint64_t>(options.integer("max_sweeps"))} {}

  LabelingOutcome solve(const LabelingProblem& problem, const LabelingRequest& request,
                        Context& context) const override {
    check(problem);
    if (problem.variables.empty()) {
      LabelingOutcome outcome;
      outcome.labelings = all_missing(problem);
      outcome.lower_bound = problem.constant;
      outcome.optimal = true;
      outcome.log_evidence = -problem.constant;
      outcome.evidence_exactness = Exactness::exact;
      outcome.guarantee = "exact: a problem without variables has one labelling";
      return outcome;
    }
    LabelingOutcome outcome = posterior::run(settings_, problem, request, context);
    context.progress(1);
    return outcome;
  }

 private:
  Settings settings_;
};

constexpr OptionSpec options[] = {
    {"method", OptionType::text, "", "auto", "", "",
     "how the sums are made; auto: whichever exact method is done first, belief propagation where neither is",
     "auto|elimination|search|belief-propagation"},
    {"max_entries", OptionType::real, "", "33554432", "1", "1e10",
     "elimination is feasible where its tables have at most so many entries together (8 bytes each)"},
    {"tolerance", OptionType::real, "", "1e-12", "1e-15", "0.1",
     "search: part of the evidence that may be left out, and so the largest error of a probability"},
    {"damping", OptionType::real, "", "0.5", "0", "0.99",
     "belief propagation: part of the old message that stays, once 20 sweeps have not converged"},
    {"max_sweeps", OptionType::integer, "", "1000", "1", "1000000", "belief propagation: sweeps at most"},
};

}  // namespace

TOPOSCOPE_PLUGIN(Labeler, Posterior,
                 {.id = "posterior",
                  .version = "1.0.0",
                  .summary = "Marginal probabilities and evidence, exact where that is feasible",
                  .citation = "Dechter 1999, Artificial Intelligence 113; Pearl 1988",
                  .options = options})
