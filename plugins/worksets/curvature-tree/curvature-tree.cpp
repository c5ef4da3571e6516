// SPDX-License-Identifier: BSD-3-Clause

// Working sets at all curvature thresholds at once: nodes of the component tree of the curvature field.

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>
#include <vector>

#include "component_tree.h"
#include "creases.h"
#include "halves.h"
#include "toposcope/geometry/curvature.h"
#include "toposcope/geometry/large_array.h"
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
     "working sets of one field; those of greatest saliency times root of size are kept"},
    {"reach", OptionType::real, "mean-edges", "3", "0", "10",
     "radius of the ball whose first moment tells edges of thin sheets too; 0: curvature alone"},
    {"halves", OptionType::boolean, "", "true", "", "", "long convex rings are offered in two halves too"},
    {"creases", OptionType::boolean, "", "true", "", "",
     "sharp edges and the parts of the surface between them are offered too, of any size"},
};

constexpr ProvidedName types[] = {
    {"convex", 0, "components of high maximum curvature or of a large first moment"},
    {"concave", 0, "components of low (negative) minimum curvature"},
    {"planar", 0, "components of low curvature magnitude"},
};

/// Of each type the field is the logarithm of a curvature times the object's size, or of a moment in radii, so that
/// neither unit nor rounding plays a role.
constexpr double step = 0.02, least = 1e-2;
using Field = double (*)(double maximum, double minimum);
constexpr std::array<std::pair<const char*, Field>, 3> fields = {{
    {"convex", [](double maximum, double) { return std::log(std::max(maximum, least)); }},
    {"concave", [](double, double minimum) { return std::log(std::max(-minimum, least)); }},
    {"planar",
     [](double maximum, double minimum) {
       return -std::log(std::max({maximum, -minimum, least}));
     }},
}};

class CurvatureTree final : public WorkingSetClassifier {
 public:
  explicit CurvatureTree(const Options& given)
      : deviation_(given.real("deviation")),
        max_part_(given.real("max_part")),
        reach_(given.real("reach")),
        halves_(given.boolean("halves")),
        creases_(given.boolean("creases")),
        limits_{given.real("growth"), static_cast<Index>(given.integer("min_vertices")), 0,
                static_cast<std::size_t>(given.integer("max_sets"))} {}

  void classify(const MeshView& mesh, Context& context, WorkingSetSink& sink) const override {
    component_tree::Limits limits = limits_;
    limits.max_vertices = static_cast<Index>(max_part_ * mesh.vertex_count());
    const creases::Parts parts = creases_ ? creases::parts_of(mesh, limits) : creases::Parts{};
    std::vector<component_tree::Levels> levels = read_fields(mesh, parts.flat, context);
    std::vector<const char*> of_type;
    for (const auto& field : fields) of_type.push_back(field.first);
    if (reach_ > 0) {
      levels.push_back(read_moments(mesh, parts.flat, context));
      of_type.push_back("convex");
    }
    std::vector<component_tree::Components> found(levels.size());
    context.parallel_for(levels.size(), 1, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) found[i] = component_tree::components(mesh, levels[i], step, limits);
    });
    for (std::size_t i = 0; i < found.size(); ++i) {
      add(of_type[i], found[i], sink);
      if (halves_ && std::string_view(of_type[i]) == "convex")
        add(of_type[i], component_tree::halves_of_rings(mesh, found[i], limits.min_vertices), sink);
    }
    add("convex", parts.convex, sink);
    add("concave", parts.concave, sink);
    add("planar", parts.planar, sink);
  }

 private:
  static void add(const char* type, const component_tree::Components& sets, WorkingSetSink& sink) {
    for (std::size_t set = 0; set < sets.size(); ++set) sink.add(type, sets[set], sets.saliency[set]);
  }

  std::vector<component_tree::Levels> read_fields(const MeshView& mesh, const std::vector<bool>& flat,
                                                  Context& context) const {
    ShapeOperators operators = fit_shape_operators(mesh, context);
    diffuse(mesh, operators, diffusion_passes(mesh, deviation_ * mesh.box.diagonal(), 1), context);
    // Lengths relative to the root of the surface area: unlike a box it has no ties to break.
    const double size = std::sqrt(surface_area(mesh));
    std::vector<component_tree::Levels> levels(fields.size());
    for (component_tree::Levels& level : levels) level = large_array<std::int32_t>(mesh.vertex_count());
    context.parallel_for(mesh.vertex_count(), 1024, [&](std::size_t first, std::size_t last) {
      for (std::size_t v = first; v < last; ++v) {
        const bool bent = flat.empty() || !flat[v];
        const PrincipalCurvatures principal = bent ? principal_curvatures(operators.at[v]) : PrincipalCurvatures{};
        for (std::size_t i = 0; i < fields.size(); ++i) {
          const double field = fields[i].second(size * principal.maximum, size * principal.minimum);
          levels[i][v] = static_cast<std::int32_t>(std::floor(field / step));
        }
      }
    });
    return levels;
  }

  /// A moment that points against the normal or lies in the surface is that of an edge: at the edge of a thin sheet the
  /// normal may be the sheet's.
  component_tree::Levels read_moments(const MeshView& mesh, const std::vector<bool>& flat, Context& context) const {
    constexpr double rises = 0.3;  // sine of the angle above the surface from which on a moment is that of a crease
    const std::vector<Vec3> moments = first_moments(mesh, reach_, context), normals = vertex_normals(mesh, context);
    component_tree::Levels level = large_array<std::int32_t>(mesh.vertex_count());
    context.parallel_for(mesh.vertex_count(), 1024, [&](std::size_t first, std::size_t last) {
      for (std::size_t v = first; v < last; ++v) {
        const double moment = moments[v].norm();
        const bool bent = flat.empty() || !flat[v];
        const double field = bent && moments[v].dot(normals[v]) < rises * moment ? moment : 0;
        level[v] = static_cast<std::int32_t>(std::floor(std::log(std::max(field, least)) / step));
      }
    });
    return level;
  }

  double deviation_;
  double max_part_;
  double reach_;
  bool halves_;
  bool creases_;
  component_tree::Limits limits_;
};

}  // namespace

TOPOSCOPE_PLUGIN(
    WorkingSetClassifier, CurvatureTree,
    {.id = "curvature-tree",
     .version = "1.2.0",
     .summary = "Nested regions at all curvature thresholds at once; no threshold to tune",
     .citation =
         "component tree: Najman and Couprie 2006; stable regions: Matas et al. 2002; moments: Clarenz et al. 2004",
     .options = options,
     .provides = types})
