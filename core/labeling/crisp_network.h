// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The crisp form of a labelling problem, compiled for propagation and search: what may stand together, as bits.

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "toposcope/labeling.h"
#include "toposcope/labeling/crisp_search.h"
#include "toposcope/labeling/tools.h"

namespace toposcope {

/// A part of a crisp problem: which constraints and exclusions are in force, which values are open. Empty: all.
struct CrispPart {
  std::vector<bool> constraints = {};
  std::vector<bool> exclusions = {};         ///< by exclusion_index
  std::vector<std::vector<bool>> open = {};  ///< per variable, per value
  std::vector<bool> present = {};            ///< per variable: may not be missing
  bool exclusions_apart = false;             ///< constraints allow what an exclusion forbids (see `allowed_apart`)
};

/// As `allowed`, but an entry whose candidates exclude each other is left to their exclusion: tables of meshes forbid
/// it as well, and the constraint is not to be blamed for that.
bool allowed_apart(const LabelingProblem& problem, const LabelingConstraint& constraint, std::size_t entry);

/// Position of a pair of variables, first < second, among all pairs of n variables.
inline std::size_t exclusion_index(std::size_t n, Index first, Index second) {
  return first * (2 * n - first - 1) / 2 + (second - first - 1);
}

/// All that binds two variables: their binary constraints and their exclusions, met together.
struct CrispPair {
  Index first = 0, second = 0;  ///< first < second
  std::vector<Index> constraints = {};
  bool exclusion = false;
  std::size_t from_first = 0, from_second = 0;  ///< offsets in `bits`: per value of the one the allowed of the other
  Index other(Index variable) const { return variable == first ? second : first; }
  std::size_t rows(Index variable) const { return variable == first ? from_first : from_second; }
};

/// One direction of a pair, as its variable sees it.
struct CrispArc {
  Index pair = 0;
  Index other = 0;           ///< the variable at the other end
  std::size_t rows = 0;      ///< offset in `bits`: per value of this variable the values allowed at the other end
  std::size_t back = 0;      ///< the same, seen from the other end
  std::size_t residues = 0;  ///< offset of this variable's values in an array with one entry per value and arc
  std::size_t back_residues = 0;
};

/// A constraint over three or more variables.
struct CrispTable {
  Index constraint = 0;
  std::vector<Index> scope = {};
  std::vector<std::size_t> strides = {};  ///< of a prefix (all variables of the scope but the last), 0 for the last
  std::size_t rows = 0;                   ///< offset in `bits`: per prefix the allowed values of the last variable
  std::size_t residues = 0;               ///< offset of the first variable's values; one entry per value and variable
};

/// A consistent labelling (`consistent` of toposcope/labeling/tools.h) is one whose values are all open, whose pairs
/// and tables all allow it. Refers to the problem, which must outlive it.
class CompiledNetwork {
 public:
  /// Stops early, and `complete()` is false, when the deadline is reached.
  CompiledNetwork(const LabelingProblem& problem, Deadline& deadline, const CrispPart& part = {});

  const LabelingProblem& problem() const { return *problem_; }
  bool complete() const { return complete_; }
  /// False where a constraint's violations forbid what its costs do not: then consistent labellings are fewer than
  /// those of finite cost.
  bool by_cost_alone() const { return by_cost_alone_; }

  Index variables() const { return static_cast<Index>(offsets_.size() - 1); }
  Index domain(Index variable) const { return offsets_[variable + 1] - offsets_[variable]; }
  /// Position of a variable's first value among all values of all variables.
  Index offset(Index variable) const { return offsets_[variable]; }
  const Index* offsets() const { return offsets_.data(); }
  Index values() const { return offsets_.back(); }
  /// Words that a set of the variable's values takes, and where they stand among those of all variables.
  std::size_t words(Index variable) const { return word_offsets_[variable + 1] - word_offsets_[variable]; }
  std::size_t word_offset(Index variable) const { return word_offsets_[variable]; }
  const std::size_t* word_offsets() const { return word_offsets_.data(); }

  /// Per variable, at `word_offset`: the values of finite cost that the unary constraints allow.
  const std::vector<std::uint64_t>& initial() const { return initial_; }
  /// Why a value is not in `initial`.
  std::string closed_reason(Index variable, Index value) const;

  const std::vector<CrispPair>& pairs() const { return pairs_; }
  const std::vector<CrispTable>& tables() const { return tables_; }
  std::span<const CrispArc> arcs(Index variable) const { return arcs_[variable]; }
  std::span<const Index> tables_of(Index variable) const { return tables_of_[variable]; }
  const std::uint64_t* bits(std::size_t offset) const { return bits_.data() + offset; }
  std::size_t residues() const { return residues_; }

 private:
  void close_values(const CrispPart& part);
  void add_constraints(const CrispPart& part, Deadline& deadline);
  void add_exclusions(const CrispPart& part, Deadline& deadline);
  void add_unary(Index constraint);
  void add_binary(Index constraint, Deadline& deadline);
  void add_table(Index constraint, Deadline& deadline);
  bool allows(const LabelingConstraint& constraint, std::size_t entry);
  Index pair_of(Index a, Index b);
  void connect();
  bool stop(Deadline& deadline, std::size_t work);

  const LabelingProblem* problem_;
  bool complete_ = true, by_cost_alone_ = true, exclusions_apart_;
  std::vector<Index> offsets_;
  std::vector<std::size_t> word_offsets_;
  std::vector<std::uint64_t> initial_, bits_;
  std::vector<CrispPair> pairs_;
  std::map<std::pair<Index, Index>, Index> pair_index_;
  std::vector<CrispTable> tables_;
  std::vector<std::vector<CrispArc>> arcs_;
  std::vector<std::vector<Index>> tables_of_;
  std::vector<bool> unary_in_force_;
  std::vector<std::vector<bool>> open_;
  std::vector<bool> present_;
  std::size_t residues_ = 0, work_ = 0;
};

}  // namespace toposcope
