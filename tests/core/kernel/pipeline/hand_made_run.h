// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// A run whose every number is known: rows of a flat grid as working sets, plugins that a hand can follow.

#include <atomic>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "mesh/mesh.h"
#include "pipeline/constructed_features.h"
#include "pipeline/measured_working_sets.h"
#include "pipeline/model_run.h"
#include "support/meshes.h"
#include "support/plugins.h"

namespace toposcope::test {

/// The mean of the points; each explains one mean edge.
struct MeanFitter : ShapeFitter {
  FittedShape fit(const FitInput& input, const Options&, Context&) const override {
    ++fits;
    const auto count = static_cast<double>(input.points.size());
    FittedShape shape;
    shape.summary.termination = Termination::closed_form;
    for (const Vec3& p : input.points) shape.centroid += p / count;
    shape.outline.assign(input.points.begin(), input.points.end());
    shape.rms = 0;
    shape.explained = count;
    return shape;
  }
  /// Along y.
  double distance(const FittedShape& shape, const Vec3& point) const override {
    return std::abs(point.y() - shape.centroid.y());
  }
  mutable std::atomic<int> fits = 0;
};

/// How far apart two features are along y; the tolerance is 2.
struct ApartTester : RelationTester {
  RelationResult test(const RelationInput& input, const Options&, Context&) const override {
    ++tests;
    RelationResult result;
    result.residual = std::abs(input.features[0].shape->centroid.y() - input.features[1].shape->centroid.y());
    result.tolerance = 2;
    result.clutter_density = 0.125;
    return result;
  }
  mutable std::atomic<int> tests = 0;
};

/// A grid of 4 x 9 quads, one apart: ten rows of five vertices.
struct HandMadeRun {
  HandMadeRun() : mesh(make_grid(4, 9, 4, 9), "grid") {
    sets.type_names = {"convex"};
    stations.probability = {.sample_spacing = 1,
                            .fit_error_scale = 1,
                            .unexplained_cost = 1,
                            .relation_exception = 0.01,
                            .certainty = 0.99,
                            .crisp = false,
                            .max_candidates = 100};
  }

  /// The first `count` vertices of a row.
  void add_set(int row, int count = 5) {
    const MeshView& view = mesh.view();
    for (Index v = 0; v < view.vertex_count(); ++v)
      if (std::abs(view.positions[v].y() + 4.5 - row) < 0.5 && view.positions[v].x() + 2 < count - 0.5)
        sets.vertices.push_back(v);
    sets.types.push_back(0);
    sets.saliency.push_back(1);
    sets.offsets.push_back(static_cast<Index>(sets.vertices.size()));
  }

  /// Of so many working sets.
  ModelFeature& add_feature(const std::string& name, std::size_t arity, std::shared_ptr<const ShapeFitter> fitter) {
    FeatureStation& station = stations.features.emplace_back();
    station.fitter = std::move(fitter);
    station.plugin = "mean";
    ModelFeature& feature = model.features.emplace_back();
    feature.name = name;
    feature.shape.plugin = "mean";
    feature.worksets.assign(arity, "convex");
    return feature;
  }

  Relationship& add_relationship(Index first, Index second, std::shared_ptr<const RelationTester> tester) {
    stations.relationships.push_back({std::move(tester), {}, "length", false});
    Relationship& relationship = model.relationships.emplace_back();
    relationship.name = "r" + std::to_string(model.relationships.size());
    relationship.plugin = "apart";
    relationship.features = {first, second};
    return relationship;
  }

  void measure() { sets = MeasuredWorkingSets(std::move(sets), {"convex"}, mesh.view(), context(2)); }
  ModelRun run() const { return {mesh.view(), model, stations, context(2)}; }

  static Expression expression(const char* text) { return Expression::parse(text, {"by hand", 1, 1}); }

  Mesh mesh;
  Model model;
  Stations stations;
  MeasuredWorkingSets sets;
};

}  // namespace toposcope::test
