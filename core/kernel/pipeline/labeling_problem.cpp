// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/labeling_problem.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/errors.h"
#include "plugin/plugin_host.h"
#include "toposcope/labeling/tools.h"

namespace toposcope {
namespace {

constexpr std::size_t max_table = 16'000'000;
constexpr std::size_t grain = 16;
constexpr double posterior_rounding = 1e-6;  ///< of a variable's probabilities, summed

std::vector<OptionValue> relation_arguments(const MeshView& mesh, const Relationship& relationship,
                                            const std::vector<OptionValue>& defaults) {
  std::vector<OptionValue> values = defaults;
  for (const auto& argument : relationship.arguments) {
    const std::string& name = argument.first;
    const Expression& expression = argument.second;
    auto value = std::find_if(values.begin(), values.end(), [&](const OptionValue& v) { return v.name == name; });
    if (value == values.end()) value = values.insert(value, {name, 0, ""});
    value->number = expression.evaluate({mesh.box, Box{}});
    if (!std::isfinite(value->number))
      throw UsageError(relationship.where.str() + ": '" + name + ": " + expression.text() +
                       "' is no number on this mesh; mind divisions by a box side of 0");
  }
  // By convention of the relations that hold within a range.
  const auto named = [&](const char* name) {
    return std::find_if(values.begin(), values.end(), [&](const OptionValue& v) { return v.name == name; });
  };
  const auto low = named("min"), high = named("max");
  if (low != values.end() && high != values.end() && low->number > high->number)
    throw UsageError(relationship.where.str() + ": relationship '" + relationship.name + "' asks for at least " +
                     std::to_string(low->number) + " and at most " + std::to_string(high->number) +
                     " on this mesh; exchange min and max");
  return values;
}

/// What the costs are made of must be numbers.
void check(const RelationResult& result) {
  if (!result.applicable) return;
  const bool sound = std::isfinite(result.residual) && result.residual >= 0 && result.tolerance > 0 && result.sd >= 0 &&
                     result.dof >= 1 && result.slack >= 0 && result.samples >= 0 && result.clutter_density > 0 &&
                     std::isfinite(result.clutter_density);
  if (!sound) throw std::runtime_error("gave a residual, tolerance, deviation or density that is out of its range");
}

/// A relationship made ready for one mesh: its expressions evaluated.
struct BoundRelation {
  const RelationTester* tester;
  bool ordered;
  std::vector<OptionValue> arguments;
  std::optional<double> tolerance;  ///< rad or mesh unit

  BoundRelation(const MeshView& mesh, const Model& model, Index relationship, const Stations& stations)
      : tester(stations.relations.at(model.relationships[relationship].plugin).get()),
        ordered(stations.relation_ordered[relationship]),
        arguments(
            relation_arguments(mesh, model.relationships[relationship], stations.relation_defaults[relationship])) {
    if (const auto& given = model.relationships[relationship].tolerance)
      tolerance = positive_on_mesh(*given, {mesh.box, Box{}}, model.relationships[relationship].where, "tolerance") *
                  (stations.relation_units[relationship] == "deg" ? pi / 180 : 1);
  }

  bool operator==(const BoundRelation& other) const {
    return tester == other.tester && tolerance == other.tolerance && arguments == other.arguments;
  }

