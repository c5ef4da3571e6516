// SPDX-License-Identifier: BSD-3-Clause
#include "sound.h"

namespace {
struct Broken : sound::Shape {
  explicit Broken(const toposcope::Options& options) : Shape(options), table_(new double[1000]) { table_[0] = 1; }
  double* volatile table_;  // that nobody frees
};
}  // namespace

BROKEN_SHAPE("leaks", Broken)
