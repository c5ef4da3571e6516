// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/repair.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <span>
#include <utility>

#include "base/errors.h"
#include "mesh/clean.h"
#include "mesh/fans.h"
#include "mesh/flat_faces.h"
#include "mesh/gluing.h"
#include "mesh/orientation.h"
#include "toposcope/geometry/large_array.h"

namespace toposcope {
namespace {

/// Where sheets that were split stay together around both ends of an edge, their faces still share it by their numbers.
/// Such a face is taken out of its surroundings. \return how many were
Index isolate_faces(TriangleSoup& soup, const Fans& fans, Gluing& gluing) {
  std::vector<Triangle> numbered(soup.triangles.size());
  for (Index side = 0; side < fans.vertex.size(); ++side) numbered[side / 3][side % 3] = fans.vertex[side];
  std::vector<std::array<Index, 3>> edges;  // lesser end, greater end, side
  for (Index side = 0; side < fans.vertex.size(); ++side) {
    const auto [low, high] = std::minmax(fans.vertex[side], fans.vertex[Gluing::next(side)]);
    edges.push_back({low, high, side});
  }
  std::sort(edges.begin(), edges.end());
  Index isolated = 0;
  const auto starts_low = [&](const std::array<Index, 3>& e) { return fans.vertex[e[2]] == e[0]; };
  for (std::size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
    while (end < edges.size() && edges[end][0] == edges[begin][0] && edges[end][1] == edges[begin][1]) ++end;
    if (end - begin == 1 || (end - begin == 2 && starts_low(edges[begin]) != starts_low(edges[begin + 1]))) continue;
    for (std::size_t i = begin + 1; i < end; ++i) {
      ++isolated;
      for (Index k = 0; k < 3; ++k)
        if (Index& other = gluing.opposite[3 * (edges[i][2] / 3) + k]; other != Gluing::none)
          gluing.opposite[std::exchange(other, Gluing::none)] = Gluing::none;
    }
  }
  return isolated;
}

/// Compares the vertices that the faces have at each place with those that they need, place by place: which of them a
/// fan takes depends on the order of the vertices, how many are over or short does not.
void count_places(const TriangleSoup& soup, std::span<const Index> first, const Fans& fans, RepairReport& report) {
  std::vector<std::int32_t> balance = large_array<std::int32_t>(first.size());
  std::vector<bool> seen(fans.source.size(), false);
  const auto count = [&](Index vertex, Index place, int amount) {
    if (!seen[vertex]) balance[place] += amount;
    seen[vertex] = true;
  };
  for (const Triangle& t : soup.triangles)
    for (Index v : t) count(v, first[v], 1);
  seen.assign(seen.size(), false);
  for (Index v : fans.vertex) count(v, first[fans.source[v]], -1);
  for (const std::int32_t over : balance) (over > 0 ? report.merged_vertices : report.split_vertices) += std::abs(over);
}

/// Gives the corners their fans' vertices.
void renumber(TriangleSoup& soup, const Fans& fans) {
  for (Index side = 0; side < fans.vertex.size(); ++side) soup.triangles[side / 3][side % 3] = fans.vertex[side];
  for (std::size_t v = soup.positions.size(); v < fans.source.size(); ++v) {
    const Vec3 position = soup.positions[fans.source[v]];
    soup.positions.push_back(position);
  }
}

void remove_unreferenced(TriangleSoup& soup) {
  std::vector<bool> used(soup.positions.size(), false);
  for (const Triangle& t : soup.triangles)
    for (Index v : t) used[v] = true;
  if (std::find(used.begin(), used.end(), false) == used.end()) return;
  std::vector<Index> number = large_array<Index>(used.size());
  std::size_t kept = 0;
  for (std::size_t v = 0; v < used.size(); ++v) {
    if (!used[v]) continue;
    soup.positions[kept] = soup.positions[v];
    number[v] = static_cast<Index>(kept++);
  }
  soup.positions.resize(kept);
  for (Triangle& t : soup.triangles)
    for (Index& v : t) v = number[v];
}

void count_topology(const TriangleSoup& soup, const Gluing& gluing, const Components& components,
                    RepairReport& report) {
  report.components = components.count;
  std::vector<bool> open(components.count, false), traced(gluing.opposite.size(), false);
  Index edges = 0;
  for (Index side = 0; side < gluing.opposite.size(); ++side) {
    edges += gluing.opposite[side] == Gluing::none || side < gluing.opposite[side];
    if (gluing.opposite[side] != Gluing::none) continue;
    ++report.border_edges;
    open[components.of_face[side / 3]] = true;
    if (traced[side]) continue;
    ++report.holes;
    for (Index s = side; !traced[s];) {  // along the border
      traced[s] = true;
      for (s = Gluing::next(s); gluing.opposite[s] != Gluing::none;) s = Gluing::next(gluing.opposite[s]);
    }
  }
  report.closed_components = static_cast<Index>(std::count(open.begin(), open.end(), false));
  report.euler =
      static_cast<long>(soup.positions.size()) - static_cast<long>(edges) + static_cast<long>(soup.triangles.size());
  report.genus = (2 * static_cast<long>(report.components) - report.holes - report.euler) / 2;
}

RepairReport repair_once(TriangleSoup& soup, const std::string& name) {
  RepairReport report;
  auto [first, welded, gluing] = clean(soup, name, report);
  report.split_edges = gluing.split_edges;
  Components components = orient(soup.positions, welded, soup.triangles, gluing);
  report.turned_faces = components.turned_faces;
  report.cut_edges = components.cut_edges;
  Fans fans = separate_fans(soup.positions.size(), soup.triangles, gluing);
  if (report.split_edges + report.cut_edges > 0)
    while (const Index isolated = isolate_faces(soup, fans, gluing)) {
      report.isolated_faces += isolated;
      fans = separate_fans(soup.positions.size(), soup.triangles, gluing);
    }
  count_places(soup, first, fans, report);
  renumber(soup, fans);

  const FlatFaces flat = remove_flat_faces(soup);
  report.degenerate_faces += flat.removed;
  report.flat_faces = flat.kept;
  if (report.flat_faces == soup.triangles.size())
    throw MeshError(name + ": no face has an area, the corners of each lie on a line; export the surface again");
  remove_unreferenced(soup);
  report.unreferenced_vertices = static_cast<Index>(first.size()) + report.split_vertices - report.merged_vertices -
                                 report.non_finite_vertices - static_cast<Index>(soup.positions.size());
  // What was split or flipped hangs together in another way now.
  if (report.split_edges + report.cut_edges + flat.removed > 0) {
    gluing = glue(soup.positions, soup.triangles, soup.triangles);
    std::vector<Triangle> same = soup.triangles;
    components = orient(soup.positions, soup.triangles, same, gluing);
  }
  count_topology(soup, gluing, components, report);
  return report;
}

/// What is taken apart or flipped may leave what the next pass sees otherwise: an edge that has a partner now.
bool settled(const RepairReport& report) {
  return report.near_vertices + report.non_finite_faces + report.degenerate_faces + report.duplicate_faces +
             report.split_edges + report.isolated_faces + report.split_vertices + report.cut_edges ==
         0;
}

RepairReport without_changes(RepairReport report) {
  for (const auto count : change_counts) report.*count = 0;
  return report;
}

struct Surface {
  std::vector<Vec3> positions;
  std::vector<Triangle> triangles;
  bool is(const TriangleSoup& soup) const { return soup.positions == positions && soup.triangles == triangles; }
};

/// Two passes as one. What the mesh is like, the later one says.
RepairReport sum_of(const RepairReport& first, RepairReport later) {
  for (const auto count : change_counts) later.*count += first.*count;
  later.near_distance = std::max(first.near_distance, later.near_distance);
  return later;
}

}  // namespace

RepairReport repair(TriangleSoup& soup, const std::string& name) {
  constexpr int most_passes = 10;  // random soups need six
  const Surface given{soup.positions, soup.triangles};
  RepairReport report;
  for (int pass = 0; pass < most_passes; ++pass) {
    const Surface before{soup.positions, soup.triangles};
    const RepairReport more = repair_once(soup, name);
    const bool same = before.is(soup);
    // What was joined and taken apart again, as it was, is no change.
    report = sum_of(report, same ? without_changes(more) : more);
    if (same || settled(more)) return report;
  }
  // One soup in thousands goes round in circles: the least of the round stands for all of it.
  TriangleSoup least = soup;
  for (int pass = 0; pass < most_passes; ++pass) {
    const RepairReport more = repair_once(soup, name);
    if (soup.triangles > least.triangles) continue;
    least = soup;
    report = sum_of(report, without_changes(more));
  }
  soup = std::move(least);
  return given.is(soup) ? without_changes(report) : report;
}

}  // namespace toposcope
