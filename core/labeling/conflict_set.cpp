// SPDX-License-Identifier: BSD-3-Clause
#include "toposcope/labeling/conflict_set.h"

#include <algorithm>

#include "hitting_set.h"
#include "tree_search.h"
#include "words.h"

namespace toposcope {
namespace {

using Items = std::vector<std::size_t>;  // ascending: constraints, then exclusions

class Finder {
 public:
  Finder(const LabelingProblem& problem, const ConflictQuestion& question, Deadline& deadline)
      : problem_(problem), question_(question), deadline_(deadline) {
    const std::size_t n = problem.variables.size();
    part_.exclusions_apart = true;
    if (!question.missing_allowed) {
      part_.present.assign(n, true);
      for (std::size_t v = 0; v < question.fixed.size(); ++v)  // a fixed one may be fixed to *missing*
        if (question.fixed[v] != no_candidate) part_.present[v] = false;
    }
    if (!question.fixed.empty())
      for (std::size_t v = 0; v < n; ++v) {
        part_.open.emplace_back(problem.variables[v].domain(), question.fixed[v] == no_candidate);
        if (question.fixed[v] != no_candidate) part_.open[v][question.fixed[v]] = true;
      }
  }

  ConflictSet find() {
    list_items();
    Items all(items_.size());
    for (std::size_t k = 0; k < all.size(); ++k) all[k] = k;
    ConflictSet made;
    Items core;
    const Answer answer = ask(all, &core);
    if (answer == Answer::met) made.status = ConflictSet::Status::none;
    if (answer != Answer::conflict) return made;
    made.status = reduce(core) ? ConflictSet::Status::minimal : ConflictSet::Status::reduced;
    if (made.status == ConflictSet::Status::minimal && shrink(core)) made.status = ConflictSet::Status::smallest;
    for (const std::size_t k : core) {
      if (items_[k].constraint != no_candidate)
        made.constraints.push_back(items_[k].constraint);
      else
        made.exclusions.emplace_back(items_[k].first, items_[k].second);
    }
    return made;
  }

 private:
  enum class Answer : std::uint8_t { met, conflict, stopped };
  struct Item {
    Index constraint = no_candidate;
    Index first = 0, second = 0;  ///< of an exclusion
  };

  void list_items() {
    const Index n = static_cast<Index>(problem_.variables.size());
    for (Index c = 0; c < problem_.constraints.size(); ++c) {
      const std::vector<Index>& scope = problem_.constraints[c].scope;
      if (question_.about == no_candidate || std::find(scope.begin(), scope.end(), question_.about) != scope.end())
        items_.push_back({c, 0, 0});
    }
    for (Index x = 0; x < n; ++x)
      for (Index y = x + 1; y < n; ++y)
        if (!problem_.variables[x].candidates.empty() && !problem_.variables[y].candidates.empty() &&
            (question_.about == no_candidate || question_.about == x || question_.about == y))
          items_.push_back({no_candidate, x, y});
  }

  // Whether all of the items can be met. `core`: of those that were needed to see that they cannot.
  Answer ask(const Items& items, Items* core) {
    const std::size_t n = problem_.variables.size();
    part_.constraints.assign(problem_.constraints.size(), false);
    part_.exclusions.assign(n * (n - 1) / 2, false);
    for (const std::size_t k : items) {
      if (items_[k].constraint != no_candidate)
        part_.constraints[items_[k].constraint] = true;
      else
        part_.exclusions[exclusion_index(n, items_[k].first, items_[k].second)] = true;
    }
    const CompiledNetwork network(problem_, deadline_, part_);
    FirstFound first(problem_, values_);
    TreeSearch search(network, {}, first, deadline_);
    const TreeSearch::End end = search.run();
    if (end == TreeSearch::End::out_of_time) return Answer::stopped;
    if (end == TreeSearch::End::ended_by_visitor) return Answer::met;
    if (core != nullptr) *core = used(items, network, search.propagation());
    return Answer::conflict;
  }

  Items used(const Items& items, const CompiledNetwork& network, const Propagation& domains) const {
    const std::size_t n = problem_.variables.size();
    std::vector<bool> constraints(problem_.constraints.size(), false), exclusions(n * (n - 1) / 2, false);
    for (Index c = 0; c < problem_.constraints.size(); ++c) constraints[c] = problem_.constraints[c].scope.size() == 1;
    for (std::size_t p = 0; p < network.pairs().size(); ++p) {
      if (!domains.pairs_used()[p]) continue;
      const CrispPair& pair = network.pairs()[p];
      for (const Index c : pair.constraints) constraints[c] = true;
      if (pair.exclusion) exclusions[exclusion_index(n, pair.first, pair.second)] = true;
    }
    for (std::size_t t = 0; t < network.tables().size(); ++t)
      if (domains.tables_used()[t]) constraints[network.tables()[t].constraint] = true;
    Items kept;
    for (const std::size_t k : items)
      if (items_[k].constraint != no_candidate ? constraints[items_[k].constraint]
                                               : exclusions[exclusion_index(n, items_[k].first, items_[k].second)])
        kept.push_back(k);
    return kept;
  }

