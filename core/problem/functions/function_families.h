// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The functions in intension by family: each reads its parameters and has its tables made.

#include "functions/function_call.h"

namespace toposcope::intension {

// Of values as numbers.
void arithmetic(const Call& call);
void disjunction(const Call& call);
void maximum(const Call& call);
void knapsack(const Call& call);

// Of how often values occur.
void all_different(const Call& call);
void w_all_different(const Call& call);
void cardinality(const Call& call);
void w_cardinality(const Call& call);
void same(const Call& call);
void w_same(const Call& call);
void among(const Call& call);
void w_var_among(const Call& call);
void w_overlap(const Call& call);
void w_sum(const Call& call);
void diverse(const Call& call);
void clique(const Call& call);

// Of what an automaton or a grammar reads, and of trees.
void regular(const Call& call);
void grammar(const Call& call);
void spanning_tree(const Call& call);

}  // namespace toposcope::intension
