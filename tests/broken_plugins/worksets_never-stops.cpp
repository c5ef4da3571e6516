// SPDX-License-Identifier: BSD-3-Clause
#include <chrono>
#include <thread>

#include "sound.h"

namespace {
struct Broken : sound::Classifier {
  using Classifier::Classifier;
  /// Long work on a large mesh, that nothing cuts short.
  void classify(const toposcope::MeshView& mesh, toposcope::Context& context,
                toposcope::WorkingSetSink& sink) const override {
    if (mesh.face_count() > 50000) std::this_thread::sleep_for(std::chrono::seconds(2));
    Classifier::classify(mesh, context, sink);
  }
};
}  // namespace

BROKEN_WORKSETS("never-stops", Broken)
