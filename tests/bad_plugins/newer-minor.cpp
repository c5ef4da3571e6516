// SPDX-License-Identifier: BSD-3-Clause
#include "centroid_shape.h"

WRONG_PLUGIN("newer-minor", descriptor.minor = toposcope::abi_minor + 1)
