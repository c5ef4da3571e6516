// SPDX-License-Identifier: BSD-3-Clause
#include "centroid_shape.h"

extern "C" __attribute__((visibility("default"))) const toposcope::PluginDescriptor* toposcope_plugin() {
  return nullptr;
}
