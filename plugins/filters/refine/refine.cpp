// SPDX-License-Identifier: BSD-3-Clause
// Conforming subdivision of long edges: the splitting half of Johnson and Hebert's normalisation (dissertation 2.4.3).

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>
#include <string>
#include <vector>

#include "toposcope/plugin.h"

namespace {

using namespace toposcope;

constexpr Index none = std::numeric_limits<Index>::max();

struct Surface {
  std::vector<Vec3> positions;
  std::vector<Triangle> triangles;
  std::vector<Index> origin;

  double squared_length(Index a, Index b) const { return (positions[a] - positions[b]).squaredNorm(); }
};

// A side of a triangle that is to be split: its ends in ascending order, and where it occurs.
struct Side {
  Index low, high;
  std::size_t corner;  // 3 * triangle + the corner at which the side begins
};

double longest_squared(const Surface& surface) {
  double longest = 0;
  for (const Triangle& t : surface.triangles)
    for (std::size_t k = 0; k < 3; ++k) longest = std::max(longest, surface.squared_length(t[k], t[(k + 1) % 3]));
  return longest;
}

// Sides longer than the threshold, equal edges together.
std::vector<Side> long_sides(const Surface& surface, double threshold_squared) {
  std::vector<Side> sides;
  for (std::size_t f = 0; f < surface.triangles.size(); ++f)
    for (std::size_t k = 0; k < 3; ++k) {
      const Index a = surface.triangles[f][k], b = surface.triangles[f][(k + 1) % 3];
      // Both triangles of an edge must come to one verdict, so its length is taken from its ends in one order.
      const Index low = std::min(a, b), high = std::max(a, b);
      if (surface.squared_length(low, high) > threshold_squared) sides.push_back({low, high, 3 * f + k});
    }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return std::array<std::size_t, 3>{a.low, a.high, a.corner} < std::array<std::size_t, 3>{b.low, b.high, b.corner};
  });
  return sides;
}

// The triangles that replace one whose sides have these midpoints (`none` where a side stays whole).
void split(Surface& surface, const Triangle& t, const std::array<Index, 3>& middle, Index origin) {
  const auto add = [&](Index a, Index b, Index c) {
    surface.triangles.push_back({a, b, c});
    surface.origin.push_back(origin);
  };
  const auto count = 3 - std::count(middle.begin(), middle.end(), none);
  if (count == 0) {
    add(t[0], t[1], t[2]);
  } else if (count == 3) {
    for (std::size_t k = 0; k < 3; ++k) add(t[k], middle[k], middle[(k + 2) % 3]);
    add(middle[0], middle[1], middle[2]);
  } else if (count == 1) {
    const std::size_t k = middle[0] != none ? 0 : (middle[1] != none ? 1 : 2);
    const Index a = t[k], b = t[(k + 1) % 3], c = t[(k + 2) % 3];
    add(a, middle[k], c);
    add(middle[k], b, c);
  } else {
    // Sides ab and bc are split at p and q: a corner triangle, and a quadrangle a p q c cut along its shorter diagonal.
    const std::size_t whole = middle[0] == none ? 0 : (middle[1] == none ? 1 : 2);
    const Index c = t[whole], a = t[(whole + 1) % 3], b = t[(whole + 2) % 3];
    const Index p = middle[(whole + 1) % 3], q = middle[(whole + 2) % 3];
    add(p, b, q);
    if (surface.squared_length(a, q) < surface.squared_length(c, p)) {
      add(a, p, q);
      add(a, q, c);
    } else {
      add(a, p, c);
      add(p, q, c);
    }
  }
}

void split_all(Surface& surface, const std::vector<Side>& sides) {
  std::vector<Index> middle_of(3 * surface.triangles.size(), none);
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const Side& side = sides[i];
    if (i == 0 || side.low != sides[i - 1].low || side.high != sides[i - 1].high)
      surface.positions.push_back((surface.positions[side.low] + surface.positions[side.high]) / 2);
    middle_of[side.corner] = static_cast<Index>(surface.positions.size() - 1);
  }
  const std::vector<Triangle> triangles = std::move(surface.triangles);
  const std::vector<Index> origin = std::move(surface.origin);
  surface.triangles.clear();
  surface.origin.clear();
  surface.triangles.reserve(triangles.size() + sides.size());
  surface.origin.reserve(triangles.size() + sides.size());
  for (std::size_t f = 0; f < triangles.size(); ++f)
    split(surface, triangles[f], {middle_of[3 * f], middle_of[3 * f + 1], middle_of[3 * f + 2]}, origin[f]);
}

class Refine final : public MeshFilter {
 public:
  explicit Refine(const Options& options)
      : max_edge_(options.real("max_edge")), max_faces_(static_cast<std::size_t>(options.integer("max_faces"))) {}

  void apply(const MeshView& mesh, Context& context, MeshSink& sink) const override {
    const double limit = max_edge_ * mesh.box.diagonal();
    Surface surface;
    surface.positions.assign(mesh.positions.begin(), mesh.positions.end());
    surface.triangles.assign(mesh.triangles.begin(), mesh.triangles.end());
    surface.origin.resize(mesh.triangles.size());
    for (Index f = 0; f < mesh.face_count(); ++f) surface.origin[f] = f;

    bool changed = false;
    for (double longest = longest_squared(surface); longest > limit * limit && !context.cancelled();
         longest = longest_squared(surface)) {
      // The longest first: whenever the budget ends the refinement, the lengths are as even as they could be.
      const std::vector<Side> sides = long_sides(surface, std::max(limit * limit, longest / 4));
      if (surface.triangles.size() + sides.size() > max_faces_) {
        context.log(LogLevel::warning,
                    "refine: stopped at " + std::to_string(surface.triangles.size()) + " faces, the next pass would " +
                        "make " + std::to_string(surface.triangles.size() + sides.size()) + " and max_faces is " +
                        std::to_string(max_faces_) + "; the longest edge is still " +
                        std::to_string(std::sqrt(longest) / mesh.box.diagonal()) +
                        " diagonals; raise max_faces or max_edge");
        break;
      }
      split_all(surface, sides);
      changed = true;
    }
    if (!changed) return;
    // Vertices of the input come first and stay where they are.
    std::vector<Index> vertex_origin(surface.positions.size(), no_vertex);
    std::iota(vertex_origin.begin(), vertex_origin.begin() + mesh.vertex_count(), Index{0});
    sink.set(surface.positions, surface.triangles, surface.origin, vertex_origin);
  }

 private:
  double max_edge_;  // of the box diagonal
  std::size_t max_faces_;
};

constexpr OptionSpec options[] = {
    {"max_edge", OptionType::real, "diagonals", "0.02", "0.001", "1", "no edge stays longer than this"},
    {"max_faces", OptionType::integer, "", "400000", "1", "100000000",
     "refinement stops before it makes more faces than this"},
};

}  // namespace

TOPOSCOPE_PLUGIN(MeshFilter, Refine,
                 {.id = "refine",
                  .version = "1.0.0",
                  .summary = "Splits long edges at their midpoints until none is longer than a limit",
                  .citation = "Neal 1999, section 2.4.3 (edge-split of Johnson and Hebert)",
                  .options = options})
