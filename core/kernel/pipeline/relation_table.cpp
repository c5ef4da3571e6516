// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/relation_table.h"

#include <algorithm>
#include <limits>

#include "base/errors.h"
#include "plugin/guard.h"
#include "probability/likelihood.h"
#include "toposcope/labeling/tools.h"

namespace toposcope {
namespace {

constexpr std::size_t max_table = 16'000'000;
constexpr std::size_t grain = 16;

/// Fills a relationship's tables: one row of work per combination of all but the last variable. Where the first two
/// features have the same candidates and their order does not matter, each pair of candidates is tested once.
class TableFiller {
 public:
  TableFiller(const BoundRelation& relation, const LabelingProblem& problem, const ConstructedFeatures& features,
              LabelingConstraint& constraint)
      : relation_(relation), problem_(problem), features_(features), constraint_(constraint) {
    for (Index v : constraint.scope) domain_.push_back(problem.variables[v].domain());
    const std::size_t pairs = arity() < 2 ? 1 : domain_[0] * domain_[1];
    entries_of_a_pair_ = constraint.costs.size() / pairs;
    symmetric_ = arity() >= 2 && !relation.ordered() && candidates(0) == candidates(1);
  }

  void fill() {
    const std::size_t row = domain_.back();
    const Context& context = relation_.run().context;
    relation_.run().context.parallel_for(
        constraint_.costs.size() / row, grain, [&](std::size_t first, std::size_t last) {
          Operands operands{std::vector<const ConstructedFeature*>(arity()), {}, std::vector<Index>(arity())};
          for (std::size_t entry = first * row; entry < last * row && !context.cancelled(); ++entry)
            if (tested(entry) && select(entry, operands)) set(entry, operands);
        });
    if (symmetric_) mirror();
  }

 private:
  /// Of one entry; one per thread.
  struct Operands {
    std::vector<const ConstructedFeature*> features;
    std::vector<RelationOperand> room;
    std::vector<Index> candidates;
  };

  std::size_t arity() const { return constraint_.scope.size(); }
  const std::vector<Index>& candidates(std::size_t i) const {
    return problem_.variables[constraint_.scope[i]].candidates;
  }

  bool tested(std::size_t entry) const {
    const std::size_t pair = entry / entries_of_a_pair_;
    return !symmetric_ || pair / domain_[1] <= pair % domain_[1];
  }

  /// \return false where a feature is missing
  bool select(std::size_t entry, Operands& operands) const {
    std::size_t rest = entry;
    for (std::size_t i = arity(); i-- > 0;) {
      const std::size_t value = rest % domain_[i];
      rest /= domain_[i];
      if (value == 0) return false;
      operands.candidates[i] = candidates(i)[value - 1];
      operands.features[i] = &features_.all[operands.candidates[i]];
    }
    return true;
  }

  void set(std::size_t entry, Operands& operands) {
    if (conflict(operands.candidates)) {  // never both labelled: not worth a test
      constraint_.violations[entry] = std::numeric_limits<float>::infinity();
      constraint_.costs[entry] = forbidden;
      return;
    }
    const ProbabilityModel& probability = relation_.run().stations.probability;
    const RelationResult result = relation_.test(operands.features, operands.room);
    constraint_.violations[entry] = static_cast<float>(violation(result));
    constraint_.costs[entry] = probability.crisp && !(constraint_.violations[entry] <= 1)
                                   ? forbidden
                                   : -relation_evidence(probability, result);
  }

  bool conflict(const std::vector<Index>& candidates) const {
    for (std::size_t i = 0; i < candidates.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        if (problem_.conflict(candidates[i], candidates[j])) return true;
    return false;
  }

  void mirror() {
    const auto copy = [&](auto& table, std::size_t from, std::size_t to) {
      std::copy_n(table.begin() + static_cast<std::ptrdiff_t>(from), entries_of_a_pair_,
                  table.begin() + static_cast<std::ptrdiff_t>(to));
    };
    for (std::size_t i = 0; i < domain_[0]; ++i)
      for (std::size_t j = 0; j < i; ++j) {
        const std::size_t to = (i * domain_[1] + j) * entries_of_a_pair_,
                          from = (j * domain_[1] + i) * entries_of_a_pair_;
        copy(constraint_.costs, from, to);
        copy(constraint_.violations, from, to);
      }
  }

  const BoundRelation& relation_;
  const LabelingProblem& problem_;
  const ConstructedFeatures& features_;
  LabelingConstraint& constraint_;
  std::vector<std::size_t> domain_;  ///< per variable of the scope
  std::size_t entries_of_a_pair_ = 1;
  bool symmetric_ = false;
};

}  // namespace

std::size_t table_size(const Relationship& relationship, const LabelingProblem& problem) {
  std::size_t size = 1;
  for (Index v : relationship.features) {
    size *= problem.variables[v].domain();
    if (size > max_table)
      throw UsageError(relationship.where.str() + ": relationship '" + relationship.name +
                       "' would need a table of over " + std::to_string(max_table) +
                       " entries; lower probability.max_candidates");
  }
  return size;
}

LabelingConstraint relation_table(const BoundRelation& relation, const LabelingProblem& problem,
                                  const ConstructedFeatures& features) {
  const std::size_t size = table_size(relation.relationship(), problem);
  LabelingConstraint constraint{relation.relationship().name, relation.relationship().features,
                                std::vector<double>(size, 0), std::vector<float>(size, 0)};
  guard(relation.relationship().plugin, [&] { TableFiller(relation, problem, features, constraint).fill(); });
  return constraint;
}

}  // namespace toposcope
