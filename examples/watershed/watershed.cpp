// SPDX-License-Identifier: BSD-3-Clause
// Working sets by a watershed of curvature: regions that edges surround, and the borders between two regions.

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "flooding.h"
#include "toposcope/geometry/curvature.h"
#include "toposcope/plugin.h"

namespace {

using namespace toposcope;

class Watershed final : public WorkingSetClassifier {
 public:
  explicit Watershed(const Options& options)
      : depth_(options.real("depth")),
        deviation_(options.real("deviation")),
        least_part_(options.real("least_part")),
        min_vertices_(static_cast<std::size_t>(options.integer("min_vertices"))) {}

  void classify(const MeshView& mesh, Context& context, WorkingSetSink& sink) const override {
    const std::vector<double> height = heights(mesh, context);
    if (context.cancelled()) return;
    const watershed::Basins basins = watershed::flood(mesh, height, depth_, least_part_ * surface_area(mesh));
    give_regions(mesh, basins, height, sink);
    give_borders(mesh, basins, height, sink);
  }

 private:
  /// log(1 + the greater principal curvature in 1/diagonals): a low plain where it is flat, walls along edges.
  std::vector<double> heights(const MeshView& mesh, Context& context) const {
    ShapeOperators operators = fit_shape_operators(mesh, context);
    const double diagonal = mesh.box.diagonal();
    diffuse(mesh, operators, diffusion_passes(mesh, deviation_ * diagonal, 1), context);
    std::vector<double> height(mesh.vertex_count());
    context.parallel_for(height.size(), 4096, [&](std::size_t first, std::size_t last) {
      for (std::size_t v = first; v < last; ++v) {
        const PrincipalCurvatures k = principal_curvatures(operators.at[v]);
        height[v] = std::log1p(std::max(std::abs(k.maximum), std::abs(k.minimum)) * diagonal);
      }
    });
    return height;
  }

  /// How high the walls are over the bottom, 0 to 1.
  double saliency(double wall, double bottom) const {
    const double over = std::max(0.0, wall - bottom);
    return over / (over + depth_);
  }

  /// The end of a crossing edge that belongs to the border; the other one is inside its region. Features never share a
  /// vertex, and a model may name both.
  static bool lies_higher(const std::vector<double>& height, Index v, Index w) {
    return height[v] != height[w] ? height[v] > height[w] : v > w;
  }

  void give_regions(const MeshView& mesh, const watershed::Basins& basins, const std::vector<double>& height,
                    WorkingSetSink& sink) const {
    struct Wall {
      double heights = 0, edges = 0;  // summed over the edges that cross it, and their number
    };
    std::vector<Wall> walls(basins.lowest.size());
    std::vector<char> taken(mesh.vertex_count(), 0);
    for (Index v = 0; v < mesh.vertex_count(); ++v)
      for (const Index w : mesh.one_ring(v))
        if (basins.of_vertex[w] != basins.of_vertex[v]) {
          Wall& wall = walls[basins.of_vertex[v]];
          wall.heights += std::max(height[v], height[w]);
          ++wall.edges;
          taken[v] = taken[v] || lies_higher(height, v, w);
        }
    for (Index seed = 0; seed < mesh.vertex_count(); ++seed) {
      const Index basin = basins.of_vertex[seed];
      if (taken[seed] || basin == Index(-1)) continue;
      std::vector<Index> set = connected(mesh, seed, taken, [&](Index v) { return basins.of_vertex[v] == basin; });
      if (set.size() < min_vertices_) continue;
      const double mean = walls[basin].edges > 0 ? walls[basin].heights / walls[basin].edges : basins.lowest[basin];
      sink.add("region", set, saliency(mean, basins.lowest[basin]));
    }
  }

  /// Of each edge that crosses from one region to another the end that lies higher, by the pair of regions, connected.
  void give_borders(const MeshView& mesh, const watershed::Basins& basins, const std::vector<double>& height,
                    WorkingSetSink& sink) const {
    std::map<std::pair<Index, Index>, std::vector<Index>> borders;
    for (Index v = 0; v < mesh.vertex_count(); ++v)
      for (const Index w : mesh.one_ring(v)) {
        if (basins.of_vertex[w] == basins.of_vertex[v] || !lies_higher(height, v, w)) continue;
        std::vector<Index>& border = borders[std::minmax(basins.of_vertex[v], basins.of_vertex[w])];
        if (border.empty() || border.back() != v) border.push_back(v);
      }
    for (const auto& [pair, border] : borders) {
      std::vector<char> taken(mesh.vertex_count(), 1);
      for (const Index v : border) taken[v] = 0;
      const double bottom = std::max(basins.lowest[pair.first], basins.lowest[pair.second]);
      for (const Index seed : border) {
        if (taken[seed]) continue;
        const std::vector<Index> set = connected(mesh, seed, taken, [](Index) { return true; });
        if (set.size() < min_vertices_) continue;
        double mean = 0;
        for (const Index v : set) mean += height[v] / static_cast<double>(set.size());
        sink.add("border", set, saliency(mean, bottom));
      }
    }
  }

  template <class Wanted>
  static std::vector<Index> connected(const MeshView& mesh, Index seed, std::vector<char>& taken,
                                      const Wanted& wanted) {
    std::vector<Index> set = {seed};
    taken[seed] = 1;
    for (std::size_t i = 0; i < set.size(); ++i)
      for (const Index v : mesh.one_ring(set[i]))
        if (!taken[v] && wanted(v)) {
          taken[v] = 1;
          set.push_back(v);
        }
    return set;
  }

  double depth_;
  double deviation_;
  double least_part_;
  std::size_t min_vertices_;
};

constexpr OptionSpec options[] = {
    {"depth", OptionType::real, "", "1.5", "0.01", "10",
     "how far the wall between two regions stands over the shallower one, in the logarithm of curvature"},
    {"deviation", OptionType::real, "diagonals", "0.01", "0", "0.1",
     "standard deviation of the kernel that smooths the curvature; at least one pass, at most eight"},
    {"least_part", OptionType::real, "", "0.003", "0", "0.5",
     "of the surface; a smaller region is joined to a neighbour"},
    {"min_vertices", OptionType::integer, "", "6", "1", "100000", "the least size of a working set"},
};

constexpr ProvidedName types[] = {
    {"region", 0, "a part of the surface that sharper bends surround"},
    {"border", 0, "where two regions meet"},
};

}  // namespace

TOPOSCOPE_PLUGIN(WorkingSetClassifier, Watershed,
                 {.id = "watershed",
                  .version = "1.0.0",
                  .summary = "Regions between sharp bends, and the borders between them, by a watershed of curvature",
                  .citation = "Mangan and Whitaker, Partitioning 3D surface meshes using watershed segmentation, IEEE "
                              "TVCG 5(4), 1999",
                  .options = options,
                  .provides = types})
