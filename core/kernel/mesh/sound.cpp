// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/sound.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "mesh/adjacency.h"
#include "mesh/flat_faces.h"
#include "mesh/position_hash.h"
#include "mesh/union_find.h"
#include "mesh/weld.h"
#include "toposcope/geometry/large_array.h"

namespace toposcope {
namespace {

constexpr std::size_t sound_grain = 1 << 14;
constexpr std::size_t most_components = 64;  // each part of the faces keeps sums of all
constexpr double clearly = 1e-6;             // sums in another order come to the same verdict

/// Sides of faces that no other face shares, from vertex to vertex as the faces turn.
using Border = std::vector<std::pair<Index, Index>>;

/// Whether all numbers below `count` pass.
template <class Test>
bool all_pass(Context* context, std::size_t count, const Test& test) {
  std::atomic<bool> all = true;
  for_chunks(context, count, sound_grain, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last && all; ++i)
      if (!test(static_cast<Index>(i))) all = false;
  });
  return all;
}

bool good_face(const TriangleSoup& soup, const Triangle& t) {
  const auto& [a, b, c] = t;
  return std::max({a, b, c}) < soup.positions.size() && a != b && b != c && c != a && !is_flat(soup.positions, t);
}

/// Whether no two positions are one.
bool apart(std::span<const Vec3> positions, Context* context) {
  constexpr unsigned shift = 64 - 8;
  std::vector<std::uint64_t> hashes = large_array<std::uint64_t>(positions.size()), sorted = hashes;
  for_chunks(context, positions.size(), sound_grain, [&](std::size_t first, std::size_t last) {
    for (std::size_t v = first; v < last; ++v) hashes[v] = position_hash(positions[v]);
  });
  std::vector<std::size_t> offsets((std::size_t{1} << 8) + 1, 0);
  for (const std::uint64_t hash : hashes) ++offsets[(hash >> shift) + 1];
  for (std::size_t b = 1; b < offsets.size(); ++b) offsets[b] += offsets[b - 1];
  std::vector<std::size_t> next(offsets.begin(), offsets.end() - 1);
  for (const std::uint64_t hash : hashes) sorted[next[hash >> shift]++] = hash;
  std::atomic<bool> all = true;
  for_chunks(context, next.size(), 1, [&](std::size_t b, std::size_t) {
    const auto begin = sorted.begin() + static_cast<std::ptrdiff_t>(offsets[b]);
    const auto end = sorted.begin() + static_cast<std::ptrdiff_t>(offsets[b + 1]);
    std::sort(begin, end);
    if (std::adjacent_find(begin, end) != end) all = false;
  });
  return all;
}

/// The faces around one vertex: where each begins and ends there.
class Fan {
 public:
  struct Corner {
    Index next, last;
  };
  /// \return whether they are one fan, closed or open, all turned alike
  bool read(std::span<const Triangle> triangles, std::span<const Index> faces, Index v) {
    corners_.clear();
    for (const Index f : faces) {
      const Triangle& t = triangles[f];
      const std::size_t k = t[0] == v ? 0 : t[1] == v ? 1 : 2;
      corners_.push_back({t[(k + 1) % 3], t[(k + 2) % 3]});
    }
    std::sort(corners_.begin(), corners_.end(), [](const Corner& a, const Corner& b) { return a.next < b.next; });
    for (std::size_t i = 1; i < corners_.size(); ++i)
      if (corners_[i].next == corners_[i - 1].next) return false;
    lasts_.clear();
    for (const Corner& corner : corners_) lasts_.push_back(corner.last);
    std::sort(lasts_.begin(), lasts_.end());
    if (std::adjacent_find(lasts_.begin(), lasts_.end()) != lasts_.end()) return false;
    begin = no_vertex;
    for (const Corner& corner : corners_)
      if (!std::binary_search(lasts_.begin(), lasts_.end(), corner.next)) begin = corner.next;
    // From the beginning, or from anywhere, all corners are met in a row.
    std::size_t met = 0;
    const Index first = begin == no_vertex ? corners_.front().next : begin;
    for (Index at = first;;) {
      const auto found = std::lower_bound(corners_.begin(), corners_.end(), at,
                                          [](const Corner& corner, Index to) { return corner.next < to; });
      if (found == corners_.end() || found->next != at) break;
      at = found->last;
      if (++met == corners_.size() || at == first) break;
    }
    return met == corners_.size() && (begin != no_vertex || met > 2);
  }

  Index begin = no_vertex;  ///< where an open fan begins: the border runs from the vertex to there

 private:
  std::vector<Corner> corners_;
  std::vector<Index> lasts_;
};

/// Where the border runs from each vertex that lies on it; nothing where a vertex has no fan or several.
std::optional<Border> border_of(const TriangleSoup& soup, const Rows& faces, Context* context) {
  std::vector<Border> parts((soup.positions.size() + sound_grain - 1) / sound_grain);
  std::atomic<bool> all = true;
  for_chunks(context, soup.positions.size(), sound_grain, [&](std::size_t first, std::size_t last) {
    Fan fan;
    for (Index v = static_cast<Index>(first); v < last && all; ++v) {
      const auto row = std::span(faces.entries).subspan(faces.offsets[v], faces.offsets[v + 1] - faces.offsets[v]);
      if (row.empty() || !fan.read(soup.triangles, row, v))
        all = false;
      else if (fan.begin != no_vertex)
        parts[first / sound_grain].emplace_back(v, fan.begin);
    }
  });
  if (!all) return std::nullopt;
  Border border;
  for (const auto& part : parts) border.insert(border.end(), part.begin(), part.end());
  return border;
}

