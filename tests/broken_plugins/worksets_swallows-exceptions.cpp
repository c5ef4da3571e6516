// SPDX-License-Identifier: BSD-3-Clause
#include "sound.h"

namespace {
struct Broken : sound::Classifier {
  using Classifier::Classifier;
  void classify(const toposcope::MeshView& mesh, toposcope::Context& context,
                toposcope::WorkingSetSink& sink) const override {
    try {
      context.progress(0.5);
    } catch (...) {  // so an interrupted run goes on
    }
    Classifier::classify(mesh, context, sink);
  }
};
}  // namespace

BROKEN_WORKSETS("swallows-exceptions", Broken)
