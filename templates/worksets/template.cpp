// SPDX-License-Identifier: BSD-3-Clause
// Connected sets of vertices at which the surface turns sharply.
#include <Eigen/Geometry>
#include <utility>
#include <vector>

#include "toposcope/plugin.h"

namespace {
using namespace toposcope;

struct Classifier final : WorkingSetClassifier {
  explicit Classifier(const Options& options) : angle(options.real("angle") * pi / 180) {}

  void classify(const MeshView& mesh, Context& context, WorkingSetSink& sink) const override {
    std::vector<Vec3> normals(mesh.face_count());
    for (Index f = 0; f < mesh.face_count(); ++f) {
      const Triangle& t = mesh.triangles[f];
      const Vec3& p = mesh.positions[t[0]];
      normals[f] = (mesh.positions[t[1]] - p).cross(mesh.positions[t[2]] - p);
    }
    std::vector<char> sharp(mesh.vertex_count(), 0);
    // Results are written by index, so they are the same at any thread count.
    context.parallel_for(sharp.size(), 1024, [&](std::size_t first, std::size_t last) {
      for (std::size_t v = first; v < last; ++v) {
        const std::span<const Index> around = mesh.faces_of(static_cast<Index>(v));
        for (const Index f : around)
          for (const Index g : around)
            if (normals[f].squaredNorm() > 0 && normals[g].squaredNorm() > 0 &&
                std::atan2(normals[f].cross(normals[g]).norm(), normals[f].dot(normals[g])) > angle)
              sharp[v] = 1;
      }
    });
    for (Index seed = 0; seed < sharp.size() && !context.cancelled(); ++seed) {
      if (!sharp[seed]) continue;
      std::vector<Index> set = {seed};
      sharp[seed] = 0;
      for (std::size_t i = 0; i < set.size(); ++i)
        for (const Index neighbor : mesh.one_ring(set[i]))
          if (std::exchange(sharp[neighbor], 0)) set.push_back(neighbor);
      sink.add("crease", set, 1);
    }
  }

  double angle;  // rad
};

const OptionSpec options[] = {{"angle", OptionType::real, "deg", "40", "1", "179", "a crease turns by more than this"}};
const ProvidedName types[] = {{"crease", 0, "the surface turns sharply"}};
}  // namespace

TOPOSCOPE_PLUGIN(WorkingSetClassifier, Classifier,
                 {.id = "@ID@",
                  .version = "0.1.0",
                  .summary = "Connected sets of vertices at creases",
                  .options = options,
                  .provides = types})
