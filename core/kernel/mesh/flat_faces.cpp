// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/flat_faces.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <deque>

#include "mesh/edge_set.h"
#include "mesh/gluing.h"
#include "toposcope/geometry/large_array.h"

namespace toposcope {
namespace {

/// Height over the longest side, as part of it: below this the corners lie on a line, to rounding.
constexpr double flat = 1e-10;

/// A flat face waits until the face beyond its longest side is not flat any more, for only then a flip leaves fewer
/// flat faces. Whoever is mended calls its neighbours: each face is looked at a few times, not once a pass.
class Flattener {
 public:
  Flattener(TriangleSoup& soup, const std::vector<Index>& flat_faces)
      : soup_(soup),
        gluing_(glue(soup.positions, soup.triangles, soup.triangles)),
        edges_(soup.triangles),
        dropped_(soup.triangles.size(), false),
        borders_(large_array<Index>(soup.positions.size())),
        queue_(flat_faces.begin(), flat_faces.end()),
        turns_left_(flat_faces.size()) {
    for (Index side = 0; side < gluing_.opposite.size(); ++side)
      if (on_border(side)) ++borders_[start(side)];
  }

  void run() {
    for (; !queue_.empty(); queue_.pop_front())
      if (const Index f = queue_.front(); !dropped_[f] && is_flat(f)) mend(f);
    compact();
  }

 private:
  bool is_flat(Index f) const { return toposcope::is_flat(soup_.positions, soup_.triangles[f]); }
  Index start(Index side) const { return soup_.triangles[side / 3][side % 3]; }
  Index end(Index side) const { return start(Gluing::next(side)); }
  bool on_border(Index side) const { return gluing_.opposite[side] == Gluing::none; }

  Index longest_side(Index f) const {
    const auto length = [&](Index side) { return (soup_.positions[end(side)] - soup_.positions[start(side)]).norm(); };
    return std::max({3 * f, 3 * f + 1, 3 * f + 2}, [&](Index a, Index b) { return length(a) < length(b); });
  }

  void mend(Index f) {
    const Index side = longest_side(f);
    if (on_border(side))
      drop(side);
    else
      flip(side);
  }

  /// The border then runs through the corner between. It must not touch itself there.
  void drop(Index side) {
    const Index right = Gluing::next(side), left = Gluing::last(side);
    if (!on_border(right) && !on_border(left) && borders_[start(left)] > 0) return;
    for (Index s : {side, right, left})
      if (on_border(s)) {
        --borders_[start(s)];
        edges_.erase(start(s), end(s));
      } else {
        const Index other = gluing_.opposite[s];
        gluing_.opposite[other] = Gluing::none;
        ++borders_[start(other)];
        queue_.push_back(other / 3);
      }
    dropped_[side / 3] = true;
  }

  /// The faces abc and bad on both sides of ab become adc and dbc.
  void flip(Index ab) {
    const Index ba = gluing_.opposite[ab], f = ab / 3, g = ba / 3;
    const Index a = start(ab), b = start(ba), c = start(Gluing::last(ab)), d = start(Gluing::last(ba));
    const Triangle adc = {a, d, c}, dbc = {d, b, c};
    if (c == d || edges_.contains(c, d)) return;
    const bool both_flat = is_flat(g);
    const int left = toposcope::is_flat(soup_.positions, adc) + toposcope::is_flat(soup_.positions, dbc);
    if (left > both_flat) {
      // Two flat faces back to back look away from each other once their edge is turned. Bounded, as all of a mesh may
      // lie on a line.
      if (!both_flat || longest_side(g) != ba || turns_left_ == 0) return;
      --turns_left_;
    }
    const Index bc = gluing_.opposite[Gluing::next(ab)], ca = gluing_.opposite[Gluing::last(ab)];
    const Index ad = gluing_.opposite[Gluing::next(ba)], db = gluing_.opposite[Gluing::last(ba)];
    soup_.triangles[f] = adc;
    soup_.triangles[g] = dbc;
    const auto join = [&](Index s, Index t) {
      gluing_.opposite[s] = t;
      if (t != Gluing::none) gluing_.opposite[t] = s;
    };
    join(3 * f, ad);
    join(3 * f + 2, ca);
    join(3 * g, db);
    join(3 * g + 1, bc);
    join(3 * f + 1, 3 * g + 2);
    edges_.erase(a, b);
    edges_.insert(c, d);
    if (!both_flat) soup_.face_origin[f] = soup_.face_origin[g];  // the flat one covered nothing
    for (Index s : {bc, ca, ad, db})
      if (s != Gluing::none) queue_.push_back(s / 3);
    if (left > 0) queue_.insert(queue_.end(), {f, g});
  }

  void compact() {
    std::size_t kept = 0;
    for (std::size_t f = 0; f < soup_.triangles.size(); ++f) {
      if (dropped_[f]) continue;
      soup_.triangles[kept] = soup_.triangles[f];
      soup_.face_origin[kept++] = soup_.face_origin[f];
    }
    soup_.triangles.resize(kept);
    soup_.face_origin.resize(kept);
  }

  TriangleSoup& soup_;
  Gluing gluing_;
  EdgeSet edges_;
  std::vector<bool> dropped_;
  std::vector<Index> borders_;  ///< border sides that start at each vertex
  std::deque<Index> queue_;     ///< faces that may be mended
  std::size_t turns_left_;      ///< of edges between two flat faces
};

std::vector<Index> flat_faces_of(const TriangleSoup& soup) {
  std::vector<Index> faces;
  for (Index f = 0; f < soup.triangles.size(); ++f)
    if (is_flat(soup.positions, soup.triangles[f])) faces.push_back(f);
  return faces;
}

}  // namespace

bool is_flat(const std::vector<Vec3>& positions, const Triangle& triangle) {
  const auto& [a, b, c] = triangle;
  const Vec3 u = positions[b] - positions[a], v = positions[c] - positions[a];
  return u.cross(v).norm() <= flat * std::max({u.squaredNorm(), v.squaredNorm(), (u - v).squaredNorm()});
}

FlatFaces remove_flat_faces(TriangleSoup& soup) {
  const std::vector<Index> found = flat_faces_of(soup);
  if (found.empty()) return {};
  Flattener(soup, found).run();
  const auto kept = static_cast<Index>(flat_faces_of(soup).size());
  return {static_cast<Index>(found.size()) - kept, kept};
}

}  // namespace toposcope
