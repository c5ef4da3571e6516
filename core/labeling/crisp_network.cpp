// SPDX-License-Identifier: BSD-3-Clause
#include "crisp_network.h"

#include <algorithm>

namespace toposcope {
namespace {

constexpr std::size_t poll_work = 4096;  ///< table entries between two looks at the clock

bool in_force(const std::vector<bool>& part, std::size_t item) {
  return part.empty() || part[item];
}

void set_bit(std::uint64_t* words, Index bit) {
  words[bit / 64] |= std::uint64_t{1} << (bit % 64);
}

void clear_bit(std::uint64_t* words, Index bit) {
  words[bit / 64] &= ~(std::uint64_t{1} << (bit % 64));
}

}  // namespace

bool allowed_apart(const LabelingProblem& problem, const LabelingConstraint& constraint, std::size_t entry) {
  if (allowed(constraint, entry)) return true;
  const std::vector<Index>& scope = constraint.scope;
  std::size_t rest = entry;
  for (std::size_t k = scope.size(); k-- > 0;) {
    const auto value = static_cast<Index>(rest % problem.variables[scope[k]].domain());
    rest /= problem.variables[scope[k]].domain();
    std::size_t others = rest;
    for (std::size_t j = k; j-- > 0;) {
      const Index domain = problem.variables[scope[j]].domain();
      if (excluded(problem, scope[k], value, scope[j], static_cast<Index>(others % domain))) return true;
      others /= domain;
    }
  }
  return false;
}

CompiledNetwork::CompiledNetwork(const LabelingProblem& problem, Deadline& deadline, const CrispPart& part)
    : problem_(&problem),
      exclusions_apart_(part.exclusions_apart),
      arcs_(problem.variables.size()),
      tables_of_(problem.variables.size()),
      unary_in_force_(problem.constraints.size(), false),
      open_(part.open),
      present_(part.present) {
  offsets_.push_back(0);
  word_offsets_.push_back(0);
  for (const LabelingVariable& variable : problem.variables) {
    offsets_.push_back(offsets_.back() + variable.domain());
    word_offsets_.push_back(word_offsets_.back() + (variable.domain() + 63) / 64);
  }
  initial_.assign(word_offsets_.back(), 0);
  for (Index v = 0; v < variables(); ++v)
    for (Index value = 0; value < domain(v); ++value) {
      const LabelingVariable& variable = problem.variables[v];
      const bool wanted =
          (open_.empty() || open_[v][value]) && !(!present_.empty() && present_[v] && variable.missing(value));
      if (wanted && variable.costs[value] < forbidden) set_bit(initial_.data() + word_offsets_[v], value);
    }
  for (Index c = 0; c < problem.constraints.size() && complete_; ++c) {
    if (!in_force(part.constraints, c)) continue;
    const std::size_t arity = problem.constraints[c].scope.size();
    if (arity == 1) add_unary(c);
    if (arity == 2) add_binary(c, deadline);
    if (arity > 2) add_table(c, deadline);
  }
  if (complete_) add_exclusions(part, deadline);
  connect();
}

bool CompiledNetwork::stop(Deadline& deadline, std::size_t work) {
  work_ += work;
  if (work_ >= poll_work) {
    work_ = 0;
    if (deadline.reached()) complete_ = false;
  }
  return !complete_;
}

bool CompiledNetwork::allows(const LabelingConstraint& constraint, std::size_t entry) {
  const bool finite = constraint.costs[entry] < forbidden;
  const bool met = satisfied(constraint, entry);
  by_cost_alone_ &= met || !finite;
  return (finite && met) || (exclusions_apart_ && allowed_apart(*problem_, constraint, entry));
}

void CompiledNetwork::add_unary(Index c) {
  const LabelingConstraint& constraint = problem_->constraints[c];
  const Index v = constraint.scope[0];
  unary_in_force_[c] = true;
  for (Index value = 0; value < domain(v); ++value)
    if (!allows(constraint, value)) clear_bit(initial_.data() + word_offsets_[v], value);
}

Index CompiledNetwork::pair_of(Index a, Index b) {
  const auto key = std::minmax(a, b);
  const auto [at, is_new] = pair_index_.try_emplace({key.first, key.second}, static_cast<Index>(pairs_.size()));
  if (!is_new) return at->second;
  CrispPair& pair = pairs_.emplace_back();
  pair.first = key.first;
  pair.second = key.second;
  pair.from_first = bits_.size();
  pair.from_second = pair.from_first + domain(pair.first) * words(pair.second);
  bits_.resize(pair.from_second + domain(pair.second) * words(pair.first), 0);
  const auto fill = [&](std::size_t rows, Index from, Index to) {
    for (Index value = 0; value < domain(from); ++value)
      for (std::size_t w = 0; w < words(to); ++w, ++rows)
        bits_[rows] =
            w + 1 < words(to) || domain(to) % 64 == 0 ? ~std::uint64_t{0} : (std::uint64_t{1} << (domain(to) % 64)) - 1;
  };
  fill(pair.from_first, pair.first, pair.second);
  fill(pair.from_second, pair.second, pair.first);
  return at->second;
}

void CompiledNetwork::add_binary(Index c, Deadline& deadline) {
  const LabelingConstraint& constraint = problem_->constraints[c];
  const Index x = constraint.scope[0], y = constraint.scope[1];
  const Index at = pair_of(x, y);
  pairs_[at].constraints.push_back(c);
  std::uint64_t* from_x = bits_.data() + pairs_[at].rows(x);
  std::uint64_t* from_y = bits_.data() + pairs_[at].rows(y);
  std::size_t entry = 0;
  for (Index a = 0; a < domain(x); ++a) {
    for (Index b = 0; b < domain(y); ++b, ++entry) {
      if (allows(constraint, entry)) continue;
      clear_bit(from_x + a * words(y), b);
      clear_bit(from_y + b * words(x), a);
    }
    if (stop(deadline, domain(y))) return;
  }
}

void CompiledNetwork::add_exclusions(const CrispPart& part, Deadline& deadline) {
  const std::size_t n = problem_->variables.size();
  struct Use {
    Index variable, value;
  };
  std::vector<std::vector<Use>> uses(problem_->candidate_count);  // of each candidate
  for (Index v = 0; v < n; ++v)
    for (Index value = 0; value < domain(v); ++value) {
      const Index candidate = problem_->variables[v].candidate(value);
      if (candidate != no_candidate) uses[candidate].push_back({v, value});
    }
  for (Index x = 0; x < n; ++x)
    for (Index a = 0; a < domain(x); ++a) {
      const Index candidate = problem_->variables[x].candidate(a);
      if (candidate == no_candidate) continue;
      const std::size_t row = problem_->conflict_words();
      std::size_t work = row;
      for_each_value({problem_->conflict_bits.data() + candidate * row, row}, [&](Index rival) {
        for (const Use& use : uses[rival]) {
          const Index y = use.variable;
          ++work;
          if (y <= x || !in_force(part.exclusions, part.exclusions.empty() ? 0 : exclusion_index(n, x, y))) continue;
          const Index at = pair_of(x, y);
          pairs_[at].exclusion = true;
          clear_bit(bits_.data() + pairs_[at].from_first + a * words(y), use.value);
          clear_bit(bits_.data() + pairs_[at].from_second + use.value * words(x), a);
        }
      });
      if (stop(deadline, work)) return;
    }
}

void CompiledNetwork::add_table(Index c, Deadline& deadline) {
  const LabelingConstraint& constraint = problem_->constraints[c];
  CrispTable& table = tables_.emplace_back();
  table.constraint = c;
  table.scope = constraint.scope;
  table.strides.assign(table.scope.size(), 0);
  std::size_t prefixes = 1;
  for (std::size_t k = table.scope.size() - 1; k-- > 0;) {
    table.strides[k] = prefixes;
    prefixes *= domain(table.scope[k]);
  }
  const Index last = table.scope.back();
  table.rows = bits_.size();
  bits_.resize(table.rows + prefixes * words(last), 0);
  std::size_t entry = 0;
  for (std::size_t prefix = 0; prefix < prefixes; ++prefix) {
    std::uint64_t* row = bits_.data() + table.rows + prefix * words(last);
    for (Index value = 0; value < domain(last); ++value, ++entry)
      if (allows(constraint, entry)) set_bit(row, value);
    if (stop(deadline, domain(last))) return;
  }
}

void CompiledNetwork::connect() {
  for (Index p = 0; p < pairs_.size(); ++p) {
    const CrispPair& pair = pairs_[p];
    const std::size_t first = residues_, second = first + domain(pair.first);
    arcs_[pair.first].push_back({p, pair.second, pair.from_first, pair.from_second, first, second});
    arcs_[pair.second].push_back({p, pair.first, pair.from_second, pair.from_first, second, first});
    residues_ = second + domain(pair.second);
  }
  for (Index t = 0; t < tables_.size(); ++t) {
    tables_[t].residues = residues_;
    for (const Index v : tables_[t].scope) {
      tables_of_[v].push_back(t);
      residues_ += domain(v);
    }
  }
}

std::string CompiledNetwork::closed_reason(Index variable, Index value) const {
  const LabelingVariable& v = problem_->variables[variable];
  if (!(v.costs[value] < forbidden)) return "its cost is infinite";
  if (!present_.empty() && present_[variable] && v.missing(value)) return "it may not be missing";
  if (!open_.empty() && !open_[variable][value]) return "it is not open";
  for (Index c = 0; c < unary_in_force_.size(); ++c) {
    const LabelingConstraint& constraint = problem_->constraints[c];
    if (unary_in_force_[c] && constraint.scope[0] == variable && !allowed(constraint, value))
      return "'" + constraint.name + "' forbids it";
  }
  return "";
}

}  // namespace toposcope
