// SPDX-License-Identifier: BSD-3-Clause
#include "removed_values.h"

#include <algorithm>
#include <string>

#include "words.h"

namespace toposcope {
namespace {

class Reasons {
 public:
  explicit Reasons(const Propagation& domains)
      : domains_(domains), network_(domains.network()), problem_(network_.problem()) {}

  std::vector<RemovedValue> all() const {
    std::vector<RemovedValue> removed;
    for (Index v = 0; v < network_.variables(); ++v)
      for (Index value = 0; value < network_.domain(v); ++value)
        if (domains_.struck_at(v, value) == Propagation::closed) {
          const std::string reason = network_.closed_reason(v, value);
          if (!problem_.variables[v].missing(value) || !(problem_.variables[v].costs[value] < forbidden))
            removed.push_back({v, value, reason});
        }
    for (std::uint32_t at = 0; at < domains_.trail().size(); ++at) {
      const Strike& strike = domains_.trail()[at];
      removed.push_back({strike.variable, strike.value,
                         strike.cause.kind == StrikeCause::Kind::pair ? of_pair(strike, at) : of_table(strike)});
    }
    return removed;
  }

 private:
  // The members of the pair that deny all that was left at the other end: one alone where one suffices.
  std::string of_pair(const Strike& strike, std::uint32_t at) const {
    const CrispPair& pair = network_.pairs()[strike.cause.at];
    const Index other = pair.other(strike.variable);
    std::vector<Index> left;
    for (Index value = 0; value < network_.domain(other); ++value) {
      const std::uint32_t struck = domains_.struck_at(other, value);
      if (struck != Propagation::closed && struck >= at) left.push_back(value);
    }
    std::vector<std::string> members;
    const auto told = [&](std::size_t denied, const std::string& name) {
      if (denied > 0) members.push_back(name);
      return denied == left.size();
    };
    for (const Index c : pair.constraints) {
      const LabelingConstraint& constraint = problem_.constraints[c];
      const auto denied = std::count_if(left.begin(), left.end(), [&](Index value) {
        const Index first = constraint.scope[0] == other ? value : strike.value;
        const Index second = constraint.scope[0] == other ? strike.value : value;
        const std::size_t entry = first * network_.domain(constraint.scope[1]) + second;
        return !allowed_apart(problem_, constraint, entry);
      });
      if (told(static_cast<std::size_t>(denied), "'" + constraint.name + "'"))
        return sentence(other, left.size(), "meets '" + constraint.name + "' with it");
    }
    const auto denied = std::count_if(left.begin(), left.end(), [&](Index value) {
      return excluded(problem_, strike.variable, strike.value, other, value);
    });
    if (pair.exclusion && told(static_cast<std::size_t>(denied), "the exclusion"))
      return sentence(other, left.size(), "can stand beside it: all share a vertex with it");
    return sentence(other, left.size(), "meets " + list_of(members) + " with it");
  }

  std::string sentence(Index other, std::size_t left, const std::string& rest) const {
    const bool all = left == network_.domain(other) - (problem_.variables[other].optional ? 1 : 0);
    return std::string("no value ") + (all ? "" : "left ") + "of '" + problem_.variables[other].name + "' " + rest;
  }

  std::string of_table(const Strike& strike) const {
    const LabelingConstraint& constraint = problem_.constraints[network_.tables()[strike.cause.at].constraint];
    std::vector<std::string> others;
    for (const Index v : constraint.scope)
      if (v != strike.variable) others.push_back("'" + problem_.variables[v].name + "'");
    return "no values left of " + list_of(others) + " meet '" + constraint.name + "' with it";
  }

  const Propagation& domains_;
  const CompiledNetwork& network_;
  const LabelingProblem& problem_;
};

}  // namespace

std::vector<RemovedValue> removed_values(const Propagation& domains) {
  return Reasons(domains).all();
}

}  // namespace toposcope
