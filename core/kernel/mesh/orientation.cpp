// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/orientation.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "toposcope/geometry/large_array.h"

namespace toposcope {
namespace {

/// Holes count as small up to this area of the cones that close them, as part of the surface's.
constexpr double small_holes = 0.2;
/// Cavities are looked for up to this many faces visited, as a multiple of the mesh's.
constexpr double most_visits = 64;

struct Component {
  Index first = 0, count = 0;  ///< in the order of discovery
  Index turned = 0;            ///< against the first face
  Index borders = 0;
  Vec3 center = Vec3::Zero();  ///< of the border; of the first face where there is none
  double volume = 0;           ///< signed, as the first face is oriented, closed by cones to the centre
  double area = 0, cone_area = 0;
  Vec3 low = Vec3::Zero(), high = Vec3::Zero();

  bool decidable() const { return cone_area <= small_holes * area && std::abs(volume) > 0; }
};

class Orienter {
 public:
  Orienter(std::span<const Vec3> positions, std::span<Triangle> triangles, Gluing& gluing)
      : positions_(positions), triangles_(triangles), gluing_(gluing), turned_(triangles.size(), false) {
    components_.of_face = large_array<Index>(triangles.size(), Gluing::none);
    order_.reserve(triangles.size());
  }

  /// Which faces to turn; components and cuts are recorded.
  const std::vector<bool>& decide() {
    for (Index f = 0; f < triangles_.size(); ++f)
      if (components_.of_face[f] == Gluing::none) discover(f);
    for (Component& c : found_) measure(c);
    for (const Component& c : found_)
      if (should_turn(c)) turn(c);
    for (const bool turned : turned_) components_.turned_faces += turned;
    components_.count = static_cast<Index>(found_.size());
    return turned_;
  }
  Components take_components() { return std::move(components_); }

 private:
  Index start(Index side) const { return triangles_[side / 3][side % 3]; }
  /// Whether glued sides run alike, so that one of their faces lies wrong.
  bool run_alike(Index a, Index b) const { return start(a) == start(b); }

  void discover(Index seed) {
    Component component;
    component.first = static_cast<Index>(order_.size());
    const Index label = static_cast<Index>(found_.size());
    components_.of_face[seed] = label;
    order_.push_back(seed);
    for (std::size_t i = component.first; i < order_.size(); ++i)
      for (Index k = 0; k < 3; ++k) {
        const Index side = 3 * order_[i] + k, other = gluing_.opposite[side];
        if (other == Gluing::none) continue;
        const bool turn = turned_[order_[i]] != run_alike(side, other);
        Index& other_label = components_.of_face[other / 3];
        if (other_label == Gluing::none) {
          other_label = label;
          turned_[other / 3] = turn;
          order_.push_back(other / 3);
        } else if (turned_[other / 3] != turn) {
          gluing_.opposite[side] = gluing_.opposite[other] = Gluing::none;
          ++components_.cut_edges;
        }
      }
    component.count = static_cast<Index>(order_.size()) - component.first;
    found_.push_back(component);
  }

  std::span<const Index> faces_of(const Component& c) const { return std::span(order_).subspan(c.first, c.count); }

  void measure(Component& c) {
    Vec3 border = Vec3::Zero();
    c.low = c.high = positions_[triangles_[order_[c.first]][0]];
    for (Index f : faces_of(c)) {
      c.turned += turned_[f];
      for (Index k = 0; k < 3; ++k) {
        c.low = c.low.cwiseMin(positions_[triangles_[f][k]]);
        c.high = c.high.cwiseMax(positions_[triangles_[f][k]]);
        if (gluing_.opposite[3 * f + k] != Gluing::none) continue;
        ++c.borders;
        border += positions_[triangles_[f][k]];
      }
    }
    c.center = c.borders > 0 ? Vec3(border / c.borders) : positions_[triangles_[order_[c.first]][0]];
    for (Index f : faces_of(c)) {
      const auto& [i, j, k] = triangles_[f];
      const Vec3 a = positions_[i] - c.center, b = positions_[j] - c.center, d = positions_[k] - c.center;
      const double volume = a.dot(b.cross(d)) / 6;
      c.volume += turned_[f] ? -volume : volume;
      c.area += (b - a).cross(d - a).norm() / 2;
      for (Index s = 0; s < 3; ++s)
        if (gluing_.opposite[3 * f + s] == Gluing::none) {
          const Vec3 p = positions_[triangles_[f][s]] - c.center, q = positions_[triangles_[f][(s + 1) % 3]] - c.center;
          c.cone_area += p.cross(q).norm() / 2;
        }
    }
  }

  bool should_turn(const Component& c) {
    if (!c.decidable()) return 2 * c.turned > c.count;
    const bool inside_out = c.volume < 0;
    if (inside_out && c.turned == 0 && c.borders == 0 && lies_within_another(c)) return false;  // a cavity
    return inside_out;
  }
  void turn(const Component& c) {
    for (Index f : faces_of(c)) turned_[f] = !turned_[f];
  }

  bool lies_within_another(const Component& c) {
    const Vec3& point = positions_[triangles_[order_[c.first]][0]];
    for (const Component& other : found_) {
      if (&other == &c || other.borders > 0 || !((other.low.array() <= c.low.array()).all()) ||
          !((other.high.array() >= c.high.array()).all()))
        continue;
      visits_ += other.count;
      if (visits_ > most_visits * static_cast<double>(triangles_.size())) return false;
      if (std::abs(winding_number(other, point)) > 0.5) return true;
    }
    return false;
  }

  /// How often the surface goes around a point (van Oosterom and Strackee 1983).
  double winding_number(const Component& c, const Vec3& point) const {
    double angle = 0;
    for (Index f : faces_of(c)) {
      const auto& [i, j, k] = triangles_[f];
      const Vec3 a = positions_[i] - point, b = positions_[j] - point, d = positions_[k] - point;
      const double la = a.norm(), lb = b.norm(), ld = d.norm();
      const double solid =
          2 * std::atan2(a.dot(b.cross(d)), la * lb * ld + a.dot(b) * ld + b.dot(d) * la + d.dot(a) * lb);
      angle += turned_[f] ? -solid : solid;
    }
    return angle / (4 * pi);
  }

  std::span<const Vec3> positions_;
  std::span<const Triangle> triangles_;
  Gluing& gluing_;
  std::vector<bool> turned_;
  Components components_;
  std::vector<Index> order_;  ///< faces, component by component
  std::vector<Component> found_;
  double visits_ = 0;
};

}  // namespace

Components orient(std::span<const Vec3> positions, std::span<Triangle> triangles, std::span<Triangle> mirrored,
                  Gluing& gluing) {
  Orienter orienter(positions, triangles, gluing);
  const std::vector<bool>& turned = orienter.decide();
  if (std::find(turned.begin(), turned.end(), true) != turned.end()) {
    // Of a face turned over, sides 0 and 2 exchange their places.
    const auto renamed = [&](Index side) {
      if (side == Gluing::none || !turned[side / 3] || side % 3 == 1) return side;
      return side % 3 == 0 ? side + 2 : side - 2;
    };
    std::vector<Index> opposite(gluing.opposite.size());
    for (Index side = 0; side < opposite.size(); ++side) opposite[renamed(side)] = renamed(gluing.opposite[side]);
    gluing.opposite = std::move(opposite);
    for (std::size_t f = 0; f < triangles.size(); ++f)
      if (turned[f]) {
        std::swap(triangles[f][1], triangles[f][2]);
        std::swap(mirrored[f][1], mirrored[f][2]);
      }
  }
  return orienter.take_components();
}

}  // namespace toposcope
