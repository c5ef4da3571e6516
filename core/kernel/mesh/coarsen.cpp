// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/coarsen.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "mesh/folded_clusters.h"
#include "toposcope/geometry/large_array.h"

namespace toposcope {
namespace {

constexpr double samples_per_squared_radius = 0.70;  // of a maximal Poisson-disk sample, on the area
constexpr double gap_between_vertices = 0.2;         // mean edges
constexpr double least_reduction = 2;
constexpr double worth_it = 0.7;  // part of the faces
constexpr int most_splits = 16;
constexpr int thin_halvings = 2;

double area_of(const MeshView& mesh, Context& context) {
  constexpr std::size_t chunk = 1 << 14;
  std::vector<double> parts((mesh.face_count() + chunk - 1) / chunk, 0);
  context.parallel_for(mesh.face_count(), chunk, [&](std::size_t first, std::size_t last) {
    for (std::size_t f = first; f < last; ++f) {
      const auto& [a, b, c] = mesh.triangles[f];
      parts[first / chunk] +=
          (mesh.positions[b] - mesh.positions[a]).cross(mesh.positions[c] - mesh.positions[a]).norm() / 2;
    }
  });
  return std::accumulate(parts.begin(), parts.end(), 0.0);
}

bool on_border(const MeshView& mesh, Index v) {
  return mesh.one_ring(v).size() != mesh.faces_of(v).size();
}

/// A cluster's middle, and the mean squared distance of its vertices from there. Of one at the border that of its
/// border.
struct Middle {
  Vec3 place = Vec3::Zero();
  double spread = 0;
  bool border = false;
};

std::vector<Middle> middles_of(const MeshView& mesh, const Clusters& clusters, Context& context) {
  std::vector<Middle> middles(clusters.size());
  context.parallel_for(middles.size(), 256, [&](std::size_t first, std::size_t last) {
    for (std::size_t c = first; c < last; ++c) {
      Middle& middle = middles[c];
      const std::span<const Index> all = clusters[c];
      middle.border = std::any_of(all.begin(), all.end(), [&](Index v) { return on_border(mesh, v); });
      const Vec3 origin = mesh.positions[all.front()];
      Vec3 sum = Vec3::Zero();
      double squares = 0, count = 0;
      for (const Index v : all) {
        if (middle.border && !on_border(mesh, v)) continue;
        const Vec3 arm = mesh.positions[v] - origin;
        sum += arm;
        squares += arm.squaredNorm();
        ++count;
      }
      middle.place = origin + sum / count;
      middle.spread = std::max(0.0, squares / count - (sum / count).squaredNorm());
    }
  });
  return middles;
}

/// A mean over a bent patch lies inside of the bend, by half of the mean curvature times the patch's squared radius of
/// gyration; the neighbours' middles lie inside of the patch's own by half of it times their squared distance. So a
/// part of the way from the neighbours leads back onto the surface, up to the fourth power of lengths (one step of
/// deconvolution; Taubin 1995 has its transfer function).
std::vector<Vec3> places_of(std::span<const Middle> middles, std::span<const Triangle> triangles) {
  struct Around {
    Vec3 sum = Vec3::Zero();
    double squares = 0, count = 0;
  };
  std::vector<Around> around(middles.size());
  for (const Triangle& t : triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const Index a = t[k], b = t[(k + 1) % 3];
      // Inner edges come twice, once in each direction, and border edges of the mesh once: both ways for these.
      const auto see = [&](Index from, Index to) {
        if (middles[from].border && !middles[to].border) return;
        const Vec3 arm = middles[to].place - middles[from].place;
        around[from].sum += arm;
        around[from].squares += arm.squaredNorm();
        ++around[from].count;
      };
      see(a, b);
      see(b, a);
    }
  std::vector<Vec3> places(middles.size());
  for (std::size_t c = 0; c < places.size(); ++c) {
    const Around& seen = around[c];
    places[c] = middles[c].place;
    if (seen.count > 0)
      places[c] -= std::min(middles[c].spread / (seen.squares / seen.count), 0.5) * (seen.sum / seen.count);
  }
  return places;
}

/// Splits what is folded until nothing is.
/// \return nothing where that has no end
std::optional<ClusterFaces> unfolded(const MeshView& mesh, Clustering& clustering, Context& context) {
  for (int splits = 0; splits <= most_splits && !context.cancelled(); ++splits) {
    ClusterFaces dual = faces_between(mesh, clustering.clusters(), context);
    if (dual.folded.empty()) return dual;
    std::vector<bool> which(clustering.clusters().size(), false);
    for (const Index c : dual.folded) which[c] = true;
    clustering.split(which);
  }
  return std::nullopt;
}

/// Which clusters were split: the parts that are thinner than the rest is coarse.
std::vector<bool> thin_parts(const Clustering& clustering, double radius) {
  std::vector<bool> thin(clustering.clusters().size());
  for (Index c = 0; c < thin.size(); ++c) thin[c] = clustering.radius(c) < radius;
  return thin;
}

}  // namespace

std::optional<CoarseMesh> coarsen(const MeshView& mesh, std::size_t faces, Context& context) {
  if (mesh.face_count() <= least_reduction * static_cast<double>(faces)) return std::nullopt;
  const double area = area_of(mesh, context), wanted = static_cast<double>(faces) / 2;  // two faces a vertex
  // Vertices are not everywhere: seeds are farther apart than they need be, by a part of an edge.
  const double radius = std::sqrt(samples_per_squared_radius * area / wanted) - gap_between_vertices * mesh.mean_edge;
  Clustering clustering(mesh, radius, context);
  std::optional<ClusterFaces> dual = unfolded(mesh, clustering, context);
  // Enough to keep the form is too little to see it.
  for (int halvings = 0; halvings < thin_halvings && dual; ++halvings) {
    const std::vector<bool> thin = thin_parts(clustering, radius);
    const auto count = static_cast<double>(std::count(thin.begin(), thin.end(), true));
    if (count == 0 || 4 * count > wanted) break;
    clustering.split(thin);
    dual = unfolded(mesh, clustering, context);
  }
  if (!dual || static_cast<double>(dual->triangles.size()) > worth_it * mesh.face_count()) return std::nullopt;
  TriangleSoup soup;
  soup.positions = places_of(middles_of(mesh, clustering.clusters(), context), dual->triangles);
  soup.input_faces = static_cast<Index>(dual->triangles.size());
  soup.face_origin.resize(soup.input_faces);
  std::iota(soup.face_origin.begin(), soup.face_origin.end(), Index{0});
  soup.triangles = std::move(dual->triangles);
  return CoarseMesh{Mesh(std::move(soup), "the coarse mesh", &context), clustering.clusters()};
}

}  // namespace toposcope
