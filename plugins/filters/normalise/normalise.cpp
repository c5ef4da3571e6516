// SPDX-License-Identifier: BSD-3-Clause
// Control of mesh resolution after Johnson and Hebert (dissertation 2.4.3): edges of even length, the shape kept.

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <string>

#include "resampler.h"
#include "toposcope/plugin.h"

namespace {

using namespace toposcope;
using namespace toposcope::normalise;

constexpr Index most_faces = 100000000;
// Of a mesh at work, with its samples.
constexpr double bytes_per_face = 400;
// Times the faces that there are and that are wanted. Long faces of CAD need a dozen times as many, before collapses.
constexpr double most_at_work = 64;
// Length over width from which a face is a needle.
constexpr double needle = 4;
// Rounds that may be added while there are too many faces.
constexpr int more_rounds = 20;
// Of a mesh whose edges are longer than the surface has room for.
constexpr double fewest_faces = 4;
// Of the squared diagonal: needles and folded faces have no edges of any wanted length.
constexpr double least_area = 1e-8;
// Changes are measured at samples; between them the shape may have changed somewhat more.
constexpr double at_samples = 0.7;

class Normalise final : public MeshFilter {
 public:
  explicit Normalise(const Options& options)
      : edge_(options.real("edge")),
        faces_(static_cast<Index>(options.integer("faces"))),
        max_change_(options.real("max_change")),
        shape_weight_(options.real("shape_weight")),
        crease_angle_(options.real("crease_angle") * pi / 180),
        rounds_(options.integer("rounds")) {
    if (edge_ > 0 && faces_ > 0)
      throw std::invalid_argument("edge and faces both set a resolution: give one of them, 0 for the other");
  }

  void apply(const MeshView& mesh, Context& context, MeshSink& sink) const override {
    Goal goal = make_goal(mesh);
    if (!(goal.edge * goal.edge * goal.faces > least_area * mesh.box.diagonal() * mesh.box.diagonal())) {
      context.log(LogLevel::warning, "normalise: the surface has no area to speak of; it is left alone");
      return;
    }
    // A surface that is thinner than the wanted edge has no room for the fewest faces: the edge stays what was asked
    // for.
    if (faces_ == 0 && goal.faces <= fewest_faces) goal.edge = wanted_edge(mesh);
    if (faces_ == 0)
      require_memory(mesh, goal.edge, context);
    else
      keep_in_proportion(mesh, goal, context);
    const InputSurface surface(mesh, crease_angle_, goal.edge);
    // The shape changes by no more than the number of faces demands: at first collapses by a tenth of an edge, flips
    // and moves by half of that.
    Limits limits{1.5 * goal.edge, std::min(goal.max_change, 0.1 * goal.edge), 0.2};
    Resampler work(surface, goal, limits.change / 2);
    work.split_long(4.0 / 3 * goal.edge, most_faces, context);
    work.carry_samples(context);
    int left = rounds_;
    for (int round = 0; left > 0 && round < rounds_ + more_rounds && !context.cancelled(); ++round) {
      context.progress(static_cast<double>(round) / (rounds_ + 1));
      work.collapse(goal.faces, limits, context);
      work.split_long(0, goal.faces - 1, context);
      work.flip(context);
      if (context.cancelled()) return;  // of millions of faces the rest takes minutes
      work.relax(context);
      if (work.mesh().faces() > goal.faces && round > 0) {
        limits = {std::min(1.1 * limits.longest, 2 * goal.edge), std::min(1.25 * limits.change, goal.max_change),
                  std::max(0.8 * limits.roundness, 0.05)};
        work.set_free_change(limits.change / 2);
        left = std::max(left, 3);
      } else {
        --left;
      }
      if (left == rounds_ / 2 && faces_ == 0) {
        // Edges that vary are longer in the mean than equal ones on the same area.
        const double ratio = work.mean_edge() / wanted_edge(mesh);
        goal.faces = face_count(goal.faces * ratio * ratio);
      }
      if (left > 2) work.split_long(1.4 * goal.edge, 2 * goal.faces, context);
    }
    if (context.cancelled()) return;
    if (work.mesh().faces() > 1.03 * goal.faces)
      context.log(
          LogLevel::warning,
          "normalise: stopped at " + std::to_string(work.mesh().faces()) + " faces, not " + std::to_string(goal.faces) +
              "; fewer would change the shape by more than max_change or change the topology; raise max_change");
    hand_over(work.mesh(), mesh, context, sink);
  }

 private:
  double wanted_edge(const MeshView& mesh) const { return edge_ > 0 ? edge_ * mesh.box.diagonal() : mesh.mean_edge; }

  Goal make_goal(const MeshView& mesh) const {
    double area = 0;
    for (const Triangle& t : mesh.triangles) {
      const Vec3& a = mesh.positions[t[0]];
      area += (mesh.positions[t[1]] - a).cross(mesh.positions[t[2]] - a).norm() / 2;
    }
    Goal goal{faces_, 0, at_samples * max_change_ * mesh.box.diagonal(), shape_weight_};
    const double edge = wanted_edge(mesh);
    if (faces_ == 0) goal.faces = face_count(4 / std::sqrt(3.0) * area / (edge * edge));
    goal.edge = std::sqrt(4 / std::sqrt(3.0) * area / goal.faces);
    return goal;
  }

