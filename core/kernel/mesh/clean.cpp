// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/clean.h"

#include <algorithm>
#include <limits>
#include <span>
#include <utility>

#include "base/errors.h"
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

/// Vertices at open sides.
std::vector<bool> open_vertices(std::size_t vertices, std::span<const Triangle> welded, const Gluing& gluing) {
  std::vector<bool> open(vertices, false);
  for (Index side = 0; side < gluing.opposite.size(); ++side)
    if (gluing.opposite[side] == Gluing::none)
      for (Index s : {side, Gluing::next(side)}) open[welded[s / 3][s % 3]] = true;
  return open;
}

double shortest_edge(std::span<const Vec3> positions, std::span<const Triangle> welded) {
  double shortest = std::numeric_limits<double>::infinity();
  for (const auto& [a, b, c] : welded)
    for (const auto& [from, to] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)})
      shortest = std::min(shortest, (positions[from] - positions[to]).norm());
  return shortest;
}

/// Joins what is open and all but closed: corners that a program computed for each triangle anew.
void weld_near(TriangleSoup& soup, Cleaned& cleaned, RepairReport& report) {
  const std::vector<bool> open = open_vertices(soup.positions.size(), cleaned.welded, cleaned.gluing);
  if (std::find(open.begin(), open.end(), true) == open.end()) return;
  const NearPlaces near = first_at_near_place(soup.positions, open, shortest_edge(soup.positions, cleaned.welded));
  if (near.joined == 0) return;
  report.near_vertices = near.joined;
  report.near_distance = near.distance;
  for (Index& v : cleaned.first) v = near.first[v];
  for (Triangle& t : cleaned.welded)
    for (Index& v : t) v = near.first[v];
  drop_waste(soup, cleaned.welded, report);
  cleaned.gluing = glue(soup.positions, cleaned.welded, soup.triangles);
}

}  // namespace

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
    cleaned.first = first_at_same_place(soup.positions, open_vertices(soup.positions.size(), welded, cleaned.gluing));
    if (joins()) {
      for (Triangle& t : welded)
        for (Index& v : t) v = cleaned.first[v];
      drop_waste(soup, welded, report);
      cleaned.gluing = glue(soup.positions, welded, soup.triangles);
    }
  }
  weld_near(soup, cleaned, report);
  if (soup.triangles.empty())
    throw MeshError(name + ": every face has two corners at one place, nothing is left of the surface");
  return cleaned;
}

}  // namespace toposcope
