// SPDX-License-Identifier: BSD-3-Clause

// Working sets at all curvature thresholds at once: nodes of the component tree of the curvature field.

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "component_tree.h"
#include "toposcope/curvature.h"
#include "toposcope/plugin.h"

namespace {

using namespace toposcope;

constexpr OptionSpec options[] = {
    {"neighbourhood", OptionType::real, "diagonals", "0.02", "0", "0.2",
     "reach of the curvature estimate; as many rings of edges as fit, at least one"},
    {"smoothing", OptionType::integer, "", "1", "0", "20", "passes of averaging the curvature over the one-ring"},
    {"growth", OptionType::real, "", "1.25", "1.05", "4",
     "a component is offered again each time that it has grown by this factor"},
    {"min_vertices", OptionType::integer, "", "6", "3", "1000", "the least size of a working set"},
    {"max_part", OptionType::real, "", "0.5", "0.01", "1", "the greatest size of a working set, as part of the mesh"},
    {"max_sets", OptionType::integer, "", "150", "1", "2000",
     "working sets of one type; those of greatest saliency times root of size are kept"},
};

constexpr ProvidedName types[] = {
    {"convex", 0, "components of high maximum curvature"},
    {"concave", 0, "components of low (negative) minimum curvature"},
    {"planar", 0, "components of low curvature magnitude"},
};

class CurvatureTree final : public WorkingSetClassifier {
 public:
  explicit CurvatureTree(const Options& given)
      : neighbourhood_(given.real("neighbourhood")),
        smoothing_(given.integer("smoothing")),
        max_part_(given.real("max_part")),
        limits_{given.real("growth"), static_cast<Index>(given.integer("min_vertices")), 0,
                static_cast<std::size_t>(given.integer("max_sets"))} {}

  void classify(const MeshView& mesh, Context& context, WorkingSetSink& sink) const override {
    // Lengths relative to the root of the surface area: unlike a box it has no ties to break.
    const double size = std::sqrt(surface_area(mesh));
    Curvature curvature = turning_curvature(mesh, plane_fit_normals(mesh, context),
                                            rings_within(mesh, neighbourhood_ * mesh.box.diagonal()), context);
    smooth_over_ring(mesh, curvature.maximum, smoothing_, context);
    smooth_over_ring(mesh, curvature.minimum, smoothing_, context);

    component_tree::Limits limits = limits_;
    limits.max_vertices = static_cast<Index>(max_part_ * mesh.vertex_count());
    const double floor = 1e-2;  // of 1 / size: flatter than flat
    std::vector<double> field(mesh.vertex_count());
    const auto offer = [&](const char* type) {
      for (const component_tree::Component& set : component_tree::components(mesh, field, limits))
        sink.add(type, set.vertices, set.saliency);
    };
    const auto log_of = [&](double kappa) { return std::log(std::max(kappa * size, floor)); };

    for (Index v = 0; v < mesh.vertex_count(); ++v) field[v] = log_of(curvature.maximum[v]);
    offer("convex");
    context.progress(1.0 / 3);
    for (Index v = 0; v < mesh.vertex_count(); ++v) field[v] = log_of(-curvature.minimum[v]);
    offer("concave");
    context.progress(2.0 / 3);
    for (Index v = 0; v < mesh.vertex_count(); ++v)
      field[v] = -log_of(std::max(std::abs(curvature.maximum[v]), std::abs(curvature.minimum[v])));
    offer("planar");
  }

 private:
  double neighbourhood_;
  int smoothing_;
  double max_part_;
  component_tree::Limits limits_;
};

}  // namespace

TOPOSCOPE_PLUGIN(WorkingSetClassifier, CurvatureTree,
                 {.id = "curvature-tree",
                  .version = "1.0.0",
                  .summary = "Nested regions at all curvature thresholds at once; no threshold to tune",
                  .citation = "component tree: Najman and Couprie 2006; stable regions: Matas et al. 2002",
                  .options = options,
                  .provides = types})
