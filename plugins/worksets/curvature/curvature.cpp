// SPDX-License-Identifier: BSD-3-Clause

// Working sets by two curvature thresholds and region growing: dissertation 4.2 and 4.3.

#include "toposcope/geometry/curvature.h"

#include <algorithm>

#include "toposcope/plugin.h"

namespace {

using namespace toposcope;

constexpr OptionSpec options[] = {
    {"neighbourhood", OptionType::real, "diagonals", "0.02", "0", "0.2",
     "reach of the curvature estimate; as many rings of edges as fit, at least one"},
    {"plane_threshold", OptionType::real, "1/diagonals", "5", "0", "1000",
     "curvature magnitude below which a vertex is planar"},
    {"high_threshold", OptionType::real, "1/diagonals", "15", "0", "10000",
     "curvature magnitude above which a vertex is convex or concave"},
    {"smoothing", OptionType::integer, "", "1", "0", "20", "passes of averaging the curvature over the one-ring"},
    {"min_region", OptionType::real, "diagonals", "0.02", "0", "1",
     "an isolated region of less area than the square of this is merged into the region around it"},
};

constexpr ProvidedName types[] = {
    {"convex", 0, "maximum curvature of high magnitude"},
    {"concave", 0, "minimum curvature of high magnitude"},
    {"planar", 0, "curvature of low magnitude"},
    {"other", 0, "between the thresholds"},
};
enum Type : std::uint8_t { convex, concave, planar, other };

class CurvatureWorkingSets final : public WorkingSetClassifier {
 public:
  explicit CurvatureWorkingSets(const Options& given)
      : neighbourhood_(given.real("neighbourhood")),
        plane_threshold_(given.real("plane_threshold")),
        high_threshold_(given.real("high_threshold")),
        smoothing_(given.integer("smoothing")),
        min_region_(given.real("min_region")) {
    if (plane_threshold_ > high_threshold_)
      throw std::invalid_argument("plane_threshold must not exceed high_threshold");
  }

  void classify(const MeshView& mesh, Context& context, WorkingSetSink& sink) const override {
    std::vector<Type> type = vertex_types(mesh, context);
    std::vector<std::vector<Index>> regions = grow(mesh, type);
    // Regions within regions: each round leaves fewer.
    while (merge_small(mesh, regions, type)) regions = grow(mesh, type);
    for (const auto& region : regions) sink.add(types[type[region.front()]].name, region, 1);
  }

 private:
  std::vector<Type> vertex_types(const MeshView& mesh, Context& context) const {
    const double diagonal = mesh.box.diagonal();
    Curvature curvature = turning_curvature(mesh, plane_fit_normals(mesh, context),
                                            rings_within(mesh, neighbourhood_ * diagonal), context);
    smooth_over_ring(mesh, curvature.maximum, smoothing_, context);
    smooth_over_ring(mesh, curvature.minimum, smoothing_, context);
    std::vector<Type> type(mesh.vertex_count());
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      const double high = std::abs(curvature.maximum[v]), low = std::abs(curvature.minimum[v]);
      const double magnitude = std::max(high, low) * diagonal;
      const double sign = high >= low ? curvature.maximum[v] : curvature.minimum[v];
      if (magnitude < plane_threshold_)
        type[v] = planar;
      else if (magnitude > high_threshold_)
        type[v] = sign > 0 ? convex : concave;
      else
        type[v] = other;
    }
    return type;
  }

  /// Connected vertices of one type, in the order of their first vertex.
  static std::vector<std::vector<Index>> grow(const MeshView& mesh, const std::vector<Type>& type) {
    std::vector<std::vector<Index>> regions;
    std::vector<bool> taken(mesh.vertex_count(), false);
    for (Index seed = 0; seed < mesh.vertex_count(); ++seed) {
      if (taken[seed] || mesh.one_ring(seed).empty()) continue;
      std::vector<Index> region{seed};
      taken[seed] = true;
      for (std::size_t i = 0; i < region.size(); ++i)
        for (Index q : mesh.one_ring(region[i]))
          if (!taken[q] && type[q] == type[seed]) {
            taken[q] = true;
            region.push_back(q);
          }
      regions.push_back(std::move(region));
    }
    return regions;
  }

  /// "Small isolated regions that are imbedded in a larger region are then merged into the larger region": a small
  /// region with one larger region all around it takes that one's type.
  bool merge_small(const MeshView& mesh, const std::vector<std::vector<Index>>& regions,
                   std::vector<Type>& type) const {
    const double side = min_region_ * mesh.box.diagonal();
    const double vertex_area = surface_area(mesh) / mesh.vertex_count();
    std::vector<Index> region_of(mesh.vertex_count(), 0);
    for (Index r = 0; r < regions.size(); ++r)
      for (Index v : regions[r]) region_of[v] = r;
    const std::vector<Type> before = type;
    bool changed = false;
    for (Index r = 0; r < regions.size(); ++r) {
      if (static_cast<double>(regions[r].size()) * vertex_area >= side * side) continue;
      Index around = r;
      bool imbedded = true;
      for (Index v : regions[r])
        for (Index q : mesh.one_ring(v)) {
          if (region_of[q] == r) continue;
          if (around == r) around = region_of[q];
          imbedded = imbedded && around == region_of[q];
        }
      if (!imbedded || regions[around].size() <= regions[r].size()) continue;
      for (Index v : regions[r]) type[v] = before[regions[around].front()];
      changed = true;
    }
    return changed;
  }

  double neighbourhood_, plane_threshold_, high_threshold_;
  int smoothing_;
  double min_region_;
};

}  // namespace

TOPOSCOPE_PLUGIN(WorkingSetClassifier, CurvatureWorkingSets,
                 {.id = "curvature",
                  .version = "1.0.0",
                  .summary = "Regions of high convex, high concave and low curvature, by two thresholds",
                  .citation = "Neal 1999, 4.2 and 4.3; Itter and Jain 1985",
                  .options = options,
                  .provides = types})