  // By deletion, from the last item on: exclusions go first. False when stopped.
  bool reduce(Items& core) {
    for (std::size_t k = core.size(); k-- > 0;) {
      Items rest = core, smaller;
      rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(k));
      const Answer answer = ask(rest, &smaller);
      if (answer == Answer::stopped) return false;
      if (answer == Answer::met) continue;
      // Those after k were needed by a larger set already.
      const auto before = std::lower_bound(smaller.begin(), smaller.end(), core[k]);
      k = static_cast<std::size_t>(before - smaller.begin());
      core = smaller;
    }
    return true;
  }

  // False when stopped before `core` was known to be the smallest.
  bool shrink(Items& core) {
    std::vector<Items> complements;
    Items trial;
    while (smallest_hitting_set(complements, items_.size(), core.size(), deadline_, trial)) {
      const Answer answer = ask(trial, nullptr);
      if (answer == Answer::stopped) return false;
      if (answer == Answer::conflict) {
        core = trial;
        return true;
      }
      if (!grow(complements)) return false;
    }
    return !deadline_.reached();
  }

  // From what the last labelling meets to a set to which nothing can be added; what is left of the items is a
  // complement that every conflicting set hits.
  bool grow(std::vector<Items>& complements) {
    std::vector<bool> met(items_.size(), false);
    const auto add_met = [&] {
      for (std::size_t k = 0; k < items_.size(); ++k) met[k] = met[k] || meets(items_[k]);
    };
    add_met();
    for (std::size_t k = 0; k < items_.size(); ++k) {
      if (met[k]) continue;
      Items trial;
      for (std::size_t other = 0; other < items_.size(); ++other)
        if (met[other] || other == k) trial.push_back(other);
      const Answer answer = ask(trial, nullptr);
      if (answer == Answer::stopped) return false;
      if (answer == Answer::met) add_met();
    }
    Items left;
    for (std::size_t k = 0; k < items_.size(); ++k)
      if (!met[k]) left.push_back(k);
    complements.push_back(std::move(left));
    return true;
  }

  bool meets(const Item& item) const {
    if (item.constraint == no_candidate)
      return !excluded(problem_, item.first, values_[item.first], item.second, values_[item.second]);
    const LabelingConstraint& constraint = problem_.constraints[item.constraint];
    return allowed_apart(problem_, constraint, table_entry(problem_, constraint, values_));
  }

  const LabelingProblem& problem_;
  const ConflictQuestion& question_;
  Deadline& deadline_;
  CrispPart part_;
  std::vector<Item> items_;
  std::vector<Index> values_;
};

}  // namespace

ConflictSet smallest_conflict(const LabelingProblem& problem, const ConflictQuestion& question, Deadline& deadline) {
  if (problem.variables.empty()) return {ConflictSet::Status::none};
  return Finder(problem, question, deadline).find();
}

std::string in_words(const LabelingProblem& problem, const ConflictSet& set) {
  std::vector<std::string> names;
  for (const Index c : set.constraints) names.push_back("'" + problem.constraints[c].name + "'");
  for (const auto& [first, second] : set.exclusions)
    names.push_back("the exclusion of '" + problem.variables[first].name + "' and '" + problem.variables[second].name +
                    "'");
  return names.empty() ? "none is needed: a domain has no value of finite cost" : list_of(names);
}

void add_conflict_fact(const LabelingProblem& problem, const ConflictQuestion& question, const LabelingRequest& request,
                       const Deadline& so_far, const Context& context, LabelingOutcome& outcome) {
  Deadline deadline(std::min(request.time_limit_s / 10, request.time_limit_s - so_far.elapsed_s()), context);
  const ConflictSet set = smallest_conflict(problem, question, deadline);
  if (!set.conflicts()) return;
  const char* name = set.status == ConflictSet::Status::smallest  ? "smallest conflicting set"
                     : set.status == ConflictSet::Status::minimal ? "minimal conflicting set"
                                                                  : "conflicting set";
  outcome.facts.push_back({name, in_words(problem, set)});
}

}  // namespace toposcope
