// SPDX-License-Identifier: BSD-3-Clause

// What tiles leave out is hidden or outside: drawn with and without them, triangles of all forms are the same to the
// bit.

#include "picture/depth_tiles.h"

#include <gtest/gtest.h>

#include "support/random.h"

namespace toposcope {
namespace {

constexpr int columns = 210, rows = 130;

template <class Real>
class Canvas {
 public:
  explicit Canvas(bool tiled) : tiled_(tiled) {}

  void draw(const DrawnTriangle<Real>& t, Real slack) {
    const auto reach = [](Real a, Real b, Real c, int most) {
      const auto inside = [&](Real x) { return static_cast<int>(std::clamp<Real>(x, 0, static_cast<Real>(most - 1))); };
      return std::pair(inside(std::min({a, b, c})), inside(std::max({a, b, c})));
    };
    const auto [left, right] = reach(t.ax, t.ax + t.bx, t.ax + t.cx, columns);
    const auto [top, bottom] = reach(t.ay, t.ay + t.by, t.ay + t.cy, rows);
    if (t.area() == 0) return;
    const auto piece = [&](const DrawnBox& box) {
      for (int y = box.top; y <= box.bottom; ++y)
        for (int x = box.left; x <= box.right; ++x) {
          ++looked_at;
          const Real dx = static_cast<Real>(x) - t.ax, dy = static_cast<Real>(y) - t.ay;
          const Real beta = (dx * t.cy - dy * t.cx) / t.area(), gamma = (t.bx * dy - t.by * dx) / t.area();
          if (beta < -slack || gamma < -slack || beta + gamma > 1 + slack) continue;
          float& here = at(x, y);
          here = std::max(here, static_cast<float>(t.value + beta * t.to_b + gamma * t.to_c));
        }
    };
    const DrawnBox box{left, right, top, bottom};
    if (tiled_)
      tiles_.visit(
          t, box, slack, [&](int x, int y) { return at(x, y); }, piece);
    else
      piece(box);
  }

  std::vector<float> depth = std::vector<float>(static_cast<std::size_t>(columns * rows), -1e30F);
  std::size_t looked_at = 0;

 private:
  float& at(int x, int y) { return depth[static_cast<std::size_t>(y * columns + x)]; }

  bool tiled_;
  DepthTiles tiles_{columns, rows, -1e30F};
};

template <class Real>
DrawnTriangle<Real> some_triangle(test::Random& random) {
  const auto number = [&](double low, double high) { return static_cast<Real>(random.uniform(low, high)); };
  const double size = random.chance(0.3) ? 1000 : random.chance(0.5) ? 150 : 20;
  DrawnTriangle<Real> t{number(-50, 260),    number(-50, 180),    number(-size, size),
                        number(-size, size), number(-size, size), number(-size, size),
                        number(0.1, 1),      number(-0.1, 0.1),   number(-0.1, 0.1)};
  if (random.chance(0.2)) t.cx = t.bx * number(0, 1) + number(-1e-3, 1e-3), t.cy = t.by * number(0, 1);  // a sliver
  if (random.chance(0.1)) t.cx = t.bx / 2, t.cy = t.by / 2 + number(-1e-5, 1e-5);
  return t;
}

template <class Real>
void expect_same_picture(Real slack) {
  std::size_t whole = 0, with = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    test::Random random(seed);
    Canvas<Real> plain(false), tiled(true);
    for (int i = 0; i < 150; ++i) {
      const DrawnTriangle<Real> t = some_triangle<Real>(random);
      plain.draw(t, slack);
      tiled.draw(t, slack);
    }
    EXPECT_EQ(plain.depth, tiled.depth) << seed;
    whole += plain.looked_at;
    with += tiled.looked_at;
  }
  EXPECT_LT(3 * with, whole) << "samples looked at";
}

TEST(DepthTiles, DrawTheSamePicture) {
  expect_same_picture<double>(1e-9);
  expect_same_picture<float>(1e-4F);
}

}  // namespace
}  // namespace toposcope
