// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/repair.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstdlib>
#include <utility>

#include "base/errors.h"
#include "mesh/fans.h"
#include "mesh/flat_faces.h"
#include "mesh/gluing.h"
#include "mesh/orientation.h"
#include "mesh/weld.h"
#include "toposcope/geometry/large_array.h"

namespace toposcope {
namespace {

/// Faces of whose corners so many are not finite are no scan with holes but a damaged file.
constexpr double most_non_finite = 0.5;

/// Keeps the faces that `keep` accepts, in order.
template <class Keep>
Index drop_faces(TriangleSoup& soup, std::vector<Triangle>& welded, const Keep& keep) {
  std::size_t kept = 0;
  for (std::size_t f = 0; f < soup.triangles.size(); ++f) {
    if (!keep(static_cast<Index>(f))) continue;
    soup.triangles[kept] = soup.triangles[f];
    soup.face_origin[kept] = soup.face_origin[f];
    welded[kept++] = welded[f];
  }
  const auto dropped = static_cast<Index>(soup.triangles.size() - kept);
  soup.triangles.resize(kept);
  soup.face_origin.resize(kept);
  welded.resize(kept);
  return dropped;
}

/// For each face whether an earlier one has the same corners. Faces with equal corners meet in the row of the least.
std::vector<bool> find_duplicates(std::span<const Triangle> welded, std::size_t vertices) {
  std::vector<Index> offsets = large_array<Index>(vertices + 1);
  const auto sorted = [&](Index f) {
    Triangle t = welded[f];
    std::sort(t.begin(), t.end());
    return t;
  };
  const auto least = [&](Index f) { return std::min({welded[f][0], welded[f][1], welded[f][2]}); };
  for (Index f = 0; f < welded.size(); ++f) ++offsets[least(f) + 1];
  for (std::size_t v = 1; v < offsets.size(); ++v) offsets[v] += offsets[v - 1];
  std::vector<Index> row = large_array<Index>(welded.size()), place = offsets;
  for (Index f = 0; f < welded.size(); ++f) row[place[least(f)]++] = f;
  std::vector<bool> duplicate(welded.size(), false);
  std::vector<std::pair<Triangle, Index>> faces;
  for (std::size_t v = 0; v + 1 < offsets.size(); ++v) {
    if (offsets[v + 1] - offsets[v] < 2) continue;
    faces.clear();
    for (Index i = offsets[v]; i < offsets[v + 1]; ++i) faces.emplace_back(sorted(row[i]), row[i]);
    std::sort(faces.begin(), faces.end());
    for (std::size_t i = 1; i < faces.size(); ++i)
      if (faces[i].first == faces[i - 1].first) duplicate[faces[i].second] = true;
  }
  return duplicate;
}

/// The faces by the places of their corners, and how they hang together.
struct Cleaned {
  std::vector<Index> first;      ///< for each vertex the one that stands for its place
  std::vector<Triangle> welded;  ///< corners by these
  Gluing gluing;
};

/// Drops faces of which two corners are one, and all but the first of those with equal corners.
void drop_waste(TriangleSoup& soup, std::vector<Triangle>& welded, RepairReport& report) {
  report.degenerate_faces += drop_faces(soup, welded, [&](Index f) {
    const auto& [a, b, c] = welded[f];
    return a != b && b != c && c != a;
  });
  const std::vector<bool> duplicate = find_duplicates(welded, soup.positions.size());
  report.duplicate_faces += drop_faces(soup, welded, [&](Index f) { return !duplicate[f]; });
}

/// Connected faces, by their glued sides.
std::vector<Index> label_components(const Gluing& gluing, Index& count) {
  std::vector<Index> label = large_array<Index>(gluing.opposite.size() / 3, Gluing::none);
  std::vector<Index> faces;
  count = 0;
  for (Index seed = 0; seed < label.size(); ++seed) {
    if (label[seed] != Gluing::none) continue;
    label[seed] = count;
    faces.assign(1, seed);
    for (std::size_t i = 0; i < faces.size(); ++i)
      for (Index side = 3 * faces[i]; side < 3 * faces[i] + 3; ++side)
        if (const Index other = gluing.opposite[side]; other != Gluing::none && label[other / 3] == Gluing::none) {
          label[other / 3] = count;
          faces.push_back(other / 3);
        }
    ++count;
  }
  return label;
}

/// Drops components all of whose faces lie where other components' earlier faces lie: an object that was exported
/// twice. \return whether there were any
bool drop_repeated_components(TriangleSoup& soup, Cleaned& cleaned, std::span<const Index> place,
                              RepairReport& report) {
  Index count = 0;
  const std::vector<Index> label = label_components(cleaned.gluing, count);
  if (count < 2) return false;
  std::vector<Triangle> placed;
  for (const auto& [a, b, c] : soup.triangles) placed.push_back({place[a], place[b], place[c]});
  const std::vector<bool> duplicate = find_duplicates(placed, soup.positions.size());
  std::vector<bool> repeated(count, true);
  for (Index f = 0; f < label.size(); ++f)
    if (!duplicate[f]) repeated[label[f]] = false;
  const Index dropped = drop_faces(soup, cleaned.welded, [&](Index f) { return !repeated[label[f]]; });
  report.duplicate_faces += dropped;
  return dropped > 0;
}

/// Drops faces that are not there, twice there or not finite, and joins vertices at one place where the surface is
/// open: seams and separate triangles close, and what is closed already stays as it is.
Cleaned clean(TriangleSoup& soup, const std::string& name, RepairReport& report) {
  std::vector<bool> finite(soup.positions.size());
  for (std::size_t v = 0; v < finite.size(); ++v) {
    finite[v] = soup.positions[v].allFinite();
    report.non_finite_vertices += !finite[v];
  }
  Cleaned cleaned;
  std::vector<Triangle>& welded = cleaned.welded;
  welded = soup.triangles;
  const auto input_faces = static_cast<double>(soup.triangles.size());
  if (report.non_finite_vertices > 0)
    report.non_finite_faces = drop_faces(soup, welded, [&](Index f) {
      return std::all_of(welded[f].begin(), welded[f].end(), [&](Index v) { return finite[v]; });
    });
  if (report.non_finite_faces > most_non_finite * input_faces)
    throw MeshError(name + ": " + std::to_string(report.non_finite_faces) +
                    " faces have a corner that is not a finite number; the file is damaged, export it again");
  drop_waste(soup, welded, report);
  cleaned.gluing = glue(soup.positions, welded, soup.triangles);

  cleaned.first = first_at_same_place(soup.positions, std::vector<bool>(soup.positions.size(), true));
  const auto joins = [&] {
    for (Index v = 0; v < cleaned.first.size(); ++v)
      if (cleaned.first[v] != v) return true;
    return false;
  };
  if (joins()) {
    if (drop_repeated_components(soup, cleaned, cleaned.first, report))
      cleaned.gluing = glue(soup.positions, welded, soup.triangles);
    std::vector<bool> open(soup.positions.size(), false);
    for (Index side = 0; side < cleaned.gluing.opposite.size(); ++side)
      if (cleaned.gluing.opposite[side] == Gluing::none)
        for (Index s : {side, Gluing::next(side)}) open[welded[s / 3][s % 3]] = true;
    cleaned.first = first_at_same_place(soup.positions, open);
    if (joins()) {
      for (Triangle& t : welded)
        for (Index& v : t) v = cleaned.first[v];
      drop_waste(soup, welded, report);
      cleaned.gluing = glue(soup.positions, welded, soup.triangles);
    }
  }
  if (soup.triangles.empty())
    throw MeshError(name + ": every face has two corners at one place, nothing is left of the surface");
  return cleaned;
}

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

}  // namespace

bool RepairReport::changed() const {
  return merged_vertices + unreferenced_vertices + non_finite_vertices + non_finite_faces + degenerate_faces +
             duplicate_faces + split_edges + isolated_faces + split_vertices + turned_faces + cut_edges >
         0;
}

RepairReport repair(TriangleSoup& soup, const std::string& name) {
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

}  // namespace toposcope