  RelationResult test(const MeshView& mesh, std::span<const ConstructedFeature* const> features,
                      std::vector<RelationOperand>& operands, Context& context) const {
    operands.clear();
    for (const ConstructedFeature* feature : features)
      operands.push_back({&feature->shape, feature->points, feature->box, feature->vertices});
    RelationResult result = tester->test({operands, mesh.box, mesh.mean_edge, &mesh}, Options(arguments), context);
    if (tolerance) result.tolerance = *tolerance;
    check(result);
    return result;
  }
};

/// Entries of a relationship's table. `taken` bytes are in tables already; the table's own are added.
std::size_t table_size(const Relationship& relationship, const LabelingProblem& problem, const Context& context,
                       std::uint64_t& taken) {
  std::size_t size = 1;
  for (Index v : relationship.features) {
    size *= problem.variables[v].domain();
    if (size > max_table)
      throw UsageError(relationship.where.str() + ": relationship '" + relationship.name +
                       "' would need a table of over " + std::to_string(max_table) +
                       " entries; lower probability.max_candidates");
  }
  taken += size * (sizeof(double) + sizeof(float));
  if (taken > context.memory_budget())
    throw UsageError(relationship.where.str() + ": with relationship '" + relationship.name +
                     "' the tables of this model would need " + std::to_string(taken) +
                     " bytes, and this run may take " + std::to_string(context.memory_budget()) +
                     "; lower probability.max_candidates");
  return size;
}

LabelingConstraint empty_constraint(const Relationship& relationship, std::size_t size) {
  LabelingConstraint constraint;
  constraint.name = relationship.name;
  constraint.scope = relationship.features;
  constraint.costs.assign(size, 0);
  constraint.violations.assign(size, 0);
  return constraint;
}

/// Fills a relationship's tables: one row of work per combination of all but the last variable. Where the first two
/// features have the same candidates and their order does not matter, each pair of candidates is tested once.
void fill_constraint(LabelingConstraint& constraint, const MeshView& mesh, const BoundRelation& relation,
                     const LabelingProblem& problem, const ConstructedFeatures& features,
                     const ProbabilityModel& probability, Context& context) {
  const std::size_t arity = constraint.scope.size();
  std::vector<std::size_t> domain;
  for (Index v : constraint.scope) domain.push_back(problem.variables[v].domain());
  const std::size_t row = domain.back(), pairs = arity < 2 ? 1 : domain[0] * domain[1];
  const std::size_t entries_of_a_pair = constraint.costs.size() / pairs;
  const bool symmetric =
      arity >= 2 && !relation.ordered &&
      problem.variables[constraint.scope[0]].candidates == problem.variables[constraint.scope[1]].candidates;
  const auto tested = [&](std::size_t entry) {
    const std::size_t pair = entry / entries_of_a_pair;
    return !symmetric || pair / domain[1] <= pair % domain[1];
  };
  context.parallel_for(constraint.costs.size() / row, grain, [&](std::size_t first, std::size_t last) {
    std::vector<Index> ids(arity);
    std::vector<const ConstructedFeature*> given(arity);
    std::vector<RelationOperand> operands;
    for (std::size_t entry = first * row; entry < last * row && !context.cancelled(); ++entry) {
      if (!tested(entry)) continue;
      std::size_t rest = entry;
      bool missing = false;
      for (std::size_t i = arity; i-- > 0;) {
        const std::size_t value = rest % domain[i];
        rest /= domain[i];
        missing = missing || value == 0;
        if (value > 0) ids[i] = problem.variables[constraint.scope[i]].candidates[value - 1];
      }
      if (missing) continue;
      bool conflict = false;  // never both labelled: not worth a test
      for (std::size_t i = 0; i < arity; ++i) {
        for (std::size_t j = 0; j < i; ++j) conflict = conflict || problem.conflict(ids[i], ids[j]);
        given[i] = &features.all[ids[i]];
      }
      if (conflict) {
        constraint.violations[entry] = std::numeric_limits<float>::infinity();
        constraint.costs[entry] = forbidden;
        continue;
      }
      const RelationResult result = relation.test(mesh, given, operands, context);
      constraint.violations[entry] = static_cast<float>(violation(result));
      constraint.costs[entry] = probability.crisp && !(constraint.violations[entry] <= 1)
                                    ? forbidden
                                    : -relation_evidence(probability, result);
    }
  });
  if (!symmetric) return;
  for (std::size_t i = 0; i < domain[0]; ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const std::size_t to = (i * domain[1] + j) * entries_of_a_pair, from = (j * domain[1] + i) * entries_of_a_pair;
      std::copy_n(constraint.costs.begin() + static_cast<std::ptrdiff_t>(from), entries_of_a_pair,
                  constraint.costs.begin() + static_cast<std::ptrdiff_t>(to));
      std::copy_n(constraint.violations.begin() + static_cast<std::ptrdiff_t>(from), entries_of_a_pair,
                  constraint.violations.begin() + static_cast<std::ptrdiff_t>(to));
    }
}

}  // namespace

RelationResult test_relationship(const MeshView& mesh, const Model& model, Index relationship,
                                 std::span<const ConstructedFeature* const> features, const Stations& stations,
                                 Context& context) {
  const BoundRelation relation(mesh, model, relationship, stations);
  std::vector<RelationOperand> operands;
  return guard(model.relationships[relationship].plugin,
               [&] { return relation.test(mesh, features, operands, context); });
}

LabelingProblem build_problem(const MeshView& mesh, const Model& model, const ConstructedFeatures& features,
                              const BitMatrix& overlap, const Stations& stations, Context& context,
                              const LabelingProblem* known) {
  LabelingProblem problem;
  problem.name = model.name;
  for (Index f = 0; f < model.features.size(); ++f) {
    const FeatureCandidates& candidates = features.of_feature[f];
    LabelingVariable& variable = problem.variables.emplace_back();
    variable.name = model.features[f].name;
    variable.detectability = model.features[f].detectability;
    variable.candidates = candidates.constructed;
    const DetectabilityCosts costs = detectability_costs(stations.probability, variable.detectability);
    variable.costs.push_back(costs.missing);
    // A feature that is there is any one of the groups there were to choose from: the prior is shared among them.
    for (std::size_t c = 0; c < candidates.evidence.size(); ++c)
      variable.costs.push_back(costs.present + std::log(candidates.ways[c]) - candidates.evidence[c]);
  }

  const Index count = static_cast<Index>(features.all.size());
  BitMatrix conflicts(count);
  for (Index a = 0; a < count; ++a)
    for (Index b = 0; b < count; ++b)
      for (Index s : features.all[a].sets)
        for (Index t : features.all[b].sets)
          if (overlap.get(s, t)) conflicts.set(a, b);
  problem.candidate_count = count;
  problem.conflict_bits = std::move(conflicts.bits);

  std::vector<BoundRelation> relations;
  std::uint64_t taken = 0;  // bytes in tables
  for (Index r = 0; r < model.relationships.size(); ++r) {
    const Relationship& relationship = model.relationships[r];
    relations.emplace_back(mesh, model, r, stations);
    const std::size_t size = table_size(relationship, problem, context, taken);
    const auto same = [&](Index v) { return problem.variables[v].candidates == known->variables[v].candidates; };
    if (known && std::all_of(relationship.features.begin(), relationship.features.end(), same)) {
      problem.constraints.push_back(known->constraints[r]);
      continue;
    }
    // Port and starboard, wings and stabilisers: one table serves all that ask the same of the same candidates.
    const auto same_candidates = [&](Index v, Index w) {
      return problem.variables[v].candidates == problem.variables[w].candidates;
    };
    Index twin = 0;
    while (twin < r &&
           !(relations[twin] == relations[r] && std::equal(relationship.features.begin(), relationship.features.end(),
                                                           problem.constraints[twin].scope.begin(),
                                                           problem.constraints[twin].scope.end(), same_candidates)))
      ++twin;
    if (twin < r) {
      LabelingConstraint constraint = problem.constraints[twin];
      constraint.name = relationship.name;
      constraint.scope = relationship.features;
      problem.constraints.push_back(std::move(constraint));
      continue;
    }
    LabelingConstraint& constraint = problem.constraints.emplace_back(empty_constraint(relationship, size));
    guard(relationship.plugin,
          [&] { fill_constraint(constraint, mesh, relations[r], problem, features, stations.probability, context); });
    context.progress(static_cast<double>(r + 1) / static_cast<double>(model.relationships.size()));
  }
  return problem;
}

std::vector<ClassOutcome> pose_classes(const LabelingProblem& problem, const Model& model,
                                       const ProbabilityModel& probability) {
  std::vector<ClassOutcome> posed;
  if (model.classes.empty()) {
    ClassOutcome& whole = posed.emplace_back();
    whole.name = model.name;
    whole.problem = problem;
    whole.features.resize(problem.variables.size());
    whole.relationships.resize(problem.constraints.size());
    std::iota(whole.features.begin(), whole.features.end(), 0);
    std::iota(whole.relationships.begin(), whole.relationships.end(), 0);
    return posed;
  }
  for (const ClassRule& rule : model.classes) {
    ClassOutcome& part = posed.emplace_back();
    part.name = part.problem.name = rule.name;
    part.relationships = rule.relationships;
    part.problem.candidate_count = problem.candidate_count;
    part.problem.conflict_bits = problem.conflict_bits;
    for (Index v = 0; v < problem.variables.size(); ++v) {
      const bool named = std::any_of(rule.relationships.begin(), rule.relationships.end(), [&](Index r) {
        const auto& scope = problem.constraints[r].scope;
        return std::find(scope.begin(), scope.end(), v) != scope.end();
      });
      if (!named) continue;
      part.features.push_back(v);
      LabelingVariable& variable = part.problem.variables.emplace_back(problem.variables[v]);
      const DetectabilityCosts general = detectability_costs(probability, variable.detectability);
      const DetectabilityCosts here = detectability_costs(probability, 1);
      variable.detectability = 1;
      variable.costs[0] = here.missing;
      for (std::size_t k = 1; k < variable.costs.size(); ++k) variable.costs[k] += here.present - general.present;
    }
    for (Index r : rule.relationships) {
      LabelingConstraint& constraint = part.problem.constraints.emplace_back(problem.constraints[r]);
      for (Index& v : constraint.scope)
        v = static_cast<Index>(std::find(part.features.begin(), part.features.end(), v) - part.features.begin());
    }
  }
  return posed;
}

LabelingProblem restricted(const LabelingProblem& problem, const std::vector<std::vector<Index>>& kept) {
  LabelingProblem result;
  result.name = problem.name;
  result.candidate_count = problem.candidate_count;
  result.conflict_bits = problem.conflict_bits;
  for (Index v = 0; v < problem.variables.size(); ++v) {
    const LabelingVariable& from = problem.variables[v];
    LabelingVariable& to = result.variables.emplace_back();
    to.name = from.name;
    to.detectability = from.detectability;
    for (Index value : kept[v]) {
      to.costs.push_back(from.costs[value]);
      if (value > 0) to.candidates.push_back(from.candidates[value - 1]);
    }
  }
  for (const LabelingConstraint& from : problem.constraints) {
    LabelingConstraint& to = result.constraints.emplace_back();
    to.name = from.name;
    to.scope = from.scope;
    std::size_t size = 1;
    for (Index v : from.scope) size *= kept[v].size();
    to.costs.resize(size);
    to.violations.resize(size);
    for (std::size_t entry = 0; entry < size; ++entry) {
      std::size_t rest = entry, source = 0, stride = 1;
      for (std::size_t i = from.scope.size(); i-- > 0;) {
        const auto& values = kept[from.scope[i]];
        source += values[rest % values.size()] * stride;
        rest /= values.size();
        stride *= problem.variables[from.scope[i]].domain();
      }
      to.costs[entry] = from.costs[source];
      to.violations[entry] = from.violations[source];
    }
  }
  return result;
}

void check_outcome(const LabelingProblem& problem, const LabelingOutcome& outcome, const std::string& plugin) {
  if (outcome.labelings.empty() && !all_missing(problem).empty())
    throw PluginError(plugin, "gave no labelling, not even that all is missing");
  for (const Labeling& labeling : outcome.labelings) {
    if (labeling.values.size() != problem.variables.size())
      throw PluginError(plugin, "gave a labelling of " + std::to_string(labeling.values.size()) + " values for " +
                                    std::to_string(problem.variables.size()) + " variables");
    for (Index v = 0; v < labeling.values.size(); ++v)
      if (labeling.values[v] >= problem.variables[v].domain())
        throw PluginError(plugin, "gave '" + problem.variables[v].name + "' value " +
                                      std::to_string(labeling.values[v]) + " of " +
                                      std::to_string(problem.variables[v].domain()));
    if (!meets_exclusions(problem, labeling.values))
      throw PluginError(plugin, "labelled two features with candidates that share a vertex");
  }
  for (const Labeling& labeling : outcome.labelings) {
    const double cost = cost_of(problem, labeling.values);
    if (!(outcome.lower_bound <= cost) && !(outcome.lower_bound <= cost + rounding_slack(problem)))
      throw PluginError(plugin, "gave " + std::to_string(outcome.lower_bound) +
                                    " as the least that a labelling can cost, and one that costs " +
                                    std::to_string(cost));
  }
  if (std::isnan(outcome.log_evidence) != (outcome.evidence_exactness == Exactness::none))
    throw PluginError(plugin, "does not say whether its evidence is exact, or says it of none");
  if (outcome.posteriors.empty() != (outcome.posterior_exactness == Exactness::none))
    throw PluginError(plugin, "does not say whether its posteriors are exact, or says it of none");
  if (outcome.posteriors.empty()) return;
  bool sized = outcome.posteriors.size() == problem.variables.size();
  for (Index v = 0; sized && v < problem.variables.size(); ++v)
    sized = outcome.posteriors[v].size() == problem.variables[v].domain();
  if (!sized) throw PluginError(plugin, "gave posteriors that do not match the variables' domains");
  for (Index v = 0; v < problem.variables.size(); ++v) {
    double sum = 0;
    for (const double p : outcome.posteriors[v]) {
      if (!(p >= 0 && p <= 1 + posterior_rounding))
        throw PluginError(plugin, "gave a value of '" + problem.variables[v].name + "' the probability " +
                                      std::to_string(p) + ", which is not from 0 to 1");
      sum += p;
    }
    if (!(std::abs(sum - 1) <= posterior_rounding))
      throw PluginError(plugin, "gave '" + problem.variables[v].name + "' probabilities that sum to " +
                                    std::to_string(sum) + " and not to 1");
  }
}

}  // namespace toposcope
