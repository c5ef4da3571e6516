// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/flat_faces.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>

#include "mesh/fans.h"

namespace toposcope {
namespace {

/// Height over the longest side, as part of it: below this the corners lie on a line, to rounding.
constexpr double flat = 1e-10;

bool is_flat(const TriangleSoup& soup, Index f) {
  const auto& [a, b, c] = soup.triangles[f];
  const Vec3 u = soup.positions[b] - soup.positions[a], v = soup.positions[c] - soup.positions[a];
  return u.cross(v).norm() <= flat * std::max({u.squaredNorm(), v.squaredNorm(), (u - v).squaredNorm()});
}

class Flattener {
 public:
  Flattener(TriangleSoup& soup, std::vector<Index> flat_faces)
      : soup_(soup),
        gluing_(glue(soup.positions, soup.triangles, soup.triangles)),
        dropped_(soup.triangles.size(), false),
        work_(std::move(flat_faces)) {}

  FlatFaces run() {
    // A flip may leave a flat face beside, which another flip mends; each pass must mend some.
    for (std::size_t before = work_.size() + 1; !work_.empty() && work_.size() < before;) {
      before = work_.size();
      std::vector<Index> left;
      for (Index f : work_)
        if (!dropped_[f] && is_flat(soup_, f) && !mend(f)) left.push_back(f);
      result_.removed += static_cast<Index>(before - left.size());
      work_ = std::move(left);
    }
    result_.kept = static_cast<Index>(work_.size());
    if (result_.removed > 0) compact();
    return result_;
  }

 private:
  const Vec3& at(Index side) const { return soup_.positions[start(side)]; }
  Index start(Index side) const { return soup_.triangles[side / 3][side % 3]; }

  Index longest_side(Index f) const {
    const auto length = [&](Index side) { return (at(Gluing::next(side)) - at(side)).squaredNorm(); };
    return std::max({3 * f, 3 * f + 1, 3 * f + 2}, [&](Index a, Index b) { return length(a) < length(b); });
  }
  bool on_border(Index side) const { return gluing_.opposite[side] == Gluing::none; }

  bool mend(Index f) {
    const Index side = longest_side(f);
    return on_border(side) ? drop(f, side) : flip(side);
  }

  /// The border then runs through the corner between. It must not touch itself there.
  bool drop(Index f, Index side) {
    const Index right = Gluing::next(side), left = Gluing::last(side);
    if (!on_border(right) && !on_border(left) && apex_on_border(left)) return false;
    for (Index s : {right, left})
      if (!on_border(s)) gluing_.opposite[gluing_.opposite[s]] = Gluing::none;
    dropped_[f] = true;
    return true;
  }
  bool apex_on_border(Index side) const {
    for (Index s = side;;) {
      s = next_around(gluing_, s);
      if (s == Gluing::none) return true;
      if (s == side) return false;
    }
  }

  /// The faces abc and bad on both sides of ab become adc and dbc.
  bool flip(Index ab) {
    const Index ba = gluing_.opposite[ab], f = ab / 3, g = ba / 3;
    const Index a = start(ab), b = start(ba), c = start(Gluing::last(ab)), d = start(Gluing::last(ba));
    if (c == d || joined(Gluing::last(ab), d)) return false;
    const Index bc = gluing_.opposite[Gluing::next(ab)], ca = gluing_.opposite[Gluing::last(ab)];
    const Index ad = gluing_.opposite[Gluing::next(ba)], db = gluing_.opposite[Gluing::last(ba)];
    soup_.triangles[f] = {a, d, c};
    soup_.triangles[g] = {d, b, c};
    const auto join = [&](Index s, Index t) {
      gluing_.opposite[s] = t;
      if (t != Gluing::none) gluing_.opposite[t] = s;
    };
    join(3 * f, ad);
    join(3 * f + 2, ca);
    join(3 * g, db);
    join(3 * g + 1, bc);
    join(3 * f + 1, 3 * g + 2);
    soup_.face_origin[f] = soup_.face_origin[g];  // the flat one covered nothing
    return true;
  }
  /// Whether the vertex at which a side starts has an edge to another one.
  bool joined(Index side, Index vertex) const {
    Index begin = side;
    while (!on_border(begin)) {
      begin = Gluing::next(gluing_.opposite[begin]);
      if (begin == side) break;
    }
    for (Index s = begin;;) {
      if (start(Gluing::next(s)) == vertex || start(Gluing::last(s)) == vertex) return true;
      s = next_around(gluing_, s);
      if (s == Gluing::none || s == begin) return false;
    }
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
  std::vector<bool> dropped_;
  std::vector<Index> work_;
  FlatFaces result_;
};

}  // namespace

FlatFaces remove_flat_faces(TriangleSoup& soup) {
  std::vector<Index> flat_faces;
  for (Index f = 0; f < soup.triangles.size(); ++f)
    if (is_flat(soup, f)) flat_faces.push_back(f);
  if (flat_faces.empty()) return {};
  return Flattener(soup, std::move(flat_faces)).run();
}

}  // namespace toposcope
