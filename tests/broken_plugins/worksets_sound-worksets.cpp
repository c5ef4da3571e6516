// SPDX-License-Identifier: BSD-3-Clause
#include "sound.h"

// Not broken: the kit finds nothing.
BROKEN_WORKSETS("sound-worksets", sound::Classifier)
