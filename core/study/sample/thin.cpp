// SPDX-License-Identifier: BSD-3-Clause
#include "sample/thin.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "toposcope/geometry/half_edges.h"

namespace toposcope {

namespace {

/// Sum of squared distances from planes, weighted by area; symmetric, upper triangle.
struct Quadric {
  double xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0, x = 0, y = 0, z = 0, one = 0, area = 0;

  void add_plane(const Vec3& n, double d, double weight) {
    xx += weight * n.x() * n.x();
    xy += weight * n.x() * n.y();
    xz += weight * n.x() * n.z();
    yy += weight * n.y() * n.y();
    yz += weight * n.y() * n.z();
    zz += weight * n.z() * n.z();
    x += weight * n.x() * d;
    y += weight * n.y() * d;
    z += weight * n.z() * d;
    one += weight * d * d;
    area += weight;
  }
  void add(const Quadric& o) {
    xx += o.xx, xy += o.xy, xz += o.xz, yy += o.yy, yz += o.yz, zz += o.zz;
    x += o.x, y += o.y, z += o.z, one += o.one, area += o.area;
  }
  double mean_square(const Vec3& p) const {
    const double sum = xx * p.x() * p.x() + yy * p.y() * p.y() + zz * p.z() * p.z() +
                       2 * (xy * p.x() * p.y() + xz * p.x() * p.z() + yz * p.y() * p.z()) +
                       2 * (x * p.x() + y * p.y() + z * p.z()) + one;
    return area > 0 ? std::max(0.0, sum / area) : 0;
  }
};

class Thinning {
 public:
  explicit Thinning(const MeshView& mesh)
      : position_(mesh.positions), opposite_(opposite_half_edges(mesh)), live_(mesh.face_count()) {
    start_.reserve(3 * mesh.triangles.size());
    for (const Triangle& t : mesh.triangles) start_.insert(start_.end(), t.begin(), t.end());
    outgoing_.assign(position_.size(), no_index);
    mark_.assign(position_.size(), no_index);
    fixed_.assign(position_.size(), 0);
    quadric_.resize(position_.size());
    origin_ = mesh.box.center;
    for (Index h = 0; h < start_.size(); ++h) {
      outgoing_[start_[h]] = h;
      if (opposite_[h] == no_index) fixed_[start_[h]] = fixed_[end(h)] = 1;
    }
    for (Index f = 0; f < live_; ++f) {
      const Vec3 normal =
          normal_of(position_[start_[3 * f]], position_[start_[3 * f + 1]], position_[start_[3 * f + 2]]);
      const double size = normal.norm();
      area_ += size / 2;
      if (!(size > 0)) continue;
      const Vec3 n = normal / size;
      for (Index k = 0; k < 3; ++k)
        quadric_[start_[3 * f + k]].add_plane(n, -n.dot(position_[start_[3 * f]] - origin_), size);
    }
  }

  Index faces() const { return live_; }

  /// With a cost that is allowed to grow from pass to pass; within a pass in the vertices' order.
  void run(Index faces, Context& context) {
    const double edge = std::sqrt(4 / std::sqrt(3.0) * area_ / faces);
    longest_ = 1.5 * edge;
    for (double limit = 0.4 * edge; limit < 2 * edge && live_ > faces && !context.cancelled(); limit *= 1.12)
      for (Index v = 0; v < position_.size() && live_ > faces; ++v)
        if (outgoing_[v] != no_index && fixed_[v] == 0) draw_in(v, limit);
  }

  void hand_over(MeshSink& sink) const {
    std::vector<Index> number(position_.size(), no_index);
    std::vector<Vec3> positions;
    std::vector<Triangle> triangles;
    std::vector<Index> origin, kept;
    for (Index f = 0; f < start_.size() / 3; ++f) {
      if (start_[3 * f] == no_index) continue;
      Triangle& t = triangles.emplace_back();
      origin.push_back(f);
      for (Index k = 0; k < 3; ++k) {
        const Index v = start_[3 * f + k];
        if (number[v] == no_index) {
          number[v] = static_cast<Index>(positions.size());
          positions.push_back(position_[v]);
          kept.push_back(v);
        }
        t[k] = number[v];
      }
    }
    sink.set(positions, triangles, origin, kept);
  }

