// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include "pipeline/families.h"
#include "probability/likelihood.h"
#include "toposcope/labeling/tools.h"

namespace toposcope {
namespace {

/// Writes families out. Each instance keeps the candidates that share a vertex with its own, those nearer to another
/// instance apart: so it has its own place, and what it might be there.
class Writer {
 public:
  Writer(const ClassOutcome& solved, const ConstructedFeatures& features, const ModelRun& run)
      : solved_(solved), features_(features), run_(run), best_(solved.sets.labelings.front()) {
    for (Index f = 0; f < run.model.features.size(); ++f) family_of_.push_back(place_of(f));
  }

  Instances write(ClassOutcome& written) {
    Instances made;
    made.model = run_.model;
    made.stations = run_.stations;
    made.model.features.clear();
    made.stations.features.clear();
    for (Index f = 0; f < run_.model.features.size(); ++f) {
      first_.push_back(static_cast<Index>(made.origin.size()));
      const Index count = family_of_[f] ? instances_of(*family_of_[f]) : 1;
      for (Index i = 0; i < count; ++i) {
        made.origin.push_back(f);
        ModelFeature& feature = made.model.features.emplace_back(run_.model.features[f]);
        made.stations.features.push_back(run_.stations.features[f]);
        if (family_of_[f]) {
          feature.name += "[" + std::to_string(i + 1) + "]";
          feature.count = {0, 1};
        }
        add_variable(f, i, feature.name);
      }
    }
    first_.push_back(static_cast<Index>(made.origin.size()));
    write_relationships(made);
    write_measures(made.model);
    write_labelings(written.outcome);
    problem_.name = solved_.problem.name;
    problem_.constant = solved_.problem.constant;
    problem_.candidate_count = solved_.problem.candidate_count;
    problem_.conflict_bits = solved_.problem.conflict_bits;
    written.problem = std::move(problem_);
    written.features.resize(made.origin.size());
    std::iota(written.features.begin(), written.features.end(), 0);
    written.relationships.resize(made.model.relationships.size());
    std::iota(written.relationships.begin(), written.relationships.end(), 0);
    return made;
  }

 private:
  std::optional<std::size_t> place_of(Index feature) const {
    for (std::size_t f = 0; f < solved_.families.size(); ++f)
      if (solved_.families[f].feature == feature) return f;
    return std::nullopt;
  }

  Index instances_of(std::size_t family) const {
    return std::max(solved_.families[family].found, run_.model.features[solved_.families[family].feature].count.least);
  }

  const Vec3& centroid(Index feature, Index value) const {
    return features_.all[solved_.problem.variables[feature].candidates[value - 1]].shape.centroid;
  }

  /// The instance that a candidate is another form of; nothing: of none that was found.
  std::optional<std::size_t> owner(Index feature, Index value) const {
    const LabelingVariable& variable = solved_.problem.variables[feature];
    const std::vector<Index>& found = best_.instances[*family_of_[feature]];
    std::optional<std::size_t> owner;
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < found.size(); ++i) {
      if (!solved_.problem.conflict(variable.candidate(value), variable.candidate(found[i]))) continue;
      const double distance = (centroid(feature, value) - centroid(feature, found[i])).squaredNorm();
      if (!(distance < nearest) && owner) continue;
      nearest = distance;
      owner = i;
    }
    return owner;
  }

  /// Values of the family's variable that the instance may take, missing first.
  std::vector<Index> values_of(Index feature, Index instance) const {
    std::vector<Index> values = {0};
    const std::size_t found = best_.instances[*family_of_[feature]].size();
    for (Index value = 1; value < solved_.problem.variables[feature].domain(); ++value) {
      const std::optional<std::size_t> of = owner(feature, value);
      if (instance < found ? of == instance : !of) values.push_back(value);
    }
    return values;
  }

  void add_variable(Index feature, Index instance, const std::string& name) {
    const LabelingVariable& from = solved_.problem.variables[feature];
    std::vector<Index>& kept = kept_.emplace_back();
    LabelingVariable& variable = problem_.variables.emplace_back();
    if (!family_of_[feature]) {
      kept.resize(from.domain());
      std::iota(kept.begin(), kept.end(), 0);
      variable = from;
      if (!solved_.outcome.posteriors.empty()) posteriors_.push_back(solved_.outcome.posteriors[feature]);
      return;
    }
    kept = values_of(feature, instance);
    const DetectabilityCosts costs = detectability_costs(run_.stations.probability, from.detectability);
    variable.name = name;
    variable.detectability = from.detectability;
    for (const Index value : kept) {
      if (value > 0) variable.candidates.push_back(from.candidate(value));
      variable.costs.push_back(value == 0 ? costs.missing : costs.present + from.costs[value]);
    }
    if (!solved_.outcome.posteriors.empty()) posteriors_.push_back(posterior_of(feature, instance, kept));
  }

