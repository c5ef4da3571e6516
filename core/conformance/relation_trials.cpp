// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "inputs.h"
#include "toposcope/geometry/lines.h"
#include "toposcope/geometry/point_sets.h"
#include "toposcope/relations.h"

namespace toposcope {
namespace {

/// A fitted shape and its points, made by hand.
struct Feature {
  FittedShape shape;
  std::vector<Vec3> points;
};

void add_vectors(FittedShape& shape, const std::string& name, const std::vector<Vec3>& list) {
  ShapeParameter& parameter = shape.parameters.emplace_back(ShapeParameter{name, 3, {}});
  for (const Vec3& v : list) parameter.values.insert(parameter.values.end(), {v.x(), v.y(), v.z()});
}

Feature ring(const Vec3& center, const Vec3& normal, double radius) {
  Feature feature;
  FittedShape& shape = feature.shape;
  const Vec3 u = any_perpendicular(normal), v = normal.cross(u);
  for (int i = 0; i < 80; ++i) {
    const double angle = 2 * pi * i / 80;
    shape.outline.push_back(center + radius * (std::cos(angle) * u + std::sin(angle) * v));
  }
  feature.points = shape.outline;
  shape.outline_closed = true;
  add_vectors(shape, "center", {center});
  add_vectors(shape, "normal", {normal});
  shape.parameters.push_back({"radius", 1, {radius}});
  shape.measures = {{"radius", radius, 0.004}};
  shape.orientation = Orientation::plane_like;
  shape.direction = normal;
  shape.centroid = center;
  return feature;
}

Feature segment(const Vec3& from, const Vec3& to) {
  Feature feature;
  FittedShape& shape = feature.shape;
  shape.outline = resample(std::vector<Vec3>{from, to}, 0.05);
  feature.points = shape.outline;
  add_vectors(shape, "endpoints", {from, to});
  shape.parameters.push_back({"closed", 1, {0}});
  shape.measures = {{"length", (to - from).norm(), 0.01}, {"length_1", (to - from).norm(), 0.01}};
  shape.orientation = Orientation::line_like;
  shape.direction = (to - from).normalized();
  shape.centroid = (from + to) / 2;
  return feature;
}

Feature patch(const Vec3& center, const Vec3& normal, double side) {
  Feature feature;
  FittedShape& shape = feature.shape;
  const Vec3 u = any_perpendicular(normal), v = normal.cross(u);
  for (int i = 0; i <= 12; ++i)
    for (int j = 0; j <= 9; ++j)
      feature.points.push_back(center + side * ((i / 12.0 - 0.5) * u + (j / 12.0 - 0.4) * v));
  const std::vector<Vec3> corners = {feature.points[0], feature.points[120], feature.points[129], feature.points[9],
                                     feature.points[0]};
  shape.outline = resample(corners, 0.05);
  shape.outline_closed = true;
  add_vectors(shape, "point", {center});
  add_vectors(shape, "normal", {normal});
  shape.measures = {{"extent", 1.25 * side, 0.05}, {"area", 0.75 * side * side, 0.05 * side}};
  shape.orientation = Orientation::plane_like;
  shape.direction = normal;
  shape.centroid = center;
  return feature;
}

void finish(Feature& feature) {
  FittedShape& shape = feature.shape;
  shape.summary = {Termination::converged, "made by hand", 1, 0.1, 0.01};
  shape.direction_sd = 0.02;
  shape.centroid_sd = 0.006;
  shape.rms = 0.01;
  shape.explained = 40;
}

Vec3 unit(double x, double y, double z) {
  return Vec3(x, y, z).normalized();
}

/// Lists of features; a relation takes as many of one as it asks for, around and around.
std::vector<std::pair<std::string, std::vector<Feature>>> scenes() {
  std::vector<std::pair<std::string, std::vector<Feature>>> all = {
      {"two rings and a segment",
       {ring({0, 0.02, 0.5}, unit(0.02, 0.01, 1), 0.4), ring({0.03, 0, -0.5}, unit(0, 0.03, 1), 0.42),
        segment({0.4, 0, 0.4}, {0.7, 0.05, -0.3})}},
      {"rings at an angle",
       {ring({0, 0, 0.5}, unit(0, 0.1, 1), 0.3), ring({0.6, 0.1, 0}, unit(1, 0.2, 0.1), 0.25),
        ring({-0.5, -0.4, 0.1}, unit(1, 1, 0.3), 0.31)}},
      {"segments",
       {segment({-0.7, -0.1, 0}, {0.1, 0.3, 0.05}), segment({0.7, -0.1, 0.02}, {-0.1, 0.33, 0.1}),
        segment({0, 0, -0.3}, {0.1, -0.1, 0.4})}},
      {"a patch, a ring and a segment",
       {patch({0.1, 0, -0.4}, unit(0.1, 0, 1), 0.7), ring({0, 0.1, 0.3}, unit(0.1, 0.2, 1), 0.35),
        segment({0, 0, -0.4}, {0.05, 0, 0.3})}}};
  for (auto& [name, features] : all)
    for (Feature& feature : features) finish(feature);
  return all;
}

Feature moved_feature(Feature feature, const Motion& motion) {
  FittedShape& shape = feature.shape;
  for (ShapeParameter& parameter : shape.parameters)
    for (std::size_t i = 0; parameter.columns == 3 && i < parameter.values.size(); i += 3) {
      const Vec3 old(parameter.values[i], parameter.values[i + 1], parameter.values[i + 2]);
      const Vec3 now = parameter.name == "normal" ? Vec3(motion.rotation * old) : motion(old);
      for (int k = 0; k < 3; ++k) parameter.values[i + static_cast<std::size_t>(k)] = now[k];
    }
  for (ShapeParameter& parameter : shape.parameters)
    if (parameter.name == "radius") parameter.values[0] *= motion.scale;
  for (Measure& measure : shape.measures) {
    const double by = measure.name == "area" ? motion.scale * motion.scale : motion.scale;
    measure.value *= by;
    measure.sd *= by;
  }
  for (auto* list : {&shape.outline, &feature.points})
    for (Vec3& p : *list) p = motion(p);
  shape.direction = motion.rotation * shape.direction;
  shape.centroid = motion(shape.centroid);
  shape.centroid_sd *= motion.scale;
  shape.rms *= motion.scale;
  if (motion.shuffle != 0) Random(motion.shuffle).shuffle(feature.points);
  return feature;
}

bool is_amount(double x) {
  return x >= 0 && std::isfinite(x);
}

class RelationTrial final : public Trial {
 public:
  RelationTrial(std::string called, std::vector<Feature> features, TriangleSoup soup, const PluginManifest& plugin)
      : Trial(std::move(called)),
        features_(std::move(features)),
        soup_(std::move(soup)),
        mesh_(soup_, name),
        plugin_(plugin) {
    for (const Feature& feature : features_) {
      bool finite = !feature.points.empty();
      for (const Vec3& p : feature.points) finite = finite && p.allFinite();
      operands_.push_back({&feature.shape, feature.points, finite ? oriented_box(feature.points) : Box{}});
    }
  }

