// SPDX-License-Identifier: BSD-3-Clause
#include "crisp_propagation.h"

#include <algorithm>
#include <bit>

namespace toposcope {
namespace {

constexpr std::uint64_t no_support = ~std::uint64_t{0};

}  // namespace

Propagation::Propagation(const CompiledNetwork& network, Deadline& deadline)
    : network_(network),
      deadline_(deadline),
      words_(network.initial()),
      sizes_(network.variables(), 0),
      assigned_(network.variables(), 0),
      struck_at_(network.values(), closed),
      residues_(network.residues(), 0),
      queued_(network.variables(), 0),
      table_queued_(network.tables().size(), 0),
      marked_(network.values(), 0),
      pairs_used_(network.pairs().size(), false),
      tables_used_(network.tables().size(), false) {
  for (Index v = 0; v < network.variables(); ++v)
    for_each_value(domain(v), [&](Index value) {
      ++sizes_[v];
      struck_at_[network.offset(v) + value] = present;
    });
  std::size_t arity = 0;
  for (const CrispTable& table : network.tables()) {
    arity = std::max(arity, table.scope.size());
    std::size_t values = 0;
    for (const Index v : table.scope) values += network.domain(v);
    std::fill_n(residues_.begin() + static_cast<std::ptrdiff_t>(table.residues), values, no_support);
  }
  lists_.resize(arity);
  digits_.resize(arity);
  trail_.reserve(network.values());
}

bool Propagation::open() const {
  return std::find(sizes_.begin(), sizes_.end(), Index{0}) == sizes_.end();
}

bool Propagation::strike(Index variable, Index value, StrikeCause cause) {
  words_[network_.word_offset(variable) + value / 64] &= ~(std::uint64_t{1} << (value % 64));
  struck_at_[network_.offset(variable) + value] = static_cast<std::uint32_t>(trail_.size());
  trail_.push_back({variable, value, cause});
  if (cause.kind == StrikeCause::Kind::pair) pairs_used_[cause.at] = true;
  if (cause.kind == StrikeCause::Kind::table) tables_used_[cause.at] = true;
  return --sizes_[variable] > 0;
}

bool Propagation::fail(Index variable, StrikeCause cause) {
  failed_ = variable;
  failure_ = cause;
  clear_queues();
  return false;
}

void Propagation::assign(Index variable, Index value) {
  assigned_[variable] = 1;
  order_.push_back(variable);
  for_each_value(domain(variable), [&](Index other) {
    if (other != value) strike(variable, other, {StrikeCause::Kind::decision, 0});
  });
  enqueue(variable);
}

void Propagation::undo(const Mark& mark) {
  for (; trail_.size() > mark.trail; trail_.pop_back()) {
    const Strike& last = trail_.back();
    words_[network_.word_offset(last.variable) + last.value / 64] |= std::uint64_t{1} << (last.value % 64);
    struck_at_[network_.offset(last.variable) + last.value] = present;
    ++sizes_[last.variable];
  }
  for (; order_.size() > mark.assigned; order_.pop_back()) assigned_[order_.back()] = 0;
  clear_queues();
}

bool Propagation::check_forward(Index variable) {
  clear_queues();
  Index value = 0;
  for_each_value(domain(variable), [&](Index only) { value = only; });
  for (const CrispArc& arc : network_.arcs(variable)) {
    if (assigned(arc.other)) continue;
    const std::uint64_t* row = network_.bits(arc.rows + value * network_.words(arc.other));
    const StrikeCause cause{StrikeCause::Kind::pair, arc.pair};
    for (std::size_t w = 0; w < network_.words(arc.other); ++w)
      for (std::uint64_t lost = words_[network_.word_offset(arc.other) + w] & ~row[w]; lost != 0; lost &= lost - 1)
        strike(arc.other, static_cast<Index>(w * 64) + static_cast<Index>(std::countr_zero(lost)), cause);
    if (size(arc.other) == 0) return fail(arc.other, cause);
  }
  for (const Index t : network_.tables_of(variable)) {
    const std::vector<Index>& scope = network_.tables()[t].scope;
    Index last = no_candidate;
    std::size_t left = 0;
    for (const Index v : scope)
      if (!assigned(v)) {
        last = v;
        ++left;
      }
    if (left == 1 && !revise_table(t, last)) return false;
  }
  return true;
}

bool Propagation::limit_missing(Index limit) {
  const std::vector<LabelingVariable>& variables = network_.problem().variables;
  Index forced = 0;
  for (Index v = 0; v < variables.size(); ++v) forced += variables[v].optional && sizes_[v] == 1 && contains(v, 0);
  const StrikeCause cause{StrikeCause::Kind::budget, 0};
  if (forced > limit) return fail(no_candidate, cause);
  if (forced < limit) return true;
  for (Index v = 0; v < variables.size(); ++v)
    if (variables[v].optional && sizes_[v] > 1 && contains(v, 0)) {
      strike(v, 0, cause);
      enqueue(v);
    }
  return true;
}

void Propagation::enqueue(Index variable) {
  if (queued_[variable] != 0) return;
  queued_[variable] = 1;
  queue_.push_back(variable);
}

void Propagation::clear_queues() {
  for (const Index v : queue_) queued_[v] = 0;
  for (const Index t : table_queue_) table_queued_[t] = 0;
  queue_.clear();
  table_queue_.clear();
}

bool Propagation::relax() {
  if (!relaxed_once_) {
    relaxed_once_ = true;
    for (Index v = 0; v < network_.variables(); ++v) {
      if (size(v) == 0) return fail(v, {});
      enqueue(v);
    }
  }
  // Pairs first, they are cheap; each list is worked off from the front, so that nothing waits for ever.
  std::size_t next = 0, next_table = 0;
  while (next < queue_.size() || next_table < table_queue_.size()) {
    if (next < queue_.size()) {
      const Index v = queue_[next++];
      queued_[v] = 0;
      for (const CrispArc& arc : network_.arcs(v))
        if (!assigned(arc.other) && !revise(arc)) return false;
      for (const Index t : network_.tables_of(v)) {
        if (table_queued_[t] != 0) continue;
        table_queued_[t] = 1;
        table_queue_.push_back(t);
      }
    } else {
      const Index t = table_queue_[next_table++];
      table_queued_[t] = 0;
      if (!revise_table(t, no_candidate)) return false;
      if (deadline_.reached()) break;
    }
    if ((++polls_ & 15U) == 0 && deadline_.reached()) break;
    if (next == queue_.size()) {
      queue_.clear();
      next = 0;
    }
    if (next_table == table_queue_.size()) {
      table_queue_.clear();
      next_table = 0;
    }
  }
  clear_queues();
  return true;
}

// Strikes the values at the far end of an arc that have no support at this end.
bool Propagation::revise(const CrispArc& arc) {
  const Index y = arc.other;
  const Index x = network_.pairs()[arc.pair].other(y);
  const std::size_t words = network_.words(x);
  const std::uint64_t* supports = words_.data() + network_.word_offset(x);
  const StrikeCause cause{StrikeCause::Kind::pair, arc.pair};
  bool lost = false;
  for_each_value(domain(y), [&](Index value) {
    const std::uint64_t* row = network_.bits(arc.back + value * words);
    std::uint64_t& residue = residues_[arc.back_residues + value];
    if ((row[residue] & supports[residue]) != 0) return;
    for (std::size_t w = 0; w < words; ++w)
      if ((row[w] & supports[w]) != 0) {
        residue = w;
        return;
      }
    strike(y, value, cause);
    lost = true;
  });
  if (size(y) == 0) return fail(y, cause);
  if (lost) enqueue(y);
  return true;
}

// The same for all variables of a table that are not assigned, or for one.
bool Propagation::revise_table(Index t, Index only) {
  const CrispTable& table = network_.tables()[t];
  for (std::size_t k = 0; k < table.scope.size(); ++k) {
    lists_[k].clear();
    for_each_value(domain(table.scope[k]), [&](Index value) { lists_[k].push_back(value); });
  }
  const StrikeCause cause{StrikeCause::Kind::table, t};
  std::size_t residue = table.residues;
  for (std::size_t k = 0; k < table.scope.size(); residue += network_.domain(table.scope[k]), ++k) {
    const Index v = table.scope[k];
    if (only == no_candidate ? assigned(v) : v != only) continue;
    bool lost = false;
    for (const Index value : lists_[k]) {
      if (supported(table, k, value, residue + value)) continue;
      strike(v, value, cause);
      lost = true;
    }
    if (size(v) == 0) return fail(v, cause);
    if (!lost) continue;
    lists_[k].clear();
    for_each_value(domain(v), [&](Index value) { lists_[k].push_back(value); });
    if (only == no_candidate) enqueue(v);
  }
  return true;
}

bool Propagation::supported(const CrispTable& table, std::size_t position, Index value, std::size_t residue) {
  std::uint64_t entry = residues_[residue];
  if (entry != no_support) {
    bool valid = true;
    for (std::size_t k = table.scope.size(); k-- > 0 && valid;) {
      const Index width = network_.domain(table.scope[k]);
      valid = contains(table.scope[k], static_cast<Index>(entry % width));
      entry /= width;
    }
    if (valid) return true;
  }
  return seek(table, position, value, residue);
}

bool Propagation::seek(const CrispTable& table, std::size_t position, Index value, std::size_t residue) {
  const std::size_t last = table.scope.size() - 1;
  const Index y = table.scope[last];
  const std::size_t words = network_.words(y);
  std::fill_n(digits_.begin(), last, 0);
  for (bool more = true; more;) {
    std::size_t prefix = 0;
    for (std::size_t k = 0; k < last; ++k) prefix += table.strides[k] * (k == position ? value : lists_[k][digits_[k]]);
    const std::uint64_t* row = network_.bits(table.rows + prefix * words);
    for (std::size_t w = 0; w < words; ++w) {
      std::uint64_t found = row[w] & words_[network_.word_offset(y) + w];
      if (position == last) found &= w == value / 64 ? std::uint64_t{1} << (value % 64) : 0;
      if (found == 0) continue;
      residues_[residue] = prefix * network_.domain(y) + w * 64 + static_cast<std::size_t>(std::countr_zero(found));
      return true;
    }
    more = false;
    for (std::size_t k = last; k-- > 0 && !more;) {
      if (k == position) continue;
      more = ++digits_[k] < lists_[k].size();
      if (!more) digits_[k] = 0;
    }
  }
  return false;
}

}  // namespace toposcope
