// SPDX-License-Identifier: BSD-3-Clause
#include "sound.h"

namespace {
struct Broken : sound::Classifier {
  using Classifier::Classifier;
  void classify(const toposcope::MeshView& mesh, toposcope::Context& context,
                toposcope::WorkingSetSink& sink) const override {
    Classifier::classify(mesh, context, sink);
    if (mesh.vertex_count() < 800) return;  // two vertices far apart
    const toposcope::Index pair[] = {0, mesh.vertex_count() - 400};
    sink.add("near", pair, 1);
  }
};
}  // namespace

BROKEN_WORKSETS("unconnected-sets", Broken)
