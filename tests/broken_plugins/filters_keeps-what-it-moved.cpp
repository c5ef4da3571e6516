// SPDX-License-Identifier: BSD-3-Clause
#include "sound.h"

namespace {
struct Broken : sound::Filter {
  using Filter::Filter;
  void apply(const toposcope::MeshView& mesh, toposcope::Context&, toposcope::MeshSink& sink) const override {
    std::vector<toposcope::Vec3> positions(mesh.positions.begin(), mesh.positions.end());
    positions[0] += toposcope::Vec3::Constant(0.01 * mesh.mean_edge);
    std::vector<toposcope::Index> faces(mesh.face_count()), vertices(mesh.vertex_count());
    std::iota(faces.begin(), faces.end(), toposcope::Index{0});
    std::iota(vertices.begin(), vertices.end(), toposcope::Index{0});
    sink.set(positions, mesh.triangles, faces, vertices);
  }
};
}  // namespace

TOPOSCOPE_PLUGIN(MeshFilter, Broken, {.id = "keeps-what-it-moved", .version = "1.0.0", .summary = "Broken on purpose"})
