// SPDX-License-Identifier: BSD-3-Clause
// Moves every vertex towards the mean of its neighbours.
#include <numeric>
#include <vector>

#include "toposcope/plugin.h"

namespace {
using namespace toposcope;

struct Filter final : MeshFilter {
  explicit Filter(const Options& options) : passes(options.integer("passes")), part(options.real("part")) {}

  void apply(const MeshView& mesh, Context& context, MeshSink& sink) const override {
    std::vector<Vec3> positions(mesh.positions.begin(), mesh.positions.end()), next(positions.size());
    for (int pass = 0; pass < passes && !context.cancelled(); ++pass) {
      // Results are written by index, so they are the same at any thread count.
      context.parallel_for(positions.size(), 1024, [&](std::size_t first, std::size_t last) {
        for (std::size_t v = first; v < last; ++v) {
          const std::span<const Index> ring = mesh.one_ring(static_cast<Index>(v));
          Vec3 sum = Vec3::Zero();
          for (const Index neighbor : ring) sum += positions[neighbor] - positions[v];
          next[v] = positions[v];
          if (!ring.empty()) next[v] += part / static_cast<double>(ring.size()) * sum;
        }
      });
      positions.swap(next);
    }
    std::vector<Index> origin(mesh.face_count());  // every face comes from that of the same number
    std::iota(origin.begin(), origin.end(), Index{0});
    sink.set(positions, mesh.triangles, origin, {});  // no vertex is where it was
  }

  int passes;
  double part;
};

const OptionSpec options[] = {
    {"passes", OptionType::integer, "", "1", "0", "1000", "times that every vertex moves"},
    {"part", OptionType::real, "", "0.5", "0", "0.9", "part of the way to the mean of its neighbours"},
};
}  // namespace

TOPOSCOPE_PLUGIN(
    MeshFilter, Filter,
    {.id = "@ID@", .version = "0.1.0", .summary = "Moves vertices to the mean of their neighbours", .options = options})
