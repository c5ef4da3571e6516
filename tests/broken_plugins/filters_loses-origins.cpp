// SPDX-License-Identifier: BSD-3-Clause
#include "sound.h"

namespace {
struct Broken : sound::Filter {
  using Filter::Filter;
  void apply(const toposcope::MeshView& mesh, toposcope::Context&, toposcope::MeshSink& sink) const override {
    if (mesh.face_count() > 500) sink.set(mesh.positions, mesh.triangles, {}, {});
  }
};
}  // namespace

TOPOSCOPE_PLUGIN(MeshFilter, Broken, {.id = "loses-origins", .version = "1.0.0", .summary = "Broken on purpose"})
