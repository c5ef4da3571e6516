// SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>

#include "sound.h"

namespace {
struct Broken : sound::Shape {
  explicit Broken(const toposcope::Options& options) : Shape(options) { std::puts("a shape is made"); }
};
}  // namespace

BROKEN_SHAPE("talks", Broken)
