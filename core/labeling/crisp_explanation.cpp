// SPDX-License-Identifier: BSD-3-Clause
// Which decisions struck a value: the trail is read backwards, from each strike to the strikes that it followed from.

#include "crisp_propagation.h"

namespace toposcope {

void Propagation::mark_value(Index variable, Index value, std::uint32_t before) {
  const std::uint32_t at = struck_at(variable, value);
  char& marked = marked_[network_.offset(variable) + value];
  if (at >= before || at == closed || at < root_ || marked != 0) return;
  marked = 1;
  ++marks_;
}

void Propagation::mark_struck(Index variable, std::uint32_t before) {
  for (Index value = 0; value < network_.domain(variable); ++value) mark_value(variable, value, before);
}

void Propagation::mark_forced_missing(std::uint32_t before) {
  const std::vector<LabelingVariable>& variables = network_.problem().variables;
  for (Index v = 0; v < variables.size(); ++v) {
    bool forced = variables[v].optional;
    for (Index value = 1; value < network_.domain(v) && forced; ++value) {
      const std::uint32_t at = struck_at(v, value);
      forced = at < before || at == closed;
    }
    if (!forced) continue;
    for (Index value = 1; value < network_.domain(v); ++value) mark_value(v, value, before);
  }
}

void Propagation::explain_failure(VariableSet& decisions) {
  if (failure_.kind == StrikeCause::Kind::budget)
    mark_forced_missing(present);
  else
    mark_struck(failed_, present);
  trace_marks(decisions);
}

void Propagation::explain_strikes(Index variable, VariableSet& decisions) {
  mark_struck(variable, present);
  trace_marks(decisions);
}

void Propagation::trace_marks(VariableSet& decisions) {
  for (std::size_t at = trail_.size(); marks_ > 0 && at-- > root_;) {
    const Strike& strike = trail_[at];
    char& marked = marked_[network_.offset(strike.variable) + strike.value];
    if (marked == 0) continue;
    marked = 0;
    --marks_;
    const auto before = static_cast<std::uint32_t>(at);
    switch (strike.cause.kind) {
      case StrikeCause::Kind::decision:
        decisions[strike.variable / 64] |= std::uint64_t{1} << (strike.variable % 64);
        break;
      case StrikeCause::Kind::pair: {
        const CrispPair& pair = network_.pairs()[strike.cause.at];
        const Index other = pair.other(strike.variable);
        const std::size_t words = network_.words(other);
        for_each_value({network_.bits(pair.rows(strike.variable) + strike.value * words), words},
                       [&](Index support) { mark_value(other, support, before); });
        break;
      }
      case StrikeCause::Kind::table:
        for (const Index v : network_.tables()[strike.cause.at].scope)
          if (v != strike.variable) mark_struck(v, before);
        break;
      case StrikeCause::Kind::budget:
        mark_forced_missing(before);
        break;
    }
  }
}

}  // namespace toposcope