  Answer run(const void* object, const Options& arguments, Context& context) const override {
    const MeshView& view = mesh_.view();
    auto result = std::make_shared<RelationResult>(static_cast<const RelationTester*>(object)->test(
        {operands_, view.box, view.mean_edge, &view}, arguments, context));
    Answer answer;
    append_bytes(answer.bytes, result->applicable);
    append_bytes(answer.bytes, std::array{result->residual, result->tolerance, result->sd, result->slack,
                                          result->clutter_density, result->samples, double(result->dof)});
    answer.flaw = flaw(*result);
    answer.value = std::move(result);
    return answer;
  }

  std::unique_ptr<Trial> moved(const Motion& motion) const override {
    std::vector<Feature> features;
    for (const Feature& feature : features_) features.push_back(moved_feature(feature, motion));
    return std::make_unique<RelationTrial>(name, std::move(features), toposcope::moved(soup_, motion), plugin_);
  }

  std::string change(const Answer& before, const Answer& after, const Motion& motion) const override {
    const auto& first = *static_cast<const RelationResult*>(before.value.get());
    const auto& second = *static_cast<const RelationResult*>(after.value.get());
    if (first.applicable != second.applicable)
      return fmt::format("for {}, it {} apply, and {} in the other", name, first.applicable ? "does" : "does not",
                         second.applicable ? "does" : "does not");
    if (!first.applicable) return "";
    const double length = plugin_.unit == "length" ? motion.scale : 1;
    const auto differ = [&](const char* what, double a, double b, double least) {
      if (std::abs(a - b) <= 1e-4 * (std::abs(a) + least)) return std::string();
      return fmt::format("for {}, the {} is {:.6g}, and {:.6g} in the other (in the input's unit)", name, what, a, b);
    };
    std::string text = differ("residual", first.residual, second.residual / length, first.tolerance);
    if (text.empty()) text = differ("tolerance", first.tolerance, second.tolerance / length, 0);
    if (text.empty()) text = differ("deviation", first.sd, second.sd / length, 0.1 * first.tolerance);
    if (text.empty() && first.residual > 0.01 * first.tolerance)
      text = differ("clutter density", first.clutter_density, second.clutter_density * std::pow(length, first.dof), 0);
    return text;
  }

