// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "point_sets.h"
#include "toposcope/geometry/lines.h"
#include "toposcope/geometry/point_sets.h"
#include "toposcope/shapes.h"

namespace toposcope {
namespace {

/// A fit, and the distances of some points from it.
struct Fitted {
  FittedShape shape;
  std::vector<double> distances;
};

/// Not negative, not infinite, a number.
bool is_amount(double x) {
  return x >= 0 && std::isfinite(x);
}

class ShapeTrial final : public Trial {
 public:
  ShapeTrial(PointSets points, const PluginManifest& plugin)
      : Trial(points.name),
        points_(std::move(points)),
        plugin_(plugin),
        areas_(points_.points.size(), 0),
        curvature_(points_.points.size(), points_.mean_edge) {
    const auto box_of = [](std::span<const Vec3> set) {
      for (const Vec3& p : set)
        if (!p.allFinite()) return Box{};
      return set.empty() ? Box{} : oriented_box(set);
    };
    for (double& area : areas_) area = points_.mean_edge * points_.mean_edge;
    const std::span<const Vec3> all = points_.points;
    for (std::size_t k = 0; k + 1 < points_.offsets.size(); ++k)
      boxes_.push_back(box_of(all.subspan(points_.offsets[k], points_.offsets[k + 1] - points_.offsets[k])));
    box_ = box_of(all);
  }

  Answer run(const void* object, const Options& arguments, Context& context) const override {
    const auto& fitter = *static_cast<const ShapeFitter*>(object);
    auto fitted = std::make_shared<Fitted>();
    Box object_box = box_;
    for (double& side : object_box.sides) side *= 1.5;
    fitted->shape =
        fitter.fit({points_.points, areas_, points_.offsets, boxes_, box_, object_box, points_.mean_edge, curvature_},
                   arguments, context);
    if (fitted->shape.summary.usable())
      for (std::size_t i = 0; i < points_.points.size(); i += 1 + points_.points.size() / 16)
        fitted->distances.push_back(fitter.distance(fitted->shape, points_.points[i]));
    Answer answer;
    answer.bytes = bytes(*fitted);
    answer.flaw = flaw(*fitted, fitter, arguments);
    answer.value = std::move(fitted);
    return answer;
  }

  std::unique_ptr<Trial> moved(const Motion& motion) const override {
    return std::make_unique<ShapeTrial>(toposcope::moved(points_, motion), plugin_);
  }

  std::string change(const Answer& before, const Answer& after, const Motion& motion) const override {
    const FittedShape& first = static_cast<const Fitted*>(before.value.get())->shape;
    const FittedShape& second = static_cast<const Fitted*>(after.value.get())->shape;
    // What is not this shape has no best fit; which of many is found may hang on the last bit.
    if (first.summary.usable() && !(first.rms <= points_.mean_edge)) return "";
    if (first.summary.usable() != second.summary.usable())
      return fmt::format("{} {} fitted, and {} in the other", name, first.summary.usable() ? "is" : "is not",
                         second.summary.usable() ? "is" : "is not");
    if (!first.summary.usable()) return "";
    const auto differ = [&](const std::string& what, double a, double b, double scale, double sd) {
      if (std::abs(a - b / scale) <= 1e-4 * std::abs(a) + 0.1 * sd) return std::string();
      return fmt::format("of {}, {} is {:.6g}, and {:.6g} in the other (in the input's unit)", name, what, a,
                         b / scale);
    };
    const double s = motion.scale, size = 1e-4 * box_.diagonal();
    for (const Measure& measure : first.measures) {
      const ProvidedRow* row = plugin_.find_provided(measure.name);
      const Measure* other = second.measure(measure.name);
      if (other == nullptr) return fmt::format("of {}, measure '{}' is not given in the other", name, measure.name);
      const double unit = std::pow(s, row ? row->dimension : 0);
      if (auto text = differ(measure.name, measure.value, other->value, unit, measure.sd); !text.empty()) return text;
    }
    if (const double off = (motion(first.centroid) - second.centroid).norm() / s; off > size + 0.1 * first.centroid_sd)
      return fmt::format("of {}, the centroid does not move with the points: it is {:.3g} off", name, off);
    if (first.orientation != second.orientation) return fmt::format("of {}, the orientation is another", name);
    if (first.orientation != Orientation::none)
      if (const double angle = line_angle(motion.rotation * first.direction, second.direction);
          angle > 1e-4 + 0.1 * first.direction_sd)
        return fmt::format("of {}, the direction does not turn with the points: it is {:.3g} deg off", name,
                           angle * 180 / pi);
    return differ("rms", first.rms, second.rms, s, 0.01 * points_.mean_edge);
  }

