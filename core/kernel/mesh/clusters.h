// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "toposcope/context.h"
#include "toposcope/mesh_view.h"

namespace toposcope {

/// The vertices of a mesh in connected groups.
struct Clusters {
  std::vector<Index> of;             ///< per vertex; no_vertex where no face uses it
  std::vector<Index> offsets = {0};  ///< compressed rows, size clusters + 1, into `vertices`
  std::vector<Index> vertices;

  Index size() const { return static_cast<Index>(offsets.size() - 1); }
  std::span<const Index> operator[](std::size_t cluster) const {
    return std::span(vertices).subspan(offsets[cluster], offsets[cluster + 1] - offsets[cluster]);
  }
};

/// Groups the vertices of a mesh around seeds that are about a radius apart along the surface, each vertex with the
/// nearest seed (a maximal Poisson-disk sample and its Voronoi cells; Cook 1986, Valette and Chassery 2004). Which
/// vertices become seeds is decided by positions alone: vertices in another order make the same clusters in the same
/// order. Linear time.
class Clustering {
 public:
  /// \param mesh    must outlive this
  /// \param radius  mesh unit
  Clustering(const MeshView& mesh, double radius, Context& context);

  const Clusters& clusters() const { return clusters_; }
  /// How far apart seeds are around a cluster.
  double radius(Index cluster) const { return seeds_[cluster].radius; }

  /// Groups the vertices of some clusters anew, around seeds half as far from each other.
  /// \param which  one per cluster
  void split(const std::vector<bool>& which);

 private:
  struct Place {             // together: a visit touches one line of the cache
    Index seed = no_vertex;  ///< the nearest one
    float squared = 1;       ///< distance from it in its radii
    bool open = true;        ///< belongs to no cluster that is kept
  };
  struct Seed {
    Index vertex;
    double radius;
  };
  void cluster(std::vector<Index> open);
  std::vector<Index> ranked(std::vector<Index> vertices) const;
  void grow(const Seed& seed);
  bool leads_to_seed(Index v) const;
  std::vector<Index> apart(std::span<const Index> vertices) const;
  void connect(std::span<const Index> vertices);
  void gather();

  const MeshView& mesh_;
  Context& context_;
  std::vector<Place> places_;
  std::vector<Seed> seeds_;  ///< one per cluster
  std::vector<Index> reached_;
  Clusters clusters_;
};

}  // namespace toposcope