/// As `repair` measures a component to tell its outside.
struct Measures {
  double volume = 0, area = 0, cone_area = 0;
  Vec3 border = Vec3::Zero();
  Index borders = 0;

  Measures& operator+=(const Measures& other) {
    volume += other.volume;
    area += other.area;
    return *this;
  }
  /// Whether its outside is outside, or it has none; not where it is close.
  bool clearly_right() const {
    constexpr double small_holes = 0.2;
    if (cone_area > small_holes * (1 + clearly) * area) return true;
    return cone_area < small_holes * (1 - clearly) * area && volume > clearly * area * std::sqrt(area);
  }
};

bool outside_out(const TriangleSoup& soup, const Border& border, std::span<const Index> component, Index count,
                 Context* context) {
  std::vector<Measures> all(count);
  std::vector<Vec3> center(count, Vec3::Zero());
  for (Index v = static_cast<Index>(component.size()); v-- > 0;) center[component[v]] = soup.positions[v];
  for (const auto& [from, to] : border) {
    Measures& measures = all[component[from]];
    measures.border += soup.positions[from];
    ++measures.borders;
  }
  for (Index c = 0; c < count; ++c)
    if (all[c].borders > 0) center[c] = all[c].border / all[c].borders;
  for (const auto& [from, to] : border) {
    const Vec3& middle = center[component[from]];
    all[component[from]].cone_area += (soup.positions[from] - middle).cross(soup.positions[to] - middle).norm() / 2;
  }
  std::vector<std::vector<Measures>> parts((soup.triangles.size() + sound_grain - 1) / sound_grain);
  for_chunks(context, soup.triangles.size(), sound_grain, [&](std::size_t first, std::size_t last) {
    std::vector<Measures>& part = parts[first / sound_grain];
    part.resize(count);
    for (std::size_t f = first; f < last; ++f) {
      const auto& [i, j, k] = soup.triangles[f];
      const Vec3& middle = center[component[i]];
      const Vec3 a = soup.positions[i] - middle, b = soup.positions[j] - middle, d = soup.positions[k] - middle;
      Measures& measures = part[component[i]];
      measures.volume += a.dot(b.cross(d)) / 6;
      measures.area += (b - a).cross(d - a).norm() / 2;
    }
  });
  for (const std::vector<Measures>& part : parts)
    for (Index c = 0; c < count; ++c) all[c] += part[c];
  return std::all_of(all.begin(), all.end(), [](const Measures& each) { return each.clearly_right(); });
}

/// Whether what is open is clearly open, not a seam.
bool no_seam(const TriangleSoup& soup, const Border& border, Context* context) {
  if (border.empty()) return true;
  std::vector<bool> open(soup.positions.size(), false);
  for (const auto& [from, to] : border) open[from] = true;
  std::vector<double> shortest((soup.triangles.size() + sound_grain - 1) / sound_grain,
                               std::numeric_limits<double>::infinity());
  for_chunks(context, soup.triangles.size(), sound_grain, [&](std::size_t first, std::size_t last) {
    double& least = shortest[first / sound_grain];
    for (std::size_t f = first; f < last; ++f)
      for (std::size_t k = 0; k < 3; ++k)
        least = std::min(
            least, (soup.positions[soup.triangles[f][k]] - soup.positions[soup.triangles[f][(k + 1) % 3]]).norm());
  });
  return first_at_near_place(soup.positions, open, *std::min_element(shortest.begin(), shortest.end())).joined == 0;
}

Index loops_of(const Border& border, std::size_t vertices) {
  std::vector<Index> next = large_array<Index>(vertices, no_vertex);
  for (const auto& [from, to] : border) next[from] = to;
  Index loops = 0;
  for (const auto& [start, to] : border) {
    if (next[start] == no_vertex) continue;
    ++loops;
    for (Index v = start; next[v] != no_vertex;) v = std::exchange(next[v], no_vertex);
  }
  return loops;
}

}  // namespace

std::optional<RepairReport> examine(const TriangleSoup& soup, Context* context) {
  const std::size_t vertices = soup.positions.size(), triangles = soup.triangles.size();
  // Of separate triangles nothing is sound.
  if (triangles == 0 || vertices < 3 || vertices > triangles + triangles / 2 + 2) return std::nullopt;
  if (!all_pass(context, vertices, [&](Index v) { return soup.positions[v].allFinite(); })) return std::nullopt;
  if (!all_pass(context, triangles, [&](Index f) { return good_face(soup, soup.triangles[f]); })) return std::nullopt;
  const std::optional<Border> border =
      border_of(soup, faces_around_vertices(vertices, soup.triangles, context), context);
  if (!border || !apart(soup.positions, context)) return std::nullopt;
  Index count = 0;
  const std::vector<Index> component = connected_vertices(vertices, soup.triangles, context, count);
  if (count > most_components || !outside_out(soup, *border, component, count, context) ||
      !no_seam(soup, *border, context))
    return std::nullopt;
  std::vector<bool> open(count, false);
  for (const auto& [from, to] : *border) open[component[from]] = true;
  RepairReport report;
  report.components = count;
  report.closed_components = static_cast<Index>(std::count(open.begin(), open.end(), false));
  report.border_edges = static_cast<Index>(border->size());
  report.holes = loops_of(*border, vertices);
  const auto edges = static_cast<long>((3 * triangles + border->size()) / 2);
  report.euler = static_cast<long>(vertices) - edges + static_cast<long>(triangles);
  report.genus = (2 * static_cast<long>(report.components) - report.holes - report.euler) / 2;
  return report;
}

}  // namespace toposcope
