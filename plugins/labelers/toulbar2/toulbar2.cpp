// SPDX-License-Identifier: BSD-3-Clause
// Drives the program toulbar2 through a file.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <sstream>
#include <stdexcept>

#include "solver_output.h"
#include "solver_process.h"
#include "toposcope/labeling/problem_writer.h"
#include "toposcope/labeling/tools.h"
#include "toposcope/plugin.h"
#include "toposcope/system/programs.h"

namespace {

using namespace toposcope;
using namespace toposcope::toulbar2;

/// What the sum of all costs may lose in the file: half a unit of the last digit for each function.
double rounding_of(const LabelingProblem& problem, const WrittenProblem& written) {
  const double slack = rounding_slack(problem);
  if (written.exact) return slack;
  const auto functions = static_cast<double>(1 + problem.variables.size() + problem.constraints.size());
  return slack + functions * 0.5 * std::pow(10.0, -written.decimals);
}

LabelingOutcome counted(const SolverOutput& output) {
  LabelingOutcome outcome;
  outcome.nodes = output.nodes;
  if (output.optimal || output.unsatisfiable)
    outcome.facts.push_back({"backtracks", std::to_string(output.backtracks)});
  return outcome;
}

/// An optimum that its own labelling does not have proves nothing: a fault of the solver, or a problem beyond its
/// numbers.
std::string contradiction(double cost, const SolverOutput& output, double rounding) {
  if (!output.optimum || std::abs(*output.optimum - cost) <= 2 * rounding + 1e-9 * std::abs(cost)) return "";
  char words[160];
  std::snprintf(words, sizeof words, "not proven: toulbar2 states an optimum of %.10g, and its labelling costs %.10g",
                *output.optimum, cost);
  return words;
}

LabelingOutcome proven(const LabelingProblem& problem, const SolverOutput& output, const WrittenProblem& written) {
  LabelingOutcome outcome = counted(output);
  outcome.optimal = true;
  if (output.unsatisfiable) {
    outcome.lower_bound = forbidden;
    outcome.labelings = all_missing(problem);
    outcome.guarantee = "no labelling is allowed: proven by toulbar2";
    return outcome;
  }
  if (output.values.empty()) throw std::runtime_error("toulbar2 proved an optimum but printed no labelling");
  outcome.labelings = {{output.values, cost_of(problem, output.values)}};
  const double printed = written.exact ? 0 : 0.5 * std::pow(10.0, -written.decimals);
  if (const std::string contradicted =
          contradiction(outcome.labelings[0].cost, output, rounding_of(problem, written) + printed);
      !contradicted.empty()) {
    outcome.optimal = false;
    outcome.guarantee = contradicted;
    return outcome;
  }
  const bool whole = written.exact && written.decimals == 0;  // sums without rounding
  outcome.lower_bound = outcome.labelings[0].cost - (whole ? 0 : rounding_of(problem, written));
  outcome.guarantee = "least cost: proven by toulbar2";
  if (!written.exact)
    outcome.guarantee += ", each cost rounded to " + std::to_string(written.decimals) + " digits after the point";
  return outcome;
}

LabelingOutcome stopped(const LabelingProblem& problem, const SolverOutput& output, double rounding) {
  LabelingOutcome outcome = counted(output);
  outcome.labelings = all_missing(problem);
  if (!output.values.empty()) {
    const Labeling found{output.values, cost_of(problem, output.values)};
    if (outcome.labelings.empty() || found.cost < outcome.labelings[0].cost) outcome.labelings = {found};
  }
  if (output.lower_bound) outcome.lower_bound = *output.lower_bound - rounding;
  if (!outcome.labelings.empty()) outcome.lower_bound = std::min(outcome.lower_bound, outcome.labelings[0].cost);
  outcome.guarantee = "not proven: toulbar2 was stopped; the best that it had found";
  return outcome;
}

class Toulbar2 final : public Labeler {
 public:
  explicit Toulbar2(const Options& options) {
    std::istringstream words(options.text("arguments"));
    for (std::string word; words >> word;) arguments_.push_back(word);
  }

  LabelingOutcome solve(const LabelingProblem& problem, const LabelingRequest& request,
                        Context& context) const override {
    Deadline deadline(request.time_limit_s, context);
    check(problem);
    if (problem.variables.empty()) {
      LabelingOutcome outcome;
      outcome.labelings = all_missing(problem);
      outcome.lower_bound = problem.constant;
      outcome.optimal = true;
      outcome.guarantee = "a problem without variables has one labelling";
      return outcome;
    }
    const auto program = find_program("toulbar2");
    if (!program) throw std::runtime_error("needs the program 'toulbar2' (apt-get install toulbar2)");
    if (deadline.reached()) return stopped(problem, {}, 0);
    const WrittenProblem written = write_cfn(problem, forbidden, false, [&] { return deadline.reached(); });
    if (deadline.reached()) return stopped(problem, {}, 0);
    const TemporaryFolder folder;
    const fs::path file = folder.path() / "problem.cfn", printed = folder.path() / "output.txt";
    write_text(file, written.text);

    std::vector<std::string> arguments = {file.string(), "-s=1"};
    arguments.insert(arguments.end(), arguments_.begin(), arguments_.end());
    const bool ended = run(*program, arguments, printed, [&] { return deadline.reached(); });
    const SolverOutput output = parse_output(read_text(printed), problem);
    if (ended && (output.optimal || output.unsatisfiable)) return proven(problem, output, written);
    if (ended && output.values.empty())
      throw std::runtime_error("toulbar2 ended without an answer; its last words are: " + output.last_line);
    return stopped(problem, output, rounding_of(problem, written));
  }

 private:
  std::vector<std::string> arguments_;
};

constexpr OptionSpec options[] = {
    {"arguments", OptionType::text, "", "-v=0", "", "", "further arguments of toulbar2, separated by spaces"},
};

}  // namespace

TOPOSCOPE_PLUGIN(Labeler, Toulbar2,
                 {.id = "toulbar2",
                  .version = "1.0.0",
                  .summary = "The exact solver toulbar2, driven through a file",
                  .citation = "Hurley et al. 2016",
                  .options = options,
                  .programs = "toulbar2"})
