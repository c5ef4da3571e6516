// SPDX-License-Identifier: BSD-3-Clause
// Smoothing without shrinking: Taubin's lambda|mu filter (dissertation 2.4.3).

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <string>
#include <vector>

#include "toposcope/plugin.h"

namespace {

using namespace toposcope;

// What each vertex is averaged over, in compressed rows. An empty row keeps its vertex.
struct Rows {
  std::vector<Index> offsets, columns;
};

// An edge of one face lies on the boundary; one of three or more is a seam that is smoothed alike.
bool is_inner_edge(const MeshView& mesh, Index v, Index w) {
  const auto has_w = [&](Index f) {
    const Triangle& t = mesh.triangles[f];
    return std::find(t.begin(), t.end(), w) != t.end();
  };
  const std::span<const Index> faces = mesh.faces_of(v);
  return std::count_if(faces.begin(), faces.end(), has_w) == 2;
}

// Vertices of the boundary are averaged over their neighbours along it alone, so that it neither shrinks nor is pulled
// inwards.
Rows neighborhoods(const MeshView& mesh, bool keep_boundary, Context& context) {
  std::vector<char> along_boundary(mesh.neighbors.size(), 0);
  Rows rows{std::vector<Index>(mesh.positions.size() + 1, 0), {}};
  context.parallel_for(mesh.positions.size(), 1024, [&](std::size_t first, std::size_t last) {
    for (std::size_t v = first; v < last; ++v) {
      Index boundary = 0;
      const Index begin = mesh.neighbor_offsets[v], end = mesh.neighbor_offsets[v + 1];
      for (Index i = begin; i < end; ++i)
        boundary += along_boundary[i] = !is_inner_edge(mesh, static_cast<Index>(v), mesh.neighbors[i]);
      rows.offsets[v + 1] = boundary == 0 ? end - begin : (keep_boundary ? 0 : boundary);
    }
  });
  std::partial_sum(rows.offsets.begin(), rows.offsets.end(), rows.offsets.begin());
  rows.columns.resize(rows.offsets.back());
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    const Index begin = mesh.neighbor_offsets[v], end = mesh.neighbor_offsets[v + 1];
    Index* column = rows.columns.data() + rows.offsets[v];
    const bool all = rows.offsets[v + 1] - rows.offsets[v] == end - begin;
    for (Index i = begin; i < end && rows.offsets[v] < rows.offsets[v + 1]; ++i)
      if (all || along_boundary[i]) *column++ = mesh.neighbors[i];
  }
  return rows;
}

class Taubin final : public MeshFilter {
 public:
  explicit Taubin(const Options& options)
      : passes_(options.integer("passes")),
        lambda_(options.real("lambda")),
        mu_(1 / (options.real("pass_band") - 1 / lambda_)),
        keep_boundary_(options.text("boundary") == "keep") {
    // Between the pass band and 2, the greatest eigenvalue, a pass multiplies by a falling factor.
    if ((1 - 2 * lambda_) * (1 - 2 * mu_) < -1)
      throw std::invalid_argument("with lambda " + std::to_string(lambda_) + " and pass_band " +
                                  std::to_string(options.real("pass_band")) +
                                  " the filter amplifies noise instead of damping it; lower lambda");
  }

  void apply(const MeshView& mesh, Context& context, MeshSink& sink) const override {
    if (passes_ == 0) return;
    const Rows rows = neighborhoods(mesh, keep_boundary_, context);
    std::vector<Vec3> positions(mesh.positions.begin(), mesh.positions.end()), next(positions.size());
    for (int pass = 0; pass < passes_ && !context.cancelled(); ++pass)
      for (const double factor : {lambda_, mu_}) {
        step(rows, factor, positions, next, context);
        positions.swap(next);
      }
    std::vector<Index> origin(mesh.triangles.size());
    std::iota(origin.begin(), origin.end(), Index{0});
    std::vector<Index> vertex_origin(positions.size(), no_vertex);
    for (Index v = 0; v < vertex_origin.size(); ++v)
      if (positions[v] == mesh.positions[v]) vertex_origin[v] = v;
    sink.set(positions, mesh.triangles, origin, vertex_origin);
  }

 private:
  // Moves every vertex by `factor` of the way to the mean of its neighbours.
  static void step(const Rows& rows, double factor, const std::vector<Vec3>& from, std::vector<Vec3>& to,
                   Context& context) {
    context.parallel_for(from.size(), 2048, [&](std::size_t first, std::size_t last) {
      for (std::size_t v = first; v < last; ++v) {
        const Index begin = rows.offsets[v], end = rows.offsets[v + 1];
        Vec3 sum = Vec3::Zero();
        for (Index i = begin; i < end; ++i) sum += from[rows.columns[i]] - from[v];
        to[v] = from[v];
        if (begin < end) to[v] += factor / (end - begin) * sum;
      }
    });
  }

  int passes_;
  double lambda_;
  double mu_;  // negative
  bool keep_boundary_;
};

constexpr OptionSpec options[] = {
    {"passes", OptionType::integer, "", "10", "0", "10000", "each shrinks by lambda and inflates by mu"},
    {"lambda", OptionType::real, "", "0.63", "0.01", "0.95",
     "part of the way to the mean of its neighbours that a vertex goes"},
    {"pass_band", OptionType::real, "", "0.1", "0.001", "1",
     "eigenvalue k_PB of the Laplacian below which nothing is damped; 1/mu = k_PB - 1/lambda"},
    {"boundary", OptionType::text, "", "smooth", "", "", "vertices of the boundary are smoothed along it, or stay",
     "smooth|keep"},
};

}  // namespace

TOPOSCOPE_PLUGIN(MeshFilter, Taubin,
                 {.id = "taubin",
                  .version = "1.0.0",
                  .summary = "Smoothing without shrinking",
                  .citation = "Taubin, A signal processing approach to fair surface design, SIGGRAPH 1995",
                  .options = options})