 private:
  static std::string bytes(const Fitted& fitted) {
    const FittedShape& shape = fitted.shape;
    std::string result;
    append_bytes(result, shape.summary.termination);
    for (const ShapeParameter& parameter : shape.parameters) {
      append_bytes(result, parameter.name);
      append_bytes(result, parameter.values);
    }
    for (const Measure& measure : shape.measures) {
      append_bytes(result, measure.name);
      append_bytes(result, std::array{measure.value, measure.sd});
    }
    append_bytes(result, shape.covariance);
    for (const Vec3& p : shape.outline) append_bytes(result, std::array{p.x(), p.y(), p.z()});
    const Vec3 &d = shape.direction, &c = shape.centroid;
    append_bytes(result, std::array{d.x(), d.y(), d.z(), c.x(), c.y(), c.z(), shape.direction_sd, shape.centroid_sd});
    append_bytes(result, std::array{shape.rms, shape.explained, shape.unexplained, shape.coverage});
    append_bytes(result, fitted.distances);
    return result;
  }

  std::string flaw(const Fitted& fitted, const ShapeFitter& fitter, const Options& arguments) const {
    const FittedShape& shape = fitted.shape;
    if (!shape.summary.usable())
      return shape.summary.message.empty() ? "does not say in 'summary.message' why there is no fit" : "";
    for (const ShapeParameter& parameter : shape.parameters) {
      for (const double value : parameter.values)
        if (!std::isfinite(value)) return "gives the parameter '" + parameter.name + "' a value that is not finite";
      if (parameter.columns < 1 || parameter.values.size() % static_cast<std::size_t>(parameter.columns) != 0)
        return fmt::format("gives the parameter '{}' {} values in rows of {}", parameter.name, parameter.values.size(),
                           parameter.columns);
    }
    for (const Measure& measure : shape.measures) {
      if (plugin_.find_provided(measure.name) == nullptr)
        return "gives a measure '" + measure.name + "' that its descriptor does not provide";
      if (!std::isfinite(measure.value) || !is_amount(measure.sd))
        return fmt::format("gives the measure '{}' the value {} with deviation {}", measure.name, measure.value,
                           measure.sd);
      const Interval range = fitter.bounds(measure.name, boxes_, arguments);
      const double rounding = 1e-9 * std::abs(measure.value);
      if (!(measure.value >= range.low - rounding && measure.value <= range.high + rounding))
        return fmt::format("bounds() has '{}' from {} to {}, and fit() makes it {}", measure.name, range.low,
                           range.high, measure.value);
    }
    if (!is_amount(shape.rms)) return fmt::format("gives a usable fit the rms {}", shape.rms);
    if (!is_amount(shape.explained) || !is_amount(shape.unexplained))
      return fmt::format("explains {} and leaves {} unexplained", shape.explained, shape.unexplained);
    if (!(shape.coverage >= 0 && shape.coverage <= 1 + 1e-9))
      return fmt::format("gives the coverage {}, not within 0 to 1", shape.coverage);
    if (!shape.centroid.allFinite() || !is_amount(shape.centroid_sd)) return "gives a centroid that is not finite";
    if (shape.orientation != Orientation::none &&
        (std::abs(shape.direction.norm() - 1) > 1e-6 || !is_amount(shape.direction_sd)))
      return "gives a direction that is not of unit length, or without a deviation";
    if (shape.covariance.size() != shape.covariance_of.size() * shape.covariance_of.size())
      return fmt::format("gives a covariance of {} numbers for {} parameters", shape.covariance.size(),
                         shape.covariance_of.size());
    if (shape.outline.size() > 512) return fmt::format("gives an outline of {} points", shape.outline.size());
    for (const double distance : fitted.distances)
      if (!is_amount(distance)) return fmt::format("puts a point at the distance {}", distance);
    return "";
  }

  PointSets points_;
  const PluginManifest& plugin_;
  std::vector<double> areas_, curvature_;
  std::vector<Box> boxes_;
  Box box_;
};

}  // namespace

TrialSet shape_trials(const PluginManifest& plugin) {
  TrialSet set;
  const std::size_t sets = plugin.min_arity;
  const auto make = [&](PointSets points) { return std::make_unique<ShapeTrial>(std::move(points), plugin); };
  for (PointSets& points : ordinary_points(sets)) set.ordinary.push_back(make(std::move(points)));
  for (PointSets& points : degenerate_points(sets)) set.degenerate.push_back(make(std::move(points)));
  PointSets one = ordinary_points(sets)[0];
  const Vec3 none = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
  one.name = "a ring with one point that is NaN";
  one.points[one.points.size() / 2] = none;
  set.poisoned.push_back(make(one));
  one.name = "points that are all NaN";
  one.points.assign(one.points.size(), none);
  set.poisoned.push_back(make(one));
  PointSets large{"a ring of 50,000 points", {}, 1e-4, {}};
  for (int i = 0; i < 50000; ++i) {
    const double angle = 2 * pi * i / 50000;
    large.points.emplace_back(0.8 * std::cos(angle), 0.8 * std::sin(angle), 1e-4 * (i % 3));
  }
  for (std::size_t k = 0; k <= sets; ++k) large.offsets.push_back(static_cast<Index>(50000 * k / sets));
  set.large.push_back(make(std::move(large)));
  return set;
}

}  // namespace toposcope
