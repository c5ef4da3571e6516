// SPDX-License-Identifier: BSD-3-Clause
#include "centroid_shape.h"

extern "C" __attribute__((visibility("default"))) const char* some_other_symbol() {
  return "not a plugin";
}
