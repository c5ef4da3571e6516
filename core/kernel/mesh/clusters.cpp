// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/clusters.h"

#include <algorithm>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

#include "mesh/position_hash.h"
#include "toposcope/geometry/large_array.h"

namespace toposcope {
namespace {

constexpr std::size_t vertex_grain = 4096;

}  // namespace

Clustering::Clustering(const MeshView& mesh, double radius, Context& context) : mesh_(mesh), context_(context) {
  places_ = large_array<Place>(mesh.vertex_count());
  clusters_.of = large_array<Index>(mesh.vertex_count(), no_vertex);
  std::vector<Index> all;
  reserve_large(all, mesh.vertex_count());
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    if (mesh.faces_of(v).empty()) continue;
    clusters_.of[v] = 0;
    all.push_back(v);
  }
  seeds_.push_back({all.front(), 2 * radius});  // one cluster, which is split
  cluster(std::move(all));
}

void Clustering::split(const std::vector<bool>& which) {
  std::vector<Index> open;
  for (Index c = 0; c < clusters_.size(); ++c)
    for (const Index v : clusters_[c]) {
      places_[v].open = which[c];
      if (!which[c]) continue;
      places_[v] = {};
      open.push_back(v);
    }
  cluster(std::move(open));
}

void Clustering::cluster(std::vector<Index> open) {
  open = ranked(std::move(open));
  std::vector<Seed> seeds;
  for (const Index v : open) {
    if (places_[v].seed != no_vertex) continue;
    seeds.push_back({v, seeds_[clusters_.of[v]].radius / 2});
    grow(seeds.back());
  }
  connect(open);
  std::erase_if(seeds_, [&](const Seed& seed) { return places_[seed.vertex].open; });
  seeds_.insert(seeds_.end(), seeds.begin(), seeds.end());
  gather();
}

/// By a hash of their positions, and where these are the same by number.
std::vector<Index> Clustering::ranked(std::vector<Index> vertices) const {
  constexpr unsigned shift = 64 - 16;
  struct Ranked {
    std::uint64_t hash;
    Index vertex;
  };
  std::vector<Ranked> given = large_array<Ranked>(vertices.size()), sorted = large_array<Ranked>(vertices.size());
  context_.parallel_for(vertices.size(), vertex_grain, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) given[i] = {position_hash(mesh_.positions[vertices[i]]), vertices[i]};
  });
  std::vector<Index> offsets((std::size_t{1} << 16) + 1, 0);
  for (const Ranked& each : given) ++offsets[(each.hash >> shift) + 1];
  for (std::size_t b = 1; b < offsets.size(); ++b) offsets[b] += offsets[b - 1];
  std::vector<Index> next(offsets.begin(), offsets.end() - 1);
  for (const Ranked& each : given) sorted[next[each.hash >> shift]++] = each;
  context_.parallel_for(next.size(), vertex_grain, [&](std::size_t first, std::size_t last) {
    for (std::size_t b = first; b < last; ++b)
      std::sort(sorted.begin() + offsets[b], sorted.begin() + offsets[b + 1], [](const Ranked& x, const Ranked& y) {
        return std::tie(x.hash, x.vertex) < std::tie(y.hash, y.vertex);
      });
    for (std::size_t i = offsets[first]; i < offsets[last]; ++i) vertices[i] = sorted[i].vertex;
  });
  return vertices;
}

/// To the vertices of the ball that a walk from the seed reaches through vertices to which it is the nearest so far.
void Clustering::grow(const Seed& seed) {
  const Vec3 center = mesh_.positions[seed.vertex];
  const double per_squared = 1 / (seed.radius * seed.radius);
  places_[seed.vertex].seed = seed.vertex;
  places_[seed.vertex].squared = 0;
  reached_.assign(1, seed.vertex);
  for (std::size_t i = 0; i < reached_.size(); ++i)
    for (const Index q : mesh_.one_ring(reached_[i])) {
      Place& place = places_[q];
      if (place.seed == seed.vertex || !place.open) continue;
      const auto squared = static_cast<float>((mesh_.positions[q] - center).squaredNorm() * per_squared);
      if (squared >= std::min(place.squared, 1.0F)) continue;
      reached_.push_back(q);
      place.seed = seed.vertex;
      place.squared = squared;
    }
}

