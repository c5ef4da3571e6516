// SPDX-License-Identifier: BSD-3-Clause

// Working sets at all curvature thresholds at once: nodes of the component tree of the curvature field.

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "component_tree.h"
#include "toposcope/curvature.h"
#include "toposcope/large_array.h"
#include "toposcope/plugin.h"

namespace {

using namespace toposcope;

constexpr OptionSpec options[] = {
    {"deviation", OptionType::real, "diagonals", "0.015", "0", "0.1",
     "standard deviation of the kernel that smooths the curvature; at least one pass, at most eight"},
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

/// Of each type the field is the logarithm of a curvature times the object's size, so that neither unit nor rounding
/// plays a role.
constexpr double step = 0.02, flat = 1e-2;
using Field = double (*)(double maximum, double minimum);
constexpr std::array<std::pair<const char*, Field>, 3> fields = {{
    {"convex", [](double maximum, double) { return std::log(std::max(maximum, flat)); }},
    {"concave", [](double, double minimum) { return std::log(std::max(-minimum, flat)); }},
    {"planar",
     [](double maximum, double minimum) {
       return -std::log(std::max({maximum, -minimum, flat}));
     }},
}};

class CurvatureTree final : public WorkingSetClassifier {
 public:
  explicit CurvatureTree(const Options& given)
      : deviation_(given.real("deviation")),
        max_part_(given.real("max_part")),
        limits_{given.real("growth"), static_cast<Index>(given.integer("min_vertices")), 0,
                static_cast<std::size_t>(given.integer("max_sets"))} {}

  void classify(const MeshView& mesh, Context& context, WorkingSetSink& sink) const override {
    const std::array<component_tree::Levels, fields.size()> levels = read_fields(mesh, context);
    component_tree::Limits limits = limits_;
    limits.max_vertices = static_cast<Index>(max_part_ * mesh.vertex_count());
    std::array<component_tree::Components, fields.size()> found;
    context.parallel_for(fields.size(), 1, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) found[i] = component_tree::components(mesh, levels[i], step, limits);
    });
    for (std::size_t i = 0; i < fields.size(); ++i)
      for (std::size_t set = 0; set < found[i].size(); ++set)
        sink.add(fields[i].first, found[i][set], found[i].saliency[set]);
  }

 private:
  std::array<component_tree::Levels, fields.size()> read_fields(const MeshView& mesh, Context& context) const {
    ShapeOperators operators = fit_shape_operators(mesh, context);
    diffuse(mesh, operators, diffusion_passes(mesh, deviation_ * mesh.box.diagonal(), 1), context);
    // Lengths relative to the root of the surface area: unlike a box it has no ties to break.
    const double size = std::sqrt(surface_area(mesh));
    std::array<component_tree::Levels, fields.size()> levels;
    for (component_tree::Levels& level : levels) level = large_array<std::int32_t>(mesh.vertex_count());
    context.parallel_for(mesh.vertex_count(), 1024, [&](std::size_t first, std::size_t last) {
      for (std::size_t v = first; v < last; ++v) {
        const PrincipalCurvatures principal = principal_curvatures(operators.at[v]);
        for (std::size_t i = 0; i < fields.size(); ++i) {
          const double field = fields[i].second(size * principal.maximum, size * principal.minimum);
          levels[i][v] = static_cast<std::int32_t>(std::floor(field / step));
        }
      }
    });
    return levels;
  }

  double deviation_;
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
