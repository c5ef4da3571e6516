// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Sound plugins, one of each kind, each of whose parts can be broken by itself.

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

#include "toposcope/labeling/tools.h"
#include "toposcope/plugin.h"

namespace sound {

using namespace toposcope;

/// The centroid of the points, and how far they reach.
class Shape : public ShapeFitter {
 public:
  explicit Shape(const Options&) {}
  FittedShape fit(const FitInput& input, const Options&, Context&) const override {
    FittedShape shape;
    shape.summary = {Termination::degenerate, "no points", 0, 0, 0};
    if (input.points.empty() || !(input.mean_edge > 0)) return shape;
    const auto count = static_cast<double>(input.points.size());
    for (const Vec3& point : input.points) shape.centroid += (point - input.points[0]) / count;
    shape.centroid += input.points[0];
    double squares = 0;
    for (const Vec3& point : input.points) squares += (point - shape.centroid).squaredNorm();
    const double reach = std::sqrt(squares / count);
    if (!std::isfinite(reach)) return shape;
    shape.summary = {Termination::closed_form, "", 0, 0, 0};
    shape.measures = {{"reach", reach, reach / std::sqrt(count)}};
    shape.rms = 0;
    shape.explained = 1;
    return shape;
  }
  double distance(const FittedShape& shape, const Vec3& point) const override {
    return (point - shape.centroid).norm();
  }
};

/// Vertices nearer to the centroid than the mean.
class Classifier : public WorkingSetClassifier {
 public:
  explicit Classifier(const Options&) {}
  void classify(const MeshView& mesh, Context&, WorkingSetSink& sink) const override {
    give_components(mesh, chosen(mesh), sink);
  }

 protected:
  static std::vector<char> chosen(const MeshView& mesh) {
    Vec3 middle = Vec3::Zero();
    for (const Vec3& p : mesh.positions) middle += (p - mesh.positions[0]) / static_cast<double>(mesh.vertex_count());
    middle += mesh.positions[0];
    double mean = 0;
    for (const Vec3& p : mesh.positions) mean += (p - middle).norm() / static_cast<double>(mesh.vertex_count());
    std::vector<char> in(mesh.vertex_count());
    for (Index v = 0; v < in.size(); ++v) in[v] = (mesh.positions[v] - middle).norm() < mean;
    return in;
  }
  static void give_components(const MeshView& mesh, std::vector<char> in, WorkingSetSink& sink) {
    for (Index seed = 0; seed < in.size(); ++seed) {
      if (!in[seed]) continue;
      std::vector<Index> set = {seed};
      in[seed] = 0;
      for (std::size_t i = 0; i < set.size(); ++i)
        for (const Index neighbor : mesh.one_ring(set[i]))
          if (std::exchange(in[neighbor], 0)) set.push_back(neighbor);
      sink.add("near", set, 1);
    }
  }
};

/// Two features are near each other.
class Relation : public RelationTester {
 public:
  explicit Relation(const Options&) {}
  RelationResult test(const RelationInput& input, const Options&, Context&) const override {
    RelationResult result;
    const Vec3 apart = input.features[0].shape->centroid - input.features[1].shape->centroid;
    result.applicable = apart.allFinite();
    result.why = "a centroid that is not a number";
    if (!result.applicable) return result;
    result.residual = apart.norm();
    result.tolerance = 0.1 * input.object_box.diagonal();
    result.clutter_density = 1 / input.object_box.diagonal();
    return result;
  }
};

/// Everything is missing; where something may not be, nothing is said.
class Silence : public Labeler {
 public:
  explicit Silence(const Options&) {}
  LabelingOutcome solve(const LabelingProblem& problem, const LabelingRequest&, Context&) const override {
    LabelingOutcome outcome;
    outcome.guarantee = "none";
    for (const LabelingVariable& variable : problem.variables)
      if (std::any_of(variable.costs.begin(), variable.costs.end(), [](double c) { return std::isnan(c); }))
        throw std::invalid_argument("a cost that is not a number");
    outcome.labelings = all_missing(problem);
    return outcome;
  }
};

/// Gives the mesh back as it is.
class Filter : public MeshFilter {
 public:
  explicit Filter(const Options&) {}
  void apply(const MeshView& mesh, Context&, MeshSink& sink) const override {
    std::vector<Index> origin(mesh.face_count());
    std::iota(origin.begin(), origin.end(), Index{0});
    if (std::all_of(mesh.positions.begin(), mesh.positions.end(), [](const Vec3& p) { return p.allFinite(); }))
      sink.set(mesh.positions, mesh.triangles, origin, {});
  }
};

inline constexpr ProvidedName reach[] = {{"reach", 1, "root mean square distance of the points from their centroid"}};
inline constexpr ProvidedName near_type[] = {{"near", 0, "nearer to the centroid than the mean"}};

}  // namespace sound

#define BROKEN_SHAPE(id_, Class)                    \
  TOPOSCOPE_PLUGIN(ShapeFitter, Class,              \
                   {.id = id_,                      \
                    .version = "1.0.0",             \
                    .summary = "Broken on purpose", \
                    .min_arity = 1,                 \
                    .dimension = 0,                 \
                    .options = {},                  \
                    .provides = sound::reach})
#define BROKEN_WORKSETS(id_, Class)             \
  TOPOSCOPE_PLUGIN(WorkingSetClassifier, Class, \
                   {.id = id_, .version = "1.0.0", .summary = "Broken on purpose", .provides = sound::near_type})