 private:
  Index end(Index h) const { return start_[next_half_edge(h)]; }
  static Vec3 normal_of(const Vec3& a, const Vec3& b, const Vec3& c) { return (b - a).cross(c - a); }

  /// Calls visit(h) for each half-edge that leaves v. \pre v is not on the border
  template <class Visit>
  void around(Index v, Visit visit) const {
    const Index first = outgoing_[v];
    Index h = first;
    do {
      visit(h);
      h = opposite_[previous_half_edge(h)];
    } while (h != first);
  }

  /// Draws v into the neighbour to which that costs least, if it costs at most `limit` and may be.
  void draw_in(Index v, double limit) {
    Index best = no_index;
    double least = limit;
    around(v, [&](Index h) {
      const Vec3& to = position_[end(h)];
      const double length = (to - position_[v]).norm();
      if (length >= least) return;
      const double cost = length + 10 * std::sqrt(quadric_[v].mean_square(to - origin_));
      if (cost >= least || !may_collapse(h)) return;
      least = cost;
      best = h;
    });
    if (best != no_index) collapse(best);
  }

  bool may_collapse(Index h) {
    const Index v = start_[h], w = end(h), g = opposite_[h];
    if (fixed_[w] != 0) return false;
    // Link condition; the far corners must keep three faces.
    int common = 0;
    around(v, [&](Index x) { mark_[end(x)] = v; });
    around(w, [&](Index x) { common += mark_[end(x)] == v; });
    around(v, [&](Index x) { mark_[end(x)] = no_index; });
    if (common != 2) return false;
    for (const Index side : {h, g}) {
      const Index far = start_[previous_half_edge(side)];
      if (fixed_[far] != 0) continue;
      int valence = 0;
      around(far, [&](Index) { ++valence; });
      if (valence <= 3) return false;
    }
    bool sound = true;
    const Vec3& to = position_[w];
    around(v, [&](Index x) {
      if (!sound || x == h || previous_half_edge(x) == g) return;
      const Vec3 &p = position_[end(x)], &q = position_[start_[previous_half_edge(x)]];
      const Vec3 before = normal_of(position_[v], p, q), after = normal_of(to, p, q);
      const double area = after.norm();
      const double squares = (p - to).squaredNorm() + (q - to).squaredNorm() + (p - q).squaredNorm();
      sound = (p - to).squaredNorm() < longest_ * longest_ && area * 2 * std::sqrt(3.0) > least_roundness * squares &&
              before.dot(after) > 0.5 * before.norm() * area;
    });
    return sound;
  }

  void collapse(Index h) {
    const Index v = start_[h], w = end(h), g = opposite_[h];
    around(v, [&](Index x) { start_[x] = w; });
    quadric_[w].add(quadric_[v]);
    outgoing_[v] = no_index;
    for (const Index side : {h, g}) {
      const Index from_far = opposite_[next_half_edge(side)], to_far = opposite_[previous_half_edge(side)];
      opposite_[from_far] = to_far;
      opposite_[to_far] = from_far;
      outgoing_[start_[from_far]] = from_far;
      outgoing_[w] = to_far;
    }
    for (const Index side : {h, g}) std::fill_n(start_.begin() + side / 3 * 3, 3, no_index);
    live_ -= 2;
  }

  static constexpr double least_roundness = 0.2;
  std::span<const Vec3> position_;
  std::vector<Index> start_, opposite_, outgoing_, mark_;
  std::vector<char> fixed_;
  std::vector<Quadric> quadric_;
  Vec3 origin_ = Vec3::Zero();
  Index live_ = 0;
  double area_ = 0, longest_ = 0;
};

}  // namespace

void Thin::apply(const MeshView& mesh, Context& context, MeshSink& sink) const {
  if (mesh.face_count() <= faces_) return;
  Thinning work(mesh);
  work.run(faces_, context);
  work.hand_over(sink);
}

}  // namespace toposcope