  /// What may be no number, or none that an index holds, may be no count.
  static Index face_count(double wanted) {
    if (!(wanted > fewest_faces)) return static_cast<Index>(fewest_faces);
    return wanted < most_faces ? static_cast<Index>(std::round(wanted)) : most_faces;
  }

  /// Splits of long edges come before all collapses. A face needs as many as its area asks for. A needle needs more:
  /// its longest edge cut in the middle leaves one half and two of its length, and so three for each halving.
  static double faces_at_work(const MeshView& mesh, double edge) {
    double faces = 0;
    for (const Triangle& t : mesh.triangles) {
      const Vec3 &a = mesh.positions[t[0]], &b = mesh.positions[t[1]], &c = mesh.positions[t[2]];
      const double longest = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
      const double area = (b - a).cross(c - a).norm() / 2;
      const double width = std::max(edge, 2 * area / longest);  // down to it a needle is cut as one
      const double needles = longest > needle * width ? std::pow(longest / width, std::log2(3.0)) : 1;
      faces += std::max(1 + 4 / std::sqrt(3.0) * area / (edge * edge), needles * (width / edge) * (width / edge));
    }
    return faces;
  }

  /// A number of faces says nothing of the length: a thin surface has little area for so many, and the edges that they
  /// would have fit a multitude of times into its length. Such a surface gets longer edges.
  static void keep_in_proportion(const MeshView& mesh, Goal& goal, Context& context) {
    const auto held = static_cast<double>(context.memory_budget()) / bytes_per_face;
    if (goal.faces > held) {
      context.log(LogLevel::warning, "normalise: memory holds about " + std::to_string(face_count(held)) +
                                         " faces at work, not " + std::to_string(goal.faces) + "; so many are made");
      const Index fewer = face_count(held);
      goal.edge *= std::sqrt(static_cast<double>(goal.faces) / fewer);
      goal.faces = fewer;
    }
    const double most = std::min(held, most_at_work * (static_cast<double>(goal.faces) + mesh.face_count()));
    while (faces_at_work(mesh, goal.edge) > most && goal.edge < mesh.box.diagonal()) goal.edge *= 1.25;
  }

  static void require_memory(const MeshView& mesh, double edge, const Context& context) {
    const double faces = faces_at_work(mesh, edge);
    if (faces <= most_faces && faces * bytes_per_face <= static_cast<double>(context.memory_budget())) return;
    char needed[96];
    std::snprintf(needed, sizeof needed, "about %.3g faces and %.3g bytes", faces, faces * bytes_per_face);
    throw std::runtime_error("edges of the wanted length need " + std::string(needed) + ", and this run may take " +
                             std::to_string(most_faces) + " faces and " + std::to_string(context.memory_budget()) +
                             " bytes; give a longer edge or fewer faces");
  }

  static void hand_over(const SurfaceMesh& mesh, const MeshView& input, Context& context, MeshSink& sink) {
    std::vector<Vec3> positions;
    std::vector<Triangle> triangles;
    std::vector<Index> number(mesh.position.size(), no_index);
    for (Index v = 0; v < mesh.position.size(); ++v)
      if (mesh.outgoing[v] != no_index) {
        number[v] = static_cast<Index>(positions.size());
        positions.push_back(mesh.position[v]);
      }
    for (Index f = 0; f < mesh.face_slots(); ++f)
      if (mesh.is_face(f))
        triangles.push_back({number[mesh.start[3 * f]], number[mesh.start[3 * f + 1]], number[mesh.start[3 * f + 2]]});
    sink.set(positions, triangles, nearest_faces(input, positions, triangles, context), {});
  }

  double edge_;  // of the box diagonal; 0: not set
  Index faces_;  // 0: not set
  double max_change_;
  double shape_weight_;
  double crease_angle_;
  int rounds_;
};

constexpr OptionSpec options[] = {
    {"edge", OptionType::real, "diagonals", "0", "0", "1", "edge length that is aimed at; 0: not set"},
    {"faces", OptionType::integer, "", "0", "0", "100000000", "number of faces that is aimed at; 0: not set"},
    {"max_change", OptionType::real, "diagonals", "0.02", "0", "1",
     "no part of the input comes farther from the result than this"},
    {"shape_weight", OptionType::real, "", "10", "0", "1000",
     "how much a change of the shape counts against an edge's length in the order of collapses"},
    {"crease_angle", OptionType::real, "deg", "60", "1", "180", "edges whose faces turn by more are kept as creases"},
    {"rounds", OptionType::integer, "", "10", "0", "100", "rounds of flips and relaxation"},
};

}  // namespace

TOPOSCOPE_PLUGIN(MeshFilter, Normalise,
                 {.id = "normalise",
                  .version = "1.0.0",
                  .summary = "Even edge lengths at a wanted resolution, the shape kept",
                  .citation = "Johnson and Hebert 1998; Neal 1999, section 2.4.3",
                  .options = options})
