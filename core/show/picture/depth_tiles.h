// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace toposcope {

/// A triangle on a grid of samples: where it covers which, and a value that is linear on it (depth, its inverse). In
/// `Real`, so that what is drawn is the same to the bit as without tiles.
template <class Real>
struct DrawnTriangle {
  Real ax, ay, bx, by, cx, cy;  ///< the first corner; the others from it
  Real value, to_b, to_c;       ///< at the first corner; and how it grows to the others
  Real area() const { return bx * cy - by * cx; }
};

/// The samples of a grid that a triangle may cover, ends included.
struct DrawnBox {
  int left, right, top, bottom;
};

/// A grid of depths cut into tiles that know what is the farthest in them, so that a large triangle behind others costs
/// a look at each tile and not at each sample (hierarchical depth, Greene et al. 1993). Greater values are nearer.
class DepthTiles {
 public:
  static constexpr int side = 16;

  DepthTiles(int columns, int rows, float nothing)
      : columns_(columns),
        across_((columns + side - 1) / side),
        farthest_(static_cast<std::size_t>(across_) * static_cast<std::size_t>((rows + side - 1) / side), nothing),
        stale_(farthest_.size(), 0),
        rows_(rows) {}

  /// Calls draw(box) for the pieces of `box`, tile by tile, where the triangle may be in front.
  /// \param slack  what weights of corners may lack for a sample to be covered
  /// \param depth  depth(x, y): what is drawn there so far
  template <class Real, class Depth, class Draw>
  void visit(const DrawnTriangle<Real>& triangle, const DrawnBox& box, Real slack, const Depth& depth,
             const Draw& draw) {
    if ((box.right - box.left) / side * ((box.bottom - box.top) / side) < few_tiles) {
      mark(box);
      return draw(box);
    }
    const Planes<Real> planes(triangle, box, slack);
    for (int y = box.top / side; y <= box.bottom / side; ++y) {
      const DrawnBox row =
          planes.covered({box.left, box.right, std::max(box.top, y * side), std::min(box.bottom, y * side + side - 1)});
      for (int x = row.left / side; x <= row.right / side && row.left <= row.right; ++x) {
        const DrawnBox piece{std::max(box.left, x * side), std::min(box.right, x * side + side - 1), row.top,
                             row.bottom};
        const auto tile = static_cast<std::size_t>(y) * static_cast<std::size_t>(across_) + static_cast<std::size_t>(x);
        if (stale_[tile]) renew(tile, x, y, depth);
        if (planes.nearest(piece) <= static_cast<Real>(farthest_[tile])) continue;
        stale_[tile] = 1;
        draw(piece);
      }
    }
  }

 private:
  static constexpr int few_tiles = 4;

  /// Linear functions on the grid, by how they grow from the triangle's first corner.
  template <class Real>
  class Planes {
   public:
    Planes(const DrawnTriangle<Real>& t, const DrawnBox& box, Real slack) : ax_(t.ax), ay_(t.ay) {
      const Real scale = 1 / t.area();
      const auto plane = [&](Real at_a, Real to_b, Real to_c) {
        return Plane{(to_b * t.cy - to_c * t.by) * scale, (to_c * t.bx - to_b * t.cx) * scale, at_a};
      };
      weights_ = {plane(1, -1, -1), plane(0, 1, 0), plane(0, 0, 1)};
      value_ = plane(t.value, t.to_b, t.to_c);
      // What rounding may take: what is left out must be outside or hidden for certain.
      const Real reach = std::max({far(box.left, box.right, t.ax), far(box.top, box.bottom, t.ay), std::abs(t.bx),
                                   std::abs(t.by), std::abs(t.cx), std::abs(t.cy)});
      room_ = slack + static_cast<Real>(1e-4) +
              16 * std::numeric_limits<Real>::epsilon() * reach * reach / std::abs(t.area());
      const Real growth = std::abs(t.to_b) + std::abs(t.to_c);
      margin_ = static_cast<Real>(1e-5) * (std::abs(t.value) + growth);
      value_.at += room_ * growth;
      corner_ = t.value + std::max({Real(0), t.to_b, t.to_c});
    }

    /// The part of a row of tiles that the triangle may cover; left > right: none.
    DrawnBox covered(DrawnBox row) const {
      for (const Plane& weight : weights_) {
        const Real rest = weight.at + weight.y * (static_cast<Real>(weight.y > 0 ? row.bottom : row.top) - ay_) + room_;
        const Real bound = ax_ - rest / weight.x;
        if (weight.x > 0 && bound > static_cast<Real>(row.left))
          row.left = bound < static_cast<Real>(row.right) ? static_cast<int>(bound) : row.right;
        else if (weight.x < 0 && bound < static_cast<Real>(row.right))
          row.right = bound > static_cast<Real>(row.left) ? static_cast<int>(bound) + 1 : row.left;
        else if (weight.x == 0 && rest < 0)
          row.right = row.left - 1;
      }
      return row;
    }

    /// No sample of a box is nearer than the plane there, nor than the nearest corner: of a triangle seen from the side
    /// the plane says little.
    Real nearest(const DrawnBox& box) const {
      const Real plane = value_.at + value_.x * (static_cast<Real>(value_.x > 0 ? box.right : box.left) - ax_) +
                         value_.y * (static_cast<Real>(value_.y > 0 ? box.bottom : box.top) - ay_);
      return std::min(plane, corner_) + margin_;
    }

   private:
    struct Plane {
      Real x = 0, y = 0, at = 0;
    };
    static Real far(int low, int high, Real from) {
      return std::max(std::abs(static_cast<Real>(low) - from), std::abs(static_cast<Real>(high) - from));
    }

    Real ax_, ay_, room_, margin_, corner_;
    std::array<Plane, 3> weights_;
    Plane value_;
  };

  void mark(const DrawnBox& box) {
    for (int y = box.top / side; y <= box.bottom / side; ++y)
      for (int x = box.left / side; x <= box.right / side; ++x)
        stale_[static_cast<std::size_t>(y) * static_cast<std::size_t>(across_) + static_cast<std::size_t>(x)] = 1;
  }

  template <class Depth>
  void renew(std::size_t tile, int x, int y, const Depth& depth) {
    float least = depth(x * side, y * side);
    for (int j = y * side; j < std::min(rows_, y * side + side); ++j)
      for (int i = x * side; i < std::min(columns_, x * side + side); ++i) least = std::min(least, depth(i, j));
    farthest_[tile] = least;
    stale_[tile] = 0;
  }

  int columns_, across_;
  std::vector<float> farthest_;
  std::vector<char> stale_;  ///< drawn on since
  int rows_;
};

}  // namespace toposcope
