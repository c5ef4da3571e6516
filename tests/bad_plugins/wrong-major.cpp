// SPDX-License-Identifier: BSD-3-Clause
#include "centroid_shape.h"

// A later major version may have moved every field after the first three: they are poisoned to show that none is read.
WRONG_PLUGIN("wrong-major", descriptor.major = toposcope::abi_major + 1; descriptor.struct_size = 12;
             descriptor.fingerprint = nullptr; descriptor.id = nullptr)