 private:
  static std::string flaw(const RelationResult& result) {
    if (!result.applicable) return result.why.empty() ? "does not say in 'why' why it does not apply" : "";
    if (!is_amount(result.residual)) return fmt::format("gives the residual {}", result.residual);
    if (!(result.tolerance > 0) || !std::isfinite(result.tolerance))
      return fmt::format("gives the tolerance {}; it must be above 0", result.tolerance);
    if (!is_amount(result.sd)) return fmt::format("gives the deviation {}", result.sd);
    if (result.dof < 1) return fmt::format("gives {} degrees of freedom", result.dof);
    if (!is_amount(result.slack)) return fmt::format("gives the slack {}", result.slack);
    if (!is_amount(result.clutter_density)) return fmt::format("gives the clutter density {}", result.clutter_density);
    if (!(result.samples > 0) || !std::isfinite(result.samples)) return fmt::format("has {} samples", result.samples);
    return "";
  }

  std::vector<Feature> features_;
  TriangleSoup soup_;
  Mesh mesh_;
  const PluginManifest& plugin_;
  std::vector<RelationOperand> operands_;
};

}  // namespace

TrialSet relation_trials(const PluginManifest& plugin) {
  TrialSet set;
  set.nan_may_pass = true;
  const auto make = [&](std::string name, std::vector<Feature> features) {
    return std::make_unique<RelationTrial>(std::move(name), std::move(features), uneven_torus(32, 14), plugin);
  };
  const std::size_t arity = std::max(plugin.min_arity, 1U);
  const auto take = [&](const std::vector<Feature>& from) {
    std::vector<Feature> features;
    for (std::size_t i = 0; i < arity; ++i) features.push_back(from[i % from.size()]);
    return features;
  };
  for (auto& [name, features] : scenes()) {
    set.ordinary.push_back(make(name, take(features)));
    std::rotate(features.begin(), features.begin() + 2, features.end());
    set.ordinary.push_back(make(name + ", in another order", take(features)));
  }
  // The same feature twice; no points and no outline; no extent; a shape without direction, measures or parameters.
  Feature one = ring({0, 0, 0.2}, Vec3::UnitZ(), 0.4), bare = one, dot = ring({0, 0, 0.2}, Vec3::UnitZ(), 0), none;
  for (Feature* each : {&one, &bare, &dot}) finish(*each);
  bare.points.clear();
  bare.shape.outline.clear();
  none.shape.summary = one.shape.summary;
  set.degenerate.push_back(make("the same ring again and again", take({one})));
  set.degenerate.push_back(make("rings without points and outline", take({bare})));
  set.degenerate.push_back(make("rings of radius 0", take({dot})));
  set.degenerate.push_back(make("shapes that have nothing but a centroid", take({none})));
  set.degenerate.push_back(make("a ring and a shape that has nothing but a centroid", take({one, none})));
  Feature poisoned = one;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  poisoned.shape.centroid = poisoned.shape.direction = poisoned.points[0] = poisoned.shape.outline[0] =
      Vec3::Constant(nan);
  for (Measure& measure : poisoned.shape.measures) measure.value = nan;
  set.poisoned.push_back(make("rings at NaN", take({poisoned})));
  set.poisoned.push_back(make("a ring, and one at NaN", take({one, poisoned})));
  set.large.push_back(make(scenes()[0].first, take(scenes()[0].second)));
  return set;
}

}  // namespace toposcope
