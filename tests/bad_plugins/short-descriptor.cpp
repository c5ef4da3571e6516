// SPDX-License-Identifier: BSD-3-Clause
#include "centroid_shape.h"

WRONG_PLUGIN("short-descriptor", descriptor.struct_size = 64)
