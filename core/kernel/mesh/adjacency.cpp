// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/adjacency.h"

#include <algorithm>
#include <memory>
#include <numeric>
#include <utility>

#include "toposcope/geometry/large_array.h"

namespace toposcope {
namespace {

/// The neighbours of one vertex.
class Ring {
 public:
  Ring(std::span<const Triangle> triangles, const Rows& faces) : triangles_(triangles), faces_(faces) {}

  std::span<const Index> of(Index v) {
    next_.clear();
    last_.clear();
    for (Index i = faces_.offsets[v]; i < faces_.offsets[v + 1]; ++i) {
      const Triangle& t = triangles_[faces_.entries[i]];
      const std::size_t k = t[0] == v ? 0 : t[1] == v ? 1 : 2;
      insert(t[k == 2 ? 0 : k + 1]);
      last_.push_back(t[k == 0 ? 2 : k - 1]);
    }
    // Around an inner vertex of an oriented mesh each neighbour comes next after the vertex in one face: then that is
    // all.
    if (std::adjacent_find(next_.begin(), next_.end()) == next_.end() &&
        std::all_of(last_.begin(), last_.end(), [&](Index q) { return contains(q); }))
      return next_;
    next_.insert(next_.end(), last_.begin(), last_.end());
    std::sort(next_.begin(), next_.end());
    next_.erase(std::unique(next_.begin(), next_.end()), next_.end());
    return next_;
  }

 private:
  static constexpr std::size_t few = 16;  // up to which plain loops are fastest

  void insert(Index q) {
    next_.push_back(q);
    if (next_.size() > few) return;
    for (std::size_t i = next_.size() - 1; i > 0 && next_[i - 1] > q; --i) std::swap(next_[i - 1], next_[i]);
  }
  bool contains(Index q) const {
    return next_.size() <= few && std::find(next_.begin(), next_.end(), q) != next_.end();
  }

  std::span<const Triangle> triangles_;
  const Rows& faces_;
  std::vector<Index> next_, last_;
};

}  // namespace

void for_chunks(Context* context, std::size_t count, std::size_t grain,
                const std::function<void(std::size_t, std::size_t)>& body) {
  if (context) return context->parallel_for(count, grain, body);
  for (std::size_t first = 0; first < count; first += grain) body(first, std::min(first + grain, count));
}

Rows faces_around_vertices(std::size_t vertices, std::span<const Triangle> triangles, Context* context) {
  // Each part of the faces counts for itself; since the parts are in order, rows are ascending however many there are.
  const std::size_t parts = context && triangles.size() > 10000 ? std::min(context->threads(), 4U) : 1;
  const std::size_t part_size = (triangles.size() + parts - 1) / parts;
  std::vector<std::vector<Index>> place(parts);
  const auto for_each_part = [&](const auto& body) {
    for_chunks(context, triangles.size(), part_size, [&](std::size_t first, std::size_t last) {
      std::vector<Index>& own = place[first / part_size];
      body(own, first, last);
    });
  };
  for_each_part([&](std::vector<Index>& count, std::size_t first, std::size_t last) {
    count = large_array<Index>(vertices);
    for (std::size_t f = first; f < last; ++f)
      for (Index v : triangles[f]) ++count[v];
  });
  Rows rows;
  rows.offsets = large_array<Index>(vertices + 1);
  Index total = 0;
  for (std::size_t v = 0; v < vertices; ++v) {
    rows.offsets[v] = total;
    for (std::vector<Index>& own : place) total += std::exchange(own[v], total);
  }
  rows.offsets[vertices] = total;
  rows.entries = large_array<Index>(total);
  for_each_part([&](std::vector<Index>& next, std::size_t first, std::size_t last) {
    for (std::size_t f = first; f < last; ++f)
      for (Index v : triangles[f]) rows.entries[next[v]++] = static_cast<Index>(f);
  });
  return rows;
}

OneRings one_rings(std::span<const Vec3> positions, std::span<const Triangle> triangles, const Rows& faces,
                   Context* context, const std::function<void()>& beside) {
  constexpr std::size_t chunk_size = 8192;
  const std::size_t chunks = (positions.size() + chunk_size - 1) / chunk_size;
  std::vector<double> length(chunks, 0);
  // A vertex of k faces has at most 2 k neighbours: each chunk has room of its own for its rows, one after the other.
  const std::size_t most = 2 * faces.entries.size();
  const auto room = std::make_unique_for_overwrite<Index[]>(most);
  advise_huge_pages(room.get(), most * sizeof(Index));
  const auto room_of = [&](std::size_t chunk) {
    return room.get() + 2 * std::size_t{faces.offsets[chunk * chunk_size]};
  };
  OneRings rings;
  rings.rows.offsets = large_array<Index>(positions.size() + 1);
  for_chunks(context, chunks + 1, 1, [&](std::size_t task, std::size_t) {
    if (task == 0) return beside();  // first: it is the longest
    const std::size_t chunk = task - 1;
    Ring ring(triangles, faces);
    Index* out = room_of(chunk);
    for (std::size_t v = chunk * chunk_size; v < std::min((chunk + 1) * chunk_size, positions.size()); ++v) {
      const std::span<const Index> row = ring.of(static_cast<Index>(v));
      rings.rows.offsets[v + 1] = static_cast<Index>(row.size());
      out = std::copy(row.begin(), row.end(), out);
      for (Index q : row)
        if (q > v) length[chunk] += (positions[q] - positions[v]).norm();
    }
  });
  for (std::size_t v = 0; v < positions.size(); ++v) rings.rows.offsets[v + 1] += rings.rows.offsets[v];
  rings.rows.entries = large_array<Index>(rings.rows.offsets.back());
  for_chunks(context, chunks, 1, [&](std::size_t chunk, std::size_t) {
    const Index begin = rings.rows.offsets[chunk * chunk_size];
    const Index end = rings.rows.offsets[std::min((chunk + 1) * chunk_size, positions.size())];
    std::copy_n(room_of(chunk), end - begin, rings.rows.entries.begin() + begin);
  });
  rings.mean_edge =
      std::accumulate(length.begin(), length.end(), 0.0) / (static_cast<double>(rings.rows.entries.size()) / 2);
  return rings;
}

}  // namespace toposcope
