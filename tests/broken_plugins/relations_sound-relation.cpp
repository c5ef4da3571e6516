// SPDX-License-Identifier: BSD-3-Clause
#include "sound.h"

// Not broken: the kit finds nothing.
TOPOSCOPE_PLUGIN(RelationTester, sound::Relation,
                 {.id = "sound-relation",
                  .version = "1.0.0",
                  .summary = "Not broken",
                  .unit = "length",
                  .min_arity = 2,
                  .max_arity = 2})
