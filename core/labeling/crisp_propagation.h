// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Domains that shrink: forward checking and generalised arc consistency over a CompiledNetwork, with a trail for
// backtracking and a cause for every value struck.

#include <cstdint>
#include <span>
#include <vector>

#include "crisp_network.h"

namespace toposcope {

/// What struck a value.
struct StrikeCause {
  enum class Kind : std::uint8_t { decision, pair, table, budget };
  Kind kind = Kind::decision;
  Index at = 0;  ///< of the pair or table
};

struct Strike {
  Index variable = 0, value = 0;
  StrikeCause cause;
};

/// A set of variables, as bits.
using VariableSet = std::vector<std::uint64_t>;

/// Arc consistency: bitwise revision with residues ([Lecoutre2008], AC3bit+rm), which for tables over three and
/// more variables seeks a support in the rows of the table. Its fixpoint does not depend on any order.
class Propagation {
 public:
  Propagation(const CompiledNetwork& network, Deadline& deadline);

  const CompiledNetwork& network() const { return network_; }
  CrispDomains domains() const { return {words_.data(), network_.word_offsets(), sizes_.data(), assigned_.data()}; }
  std::span<const std::uint64_t> domain(Index variable) const {
    return {words_.data() + network_.word_offset(variable), network_.words(variable)};
  }
  bool contains(Index variable, Index value) const {
    return (words_[network_.word_offset(variable) + value / 64] >> (value % 64)) & 1U;
  }
  Index size(Index variable) const { return sizes_[variable]; }
  bool assigned(Index variable) const { return assigned_[variable] != 0; }
  const std::vector<Strike>& trail() const { return trail_; }

  /// True where no domain is empty.
  bool open() const;
  /// Leaves the variable one value of its domain, as a decision.
  void assign(Index variable, Index value);
  /// Strikes what the assigned variable and those before it forbid the others. \return false where a domain is empty
  bool check_forward(Index variable);
  /// Makes the domains arc consistent after what was struck since the last call; the first call: all constraints.
  /// Stopped by the deadline the domains are left too large. \return false where a domain is empty
  bool relax();
  /// At most so many variables missing: strikes *missing* where the limit is reached. \return false where it is passed
  bool limit_missing(Index limit);

  /// What was struck until now is struck for good, and belongs to no decision.
  void set_root() { root_ = trail_.size(); }
  struct Mark {
    std::size_t trail, assigned;
  };
  Mark mark() const { return {trail_.size(), order_.size()}; }
  void undo(const Mark& mark);

  /// Adds the decisions that made the last call fail.
  void explain_failure(VariableSet& decisions);
  /// Adds the decisions for which values of the variable are struck.
  void explain_strikes(Index variable, VariableSet& decisions);

  /// The last failure's pair or table.
  StrikeCause failure() const { return failure_; }
  /// Pairs and tables that ever struck a value.
  const std::vector<bool>& pairs_used() const { return pairs_used_; }
  const std::vector<bool>& tables_used() const { return tables_used_; }
  /// Position in the trail at which a value was struck; beyond the trail where it is in its domain; `closed` where it
  /// never was.
  static constexpr std::uint32_t closed = 0xfffffffe, present = 0xffffffff;
  std::uint32_t struck_at(Index variable, Index value) const { return struck_at_[network_.offset(variable) + value]; }

 private:
  bool strike(Index variable, Index value, StrikeCause cause);
  bool revise(const CrispArc& from);
  bool revise_table(Index table, Index only);
  bool supported(const CrispTable& table, std::size_t position, Index value, std::size_t residue);
  bool seek(const CrispTable& table, std::size_t position, Index value, std::size_t residue);
  bool fail(Index variable, StrikeCause cause);
  void enqueue(Index variable);
  void clear_queues();
  void mark_value(Index variable, Index value, std::uint32_t before);
  void mark_struck(Index variable, std::uint32_t before);
  void mark_forced_missing(std::uint32_t before);
  void trace_marks(VariableSet& decisions);

  const CompiledNetwork& network_;
  Deadline& deadline_;
  std::vector<std::uint64_t> words_;
  std::vector<Index> sizes_;
  std::vector<char> assigned_;
  std::vector<Index> order_;  ///< assigned variables, in order
  std::vector<Strike> trail_;
  std::vector<std::uint32_t> struck_at_;
  std::size_t root_ = 0;

  std::vector<std::uint64_t> residues_;  ///< per arc and value a word index; per table and value an entry
  std::vector<Index> queue_;             ///< variables whose domains shrank
  std::vector<char> queued_, table_queued_;
  std::vector<Index> table_queue_;
  bool relaxed_once_ = false;
  std::uint32_t polls_ = 0;
  std::vector<std::vector<Index>> lists_;  ///< scratch: the scope's domains as lists
  std::vector<std::size_t> digits_;

  Index failed_ = 0;
  StrikeCause failure_;
  std::vector<char> marked_;
  std::size_t marks_ = 0;
  std::vector<bool> pairs_used_, tables_used_;
};

}  // namespace toposcope