  /// An instance that was found is missing where none of its candidates is one; one that was not, where fewer are
  /// found.
  std::vector<double> posterior_of(Index feature, Index instance, const std::vector<Index>& kept) const {
    std::vector<double> posterior(kept.size(), 0);
    double sum = 0;
    for (std::size_t k = 1; k < kept.size(); ++k) sum += posterior[k] = solved_.outcome.posteriors[feature][kept[k]];
    double present = std::min(1.0, sum);
    if (instance >= best_.instances[*family_of_[feature]].size()) {
      const std::vector<double>& numbers = solved_.families[*family_of_[feature]].numbers;
      double more = 0;
      for (std::size_t number = instance + 1; number < numbers.size(); ++number) more += numbers[number];
      present = std::min(more, present);
    }
    if (sum > 0)
      for (double& each : posterior) each *= present / sum;
    posterior[0] = 1 - (sum > 0 ? present : 0);
    return posterior;
  }

  void write_relationships(Instances& made) {
    made.model.relationships.clear();
    made.stations.relationships.clear();
    for (Index r = 0; r < run_.model.relationships.size(); ++r) {
      const std::vector<Index>& scope = run_.model.relationships[r].features;
      const auto family = std::find_if(scope.begin(), scope.end(), [&](Index f) { return family_of_[f].has_value(); });
      if (family == scope.end()) {
        write_relationship(r, {}, made);
        continue;
      }
      const Index count = first_[*family + 1] - first_[*family];
      const bool pairs = std::count(scope.begin(), scope.end(), *family) == 2;
      for (Index i = 0; i < count; ++i)
        if (!pairs)
          write_relationship(r, {i}, made);
        else
          for (Index j = i + 1; j < count; ++j) write_relationship(r, {i, j}, made);
    }
  }

  /// \param instances  that take the place of the family, each time it is named
  void write_relationship(Index r, const std::vector<Index>& instances, Instances& made) {
    Relationship& relationship = made.model.relationships.emplace_back(run_.model.relationships[r]);
    made.stations.relationships.push_back(run_.stations.relationships[r]);
    std::size_t named = 0;
    std::string which;
    for (Index& f : relationship.features) {
      const bool of_family = family_of_[f].has_value();
      f = first_[f];
      if (!of_family) continue;
      f += instances[named];
      which += (named == 0 ? "" : ",") + std::to_string(instances[named] + 1);
      ++named;
    }
    if (named > 0) relationship.name += "[" + which + "]";
    write_table(solved_.problem.constraints[r], relationship);
  }

  void write_table(const LabelingConstraint& from, const Relationship& relationship) {
    LabelingConstraint& to = problem_.constraints.emplace_back();
    to.name = relationship.name;
    to.scope = relationship.features;
    std::vector<Index> digits(to.scope.size(), 0);
    do {
      std::size_t entry = 0;
      for (std::size_t i = 0; i < digits.size(); ++i)
        entry = entry * solved_.problem.variables[from.scope[i]].domain() + kept_[to.scope[i]][digits[i]];
      to.costs.push_back(from.costs[entry]);
      if (!from.violations.empty()) to.violations.push_back(from.violations[entry]);
    } while (next_entry(problem_, to, digits));
  }

  void write_measures(Model& model) const {
    for (ModelMeasure& measure : model.measures)
      for (Quantity& quantity : measure.expression.quantities)
        for (Index& f : quantity.features) f = first_[f];
  }

  /// Those whose instances are each a form of another one of the best labelling's.
  void write_labelings(LabelingOutcome& outcome) {
    outcome.labelings.clear();
    for (const FamilyLabeling& labeling : solved_.sets.labelings) {
      Labeling written{std::vector<Index>(kept_.size(), 0), labeling.cost};
      bool each = true;
      for (Index f = 0; f < family_of_.size(); ++f) {
        if (!family_of_[f]) {
          written.values[first_[f]] = labeling.values[f];
          continue;
        }
        for (const Index value : labeling.instances[*family_of_[f]]) {
          const auto at = place(f, value, written.values);
          each = each && at;
          if (at) written.values[at->first] = at->second;
        }
      }
      if (each) outcome.labelings.push_back(std::move(written));
    }
    outcome.posteriors = std::move(posteriors_);
  }

  /// A free instance that may take the value, and the number that the value has there.
  std::optional<std::pair<Index, Index>> place(Index feature, Index value, const std::vector<Index>& taken) const {
    for (Index v = first_[feature]; v < first_[feature + 1]; ++v) {
      const auto at = std::find(kept_[v].begin(), kept_[v].end(), value);
      if (taken[v] == 0 && at != kept_[v].end()) return std::pair{v, static_cast<Index>(at - kept_[v].begin())};
    }
    return std::nullopt;
  }

  const ClassOutcome& solved_;
  const ConstructedFeatures& features_;
  const ModelRun& run_;
  const FamilyLabeling best_;
  std::vector<std::optional<std::size_t>> family_of_;  ///< per feature of the model
  std::vector<Index> first_;                           ///< per feature of the model its first instance
  LabelingProblem problem_;
  std::vector<std::vector<Index>> kept_;  ///< per instance: values of the feature's variable
  std::vector<std::vector<double>> posteriors_;
};

}  // namespace

Instances write_out_instances(ClassOutcome& solved, const ConstructedFeatures& features, const ModelRun& run) {
  const ClassOutcome before = solved;
  return Writer(before, features, run).write(solved);
}

}  // namespace toposcope
