// SPDX-License-Identifier: BSD-3-Clause

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "base/assignment.h"
#include "base/errors.h"
#include "commands.h"
#include "formats/problem_io.h"
#include "options.h"
#include "output.h"
#include "pipeline/solve.h"
#include "result/exactness.h"
#include "session.h"
#include "toposcope/labeling/tools.h"

namespace toposcope::cli {
namespace {

struct LabelOptions : CommonOptions {
  fs::path problem;
  fs::path save;  ///< empty: not written
  std::size_t k_best = 1;
  double within = std::numeric_limits<double>::infinity();
  double time_limit_s = 60;
  bool marginals = false;
};

using nlohmann::ordered_json;

std::shared_ptr<const Labeler> make_labeler(const LabelOptions& options, const std::string& id, PluginHost& host) {
  const PluginManifest& plugin = host.catalog().require(PluginKind::labelers, id, "--labeler");
  std::vector<GivenOption> given;
  for (const std::string& text : options.overrides) {
    const auto option = split_assignment(text);
    if (!option || !option->first.starts_with("labeler."))
      throw UsageError("--set " + text + ": expected labeler.option=value");
    given.emplace_back(option->first.substr(8), option->second);
  }
  return host.labeler(id, check_options(plugin.options, given, "--set: labeler '" + plugin.id + "'"));
}

std::string value_name(const LabelingVariable& variable, Index value) {
  if (variable.missing(value)) return "missing";
  return variable.value_names.empty() ? std::to_string(value) : variable.value_names[value];
}

ordered_json values_of(const LabelingProblem& problem, const Labeling& labeling) {
  ordered_json values;
  for (Index v = 0; v < problem.variables.size(); ++v) {
    const LabelingVariable& variable = problem.variables[v];
    if (variable.value_names.empty())
      values[variable.name] = labeling.values[v];
    else
      values[variable.name] = variable.value_names[labeling.values[v]];
  }
  return values;
}

ordered_json error_of(Exactness exactness, double error) {
  return exactness == Exactness::bound ? ordered_json(error) : ordered_json();
}

// What is no finite number is written as null.
std::string as_json(const LabelingProblem& problem, const LabelingOutcome& outcome, const std::string& labeler,
                    double time_ms) {
  const bool found = !outcome.labelings.empty() && outcome.labelings[0].cost < forbidden;
  ordered_json root = {{"schema", "toposcope.labeling/1"},
                       {"problem", problem.name},
                       {"labeler", labeler},
                       {"labeling", found ? values_of(problem, outcome.labelings[0]) : ordered_json()},
                       {"cost", found ? ordered_json(outcome.labelings[0].cost) : ordered_json()},
                       {"lower_bound", outcome.lower_bound},
                       {"optimal", outcome.optimal},
                       {"satisfiable", found             ? ordered_json(true)
                                       : outcome.optimal ? ordered_json(false)
                                                         : ordered_json()},
                       {"posteriors", ordered_json()},
                       {"posterior_exactness", name_of(outcome.posterior_exactness)},
                       {"posterior_error", error_of(outcome.posterior_exactness, outcome.posterior_error)},
                       {"log_evidence", outcome.log_evidence},
                       {"evidence_exactness", name_of(outcome.evidence_exactness)},
                       {"evidence_error", error_of(outcome.evidence_exactness, outcome.evidence_error)},
                       {"nodes", outcome.nodes},
                       {"time_ms", time_ms},
                       {"guarantee", outcome.guarantee}};
  for (Index v = 0; v < outcome.posteriors.size(); ++v)
    root["posteriors"][problem.variables[v].name] = outcome.posteriors[v];
  root["alternatives"] = ordered_json::array();
  for (std::size_t k = 1; k < outcome.labelings.size(); ++k)
    root["alternatives"].push_back(
        {{"labeling", values_of(problem, outcome.labelings[k])}, {"cost", outcome.labelings[k].cost}});
  root["facts"] = ordered_json::object();
  for (const LabelingFact& fact : outcome.facts) root["facts"][fact.name] = fact.value;
  root["removed"] = ordered_json::array();
  for (const RemovedValue& removed : outcome.removed)
    root["removed"].push_back({{"variable", problem.variables[removed.variable].name},
                               {"value", value_name(problem.variables[removed.variable], removed.value)},
                               {"reason", removed.reason}});
  return root.dump(-1, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

std::string as_text(const LabelingProblem& problem, const LabelingOutcome& outcome, const std::string& labeler,
                    double time_ms) {
  std::string text = fmt::format("{}: {} variables, {} constraints\n", problem.name, problem.variables.size(),
                                 problem.constraints.size());
  const bool found = !outcome.labelings.empty() && outcome.labelings[0].cost < forbidden;
  std::size_t width = 8;
  for (const LabelingVariable& variable : problem.variables) width = std::max(width, variable.name.size());
  if (found)
    for (Index v = 0; v < problem.variables.size(); ++v) {
      const Index value = outcome.labelings[0].values[v];
      text += fmt::format("  {:<{}}  {}", problem.variables[v].name, width, value_name(problem.variables[v], value));
      if (!outcome.posteriors.empty()) text += fmt::format("  ({:.4f})", outcome.posteriors[v][value]);
      text += "\n";
    }
  if (found)
    text += fmt::format("cost         {:.10g}\n", outcome.labelings[0].cost);
  else
    text += outcome.optimal ? "no labelling is allowed\n" : "no labelling found\n";
  if (found && !outcome.optimal && std::isfinite(outcome.lower_bound))
    text += fmt::format("lower bound  {:.10g}, gap {:.4g}\n", outcome.lower_bound,
                        outcome.labelings[0].cost - outcome.lower_bound);
  if (!std::isnan(outcome.log_evidence))
    text += fmt::format("log evidence {:.10g} ({})\n", outcome.log_evidence,
                        in_words(outcome.evidence_exactness, outcome.evidence_error, " nats"));
  if (!outcome.posteriors.empty())
    text += fmt::format("posteriors   {}\n", in_words(outcome.posterior_exactness, outcome.posterior_error));
  for (std::size_t k = 1; k < outcome.labelings.size(); ++k) {
    text += fmt::format("next best    {:.10g}:", outcome.labelings[k].cost);
    for (Index v = 0; v < problem.variables.size(); ++v)
      text += " " + value_name(problem.variables[v], outcome.labelings[k].values[v]);
    text += "\n";
  }
  for (const LabelingFact& fact : outcome.facts) text += fmt::format("{}: {}\n", fact.name, fact.value);
  for (const RemovedValue& removed : outcome.removed)
    text += fmt::format("removed: {} = {}: {}\n", problem.variables[removed.variable].name,
                        value_name(problem.variables[removed.variable], removed.value), removed.reason);
  return text + fmt::format("{}: {}; {} nodes, {:.1f} ms\n", labeler, outcome.guarantee, outcome.nodes, time_ms);
}

/// Labellings that cost the file's top or more are no solutions.
void cut_at_top(LabelingOutcome& outcome, double top) {
  if (!(top < forbidden)) return;
  std::erase_if(outcome.labelings, [&](const Labeling& labeling) { return labeling.cost >= top; });
  if (outcome.labelings.empty() && outcome.optimal) {
    outcome.lower_bound = forbidden;
    outcome.guarantee += "; none costs less than the file's top cost";
  }
}

int label(const LabelOptions& options) {
  Session session(options);
  if (!options.save.empty()) require_problem_extension(options.save);
  const ProblemFile file = read_problem(options.problem, session.context().memory_budget());
  const LabelingProblem& problem = file.problem;
  for (const std::string& warning : file.warnings) session.context().log(LogLevel::warning, warning);
  if (!options.save.empty())
    for (const std::string& note : write_problem(options.save, file))
      session.context().log(LogLevel::info, options.save.string() + ": " + note);
  const std::string id = options.labeler.empty() ? "least-error" : options.labeler;
  const LabelingRequest request{
      .k_best = options.k_best, .time_limit_s = options.time_limit_s, .within = options.within};
  const LabelerStation labeler{id, make_labeler(options, id, session.host())};
  const auto start = std::chrono::steady_clock::now();
  LabelingOutcome outcome = solve(labeler, problem, request, session.context());
  const double time_ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  cut_at_top(outcome, file.top);
  if (options.marginals && outcome.posteriors.empty()) {
    const PluginManifest& plugin = session.host().catalog().require(PluginKind::labelers, "posterior", "--marginals");
    const LabelerStation summing{plugin.id,
                                 session.host().labeler(plugin.id, check_options(plugin.options, {}, plugin.id))};
    LabelingOutcome sums = solve(summing, problem, request, session.context());
    take_sums(sums, outcome);
    outcome.facts.push_back({"probabilities", sums.guarantee});
  }
  if (file.maximize) outcome.facts.push_back({"maximised", "costs are minus the values, which the file maximises"});
  session.status("");
  say("{}", options.json ? as_json(problem, outcome, id, time_ms) : as_text(problem, outcome, id, time_ms));
  return session.context().cancelled() ? interrupted_exit_code : 0;
}

}  // namespace

void add_label(CLI::App& app, int& code) {
  CLI::App& command = *app.add_subcommand("label", "solve a labelling problem from a file");
  const auto options = std::make_shared<LabelOptions>();
  command.add_option("problem", options->problem, "JSON, CFN, WCSP or UAI file")->required()->type_name("PROBLEM");
  command.add_option("--labeler", options->labeler, "labeler; default: least-error")->type_name("ID");
  command.add_option("--k-best", options->k_best, "how many labellings to list, the best first")
      ->type_name("K")
      ->check(whole_number(1, 1000000))
      ->capture_default_str();
  command.add_option("--within", options->within, "leave out what costs more than the best by over T")
      ->type_name("T")
      ->check(number_from_zero());
  command.add_flag("--marginals", options->marginals, "the probability of every value");
  command.add_option("--time-limit", options->time_limit_s, "seconds")
      ->type_name("S")
      ->check(number_from_zero())
      ->capture_default_str();
  command.add_option("--save-problem", options->save, "write the problem too, in the format of its extension")
      ->type_name("FILE");
  command.add_flag("--json", options->json, "print a JSON object");
  add_seed(command, options->seed);
  add_session(command, *options);
  command.callback([options, &code] { code = label(*options); });
}

}  // namespace toposcope::cli