/// Whether each vertex of a cluster has a neighbour there that is nearer to the seed: then all hang together.
bool Clustering::leads_to_seed(Index v) const {
  const Place& here = places_[v];
  const auto ring = mesh_.one_ring(v);
  return here.seed == v || std::any_of(ring.begin(), ring.end(), [&](Index q) {
           return places_[q].seed == here.seed && places_[q].squared < here.squared;
         });
}

/// Those of these vertices that are not connected with their seed.
std::vector<Index> Clustering::apart(std::span<const Index> vertices) const {
  std::vector<char> leads(vertices.size());
  context_.parallel_for(vertices.size(), vertex_grain, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) leads[i] = leads_to_seed(vertices[i]) ? 1 : 0;
  });
  std::set<Index> doubtful;  // seeds
  for (std::size_t i = 0; i < leads.size(); ++i)
    if (leads[i] == 0) doubtful.insert(places_[vertices[i]].seed);
  if (doubtful.empty()) return {};
  std::vector<bool> connected(mesh_.vertex_count(), false);
  std::vector<Index> reached;
  for (const Index seed : doubtful) {
    reached.assign(1, seed);
    connected[seed] = true;
    for (std::size_t i = 0; i < reached.size(); ++i)
      for (const Index q : mesh_.one_ring(reached[i]))
        if (places_[q].seed == seed && !connected[q]) {
          connected[q] = true;
          reached.push_back(q);
        }
  }
  std::vector<Index> found;
  for (const Index v : vertices)
    if (!connected[v] && doubtful.contains(places_[v].seed)) found.push_back(v);
  return found;
}

/// Where the surface bends, or a later seed came between: vertices go where a neighbour went.
void Clustering::connect(std::span<const Index> vertices) {
  std::vector<Index> loose = apart(vertices);
  for (const Index v : loose) places_[v].seed = no_vertex;
  while (!loose.empty()) {
    std::vector<std::pair<Index, Index>> joined;  // a vertex and the seed that it goes to
    for (const Index v : loose) {
      std::optional<std::tuple<double, std::uint64_t, Index>> nearest;  // the hash decides where the grid is regular
      for (const Index q : mesh_.one_ring(v)) {
        const Index seed = places_[q].seed;
        if (seed == no_vertex) continue;
        const std::tuple to{(mesh_.positions[q] - mesh_.positions[v]).squaredNorm(),
                            position_hash(mesh_.positions[seed]), seed};
        if (!nearest || to < *nearest) nearest = to;
      }
      if (nearest) joined.emplace_back(v, std::get<Index>(*nearest));
    }
    for (const auto& [v, seed] : joined) places_[v].seed = seed;
    std::erase_if(loose, [&](Index v) { return places_[v].seed != no_vertex; });
  }
}

void Clustering::gather() {
  std::vector<Index> number = large_array<Index>(mesh_.vertex_count());
  for (Index c = 0; c < seeds_.size(); ++c) number[seeds_[c].vertex] = c;
  clusters_.offsets.assign(seeds_.size() + 1, 0);
  for (Index v = 0; v < number.size(); ++v) {
    if (places_[v].seed == no_vertex) continue;
    clusters_.of[v] = number[places_[v].seed];
    ++clusters_.offsets[clusters_.of[v] + 1];
  }
  for (std::size_t c = 1; c < clusters_.offsets.size(); ++c) clusters_.offsets[c] += clusters_.offsets[c - 1];
  clusters_.vertices = large_array<Index>(clusters_.offsets.back());
  std::vector<Index> next(clusters_.offsets.begin(), clusters_.offsets.end() - 1);
  for (Index v = 0; v < number.size(); ++v)
    if (places_[v].seed != no_vertex) clusters_.vertices[next[clusters_.of[v]]++] = v;
}

}  // namespace toposcope
