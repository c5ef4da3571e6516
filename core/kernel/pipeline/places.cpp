// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/places.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "pipeline/same_shape.h"

namespace toposcope {
namespace {

/// Below it exact fits are not told apart either, in mean edges: the floor that fitters take for their noise.
constexpr double noise_floor = 0.02;
/// Of coarse triangles beside a line, in mean edges.
constexpr double most_spacing = 2;

/// How finely the mesh shows a line.
struct Fineness {
  bool sharp = false;  ///< most of its vertices are on a sharp edge: they are exact, wherever the next ones are
  double spacing = 0;  ///< mean length of the longest edge at its vertices, mesh unit; 0: it is no line
};

/// True where two faces at the vertex meet at an angle of more than 30 degrees.
bool on_sharp_edge(const MeshView& mesh, Index vertex) {
  constexpr double least_cosine = 0.866;
  const auto normal = [&](Index face) {
    const auto& [a, b, c] = mesh.triangles[face];
    const Vec3& p = mesh.positions[a];
    return (mesh.positions[b] - p).cross(mesh.positions[c] - p);
  };
  const auto faces = mesh.faces_of(vertex);
  for (std::size_t i = 0; i < faces.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const Vec3 one = normal(faces[i]), other = normal(faces[j]);
      if (one.dot(other) < least_cosine * one.norm() * other.norm()) return true;
    }
  return false;
}

Fineness fineness_of(const ConstructedFeature& feature, const MeshView& mesh) {
  Fineness fineness;
  if (feature.dimension != 1 || feature.vertices.empty()) return fineness;
  std::size_t sharp = 0;
  for (const Index v : feature.vertices) {
    double longest = 0;
    for (const Index w : mesh.one_ring(v)) longest = std::max(longest, (mesh.positions[w] - mesh.positions[v]).norm());
    fineness.spacing += longest / static_cast<double>(feature.vertices.size());
    sharp += on_sharp_edge(mesh, v);
  }
  fineness.sharp = 2 * sharp > feature.vertices.size();
  return fineness;
}

/// Distance within which two fits may be of one curve or surface: that of their noise, and of two lines that are not
/// both sharp edges that of the mesh's own spacing beside them.
double indistinct(const FittedShape& a, const FittedShape& b, const Fineness& of_a, const Fineness& of_b,
                  double mean_edge) {
  const double noise = a.rms + b.rms + a.centroid_sd + b.centroid_sd;
  const double spacing = of_a.sharp && of_b.sharp ? 0 : std::min(of_a.spacing, of_b.spacing);
  return std::max(std::clamp(noise, noise_floor * mean_edge, mean_edge), std::min(spacing, most_spacing * mean_edge));
}

bool meet(const ConstructedFeature& a, const ConstructedFeature& b, const BitMatrix& overlap) {
  return std::any_of(a.sets.begin(), a.sets.end(), [&](Index s) {
    return std::any_of(b.sets.begin(), b.sets.end(), [&](Index t) { return overlap.get(s, t); });
  });
}

/// The vertices of one feature, marked.
class Region {
 public:
  explicit Region(const MeshView& mesh) : mesh_(mesh), inside_(mesh.vertex_count(), 0) {}

  void mark(const ConstructedFeature& feature) {
    for (const Index v : marked_) inside_[v] = 0;
    marked_ = feature.vertices;
    for (const Index v : marked_) inside_[v] = 1;
  }

  bool has_border(const ConstructedFeature& feature) const {
    std::size_t shared = 0, within = 0;
    for (const Index v : feature.vertices) {
      if (!inside_[v]) continue;
      ++shared;
      const auto near = mesh_.one_ring(v);
      within += std::all_of(near.begin(), near.end(), [&](Index w) { return inside_[w] != 0; });
    }
    return 2 * within <= feature.vertices.size() && 3 * shared <= marked_.size() + feature.vertices.size();
  }

 private:
  const MeshView& mesh_;
  std::vector<char> inside_;
  std::vector<Index> marked_;
};

bool two_dimensions(const ConstructedFeature& a, const ConstructedFeature& b) {
  return a.dimension >= 0 && b.dimension >= 0 && a.dimension != b.dimension;
}

struct Lines {
  std::vector<Fineness> fineness;  ///< of each feature
  double mean_edge;
};

/// Of a row those features that come later in the order of `features`.
void exclude(const std::vector<ConstructedFeature>& features, const Lines& lines, const BitMatrix& overlap, Index a,
             BitMatrix& excluded) {
  excluded.set(a, a);
  for (Index b = a + 1; b < features.size(); ++b) {
    const ConstructedFeature &one = features[a], &other = features[b];
    if (meet(one, other, overlap) ||
        (!two_dimensions(one, other) &&
         same_shape(one, other,
                    indistinct(one.shape, other.shape, lines.fineness[a], lines.fineness[b], lines.mean_edge))))
      excluded.set(a, b);
  }
}

}  // namespace

BitMatrix exclusions(const ModelRun& run, const MeasuredWorkingSets& sets,
                     const std::vector<ConstructedFeature>& features) {
  const auto count = static_cast<Index>(features.size());
  BitMatrix excluded(count);
  Lines lines{std::vector<Fineness>(count), run.mesh.mean_edge};
  run.context.parallel_for(count, 8, [&](std::size_t first, std::size_t last) {
    for (std::size_t a = first; a < last; ++a) lines.fineness[a] = fineness_of(features[a], run.mesh);
  });
  run.context.parallel_for(count, 8, [&](std::size_t first, std::size_t last) {
    for (std::size_t a = first; a < last; ++a) exclude(features, lines, sets.overlap, static_cast<Index>(a), excluded);
  });
  for (Index a = 0; a < count; ++a)
    for (Index b = a + 1; b < count; ++b)
      if (excluded.get(a, b)) excluded.set(b, a);
  Region region(run.mesh);
  for (Index high = 0; high < count; ++high) {
    bool marked = false;
    for (Index low = 0; low < count; ++low) {
      if (!two_dimensions(features[low], features[high]) || features[low].dimension > features[high].dimension ||
          !excluded.get(low, high))
        continue;
      if (!marked) region.mark(features[high]);
      marked = true;
      if (!region.has_border(features[low])) continue;
      excluded.clear(low, high);
      excluded.clear(high, low);
    }
  }
  return excluded;
}

}  // namespace toposcope
