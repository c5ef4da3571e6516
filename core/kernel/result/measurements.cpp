// SPDX-License-Identifier: BSD-3-Clause
#include "result/measurements.h"

#include <algorithm>
#include <cmath>

#include "result/dual.h"
#include "result/shape_causes.h"

namespace toposcope {
namespace {

/// How far two features are from each other: a plane counts as all of it, anything else as its centroid.
Dual distance(const UncertainShape& a, const UncertainShape& b) {
  const DualVector between = b.centroid - a.centroid;
  const Dual half{0.5, {}};
  if (a.is_plane && b.is_plane) return half * (abs(dot(a.direction, between)) + abs(dot(b.direction, between)));
  if (a.is_plane) return abs(dot(a.direction, between));
  if (b.is_plane) return abs(dot(b.direction, between));
  return norm(between);
}

/// Degrees, 0 to 90; a plane and a line are compared as planes and lines are, by their tilt and not by the normal.
Dual angle(const UncertainShape& a, const UncertainShape& b) {
  const Dual degrees{180 / pi, {}}, right{90, {}};
  const Dual between = degrees * atan2(norm(cross(a.direction, b.direction)), abs(dot(a.direction, b.direction)));
  return a.orientation == b.orientation ? between : right - between;
}

/// Evaluates one measure after the other.
class Measurer {
 public:
  Measurer(std::span<const FittedShape* const> shapes, const Box& object_box) : box_(object_box) {
    for (const FittedShape* shape : shapes) shapes_.push_back(shape ? causes_.add(*shape) : UncertainShape());
    for (UncertainShape& shape : shapes_) causes_.finish(shape);
  }

  /// \return why there is no value, or nothing
  std::string evaluate(const MeasureExpression& expression, const Model& model, Dual& value) const {
    std::vector<Dual> quantities;
    for (const Quantity& quantity : expression.quantities) {
      for (const Index feature : quantity.features)
        if (!shapes_[feature].shape) return "'" + model.features[feature].name + "' is missing";
      if (const std::string why = not_there(quantity, model); !why.empty()) return why;
      quantities.push_back(value_of(quantity));
    }
    value = run<Dual>(expression.code, [&](const Instruction& step) {
      if (step.operation == Operation::quantity) return quantities[step.index];
      return Dual{step.operation == Operation::object_side ? box_.sides[step.index] : step.value, {}};
    });
    if (std::isfinite(value.value) && std::isfinite(value.variance())) return {};
    return "it is not finite on this mesh; mind divisions by 0";
  }

 private:
  std::string not_there(const Quantity& quantity, const Model& model) const {
    const auto name = [&](std::size_t i) { return "'" + model.features[quantity.features[i]].name + "'"; };
    if (quantity.kind == Quantity::Kind::shape_measure)
      return shapes_[quantity.features[0]].shape->measure(quantity.measure)
                 ? ""
                 : "the shape of " + name(0) + " has no measure '" + quantity.measure + "'";
    const std::size_t directed = quantity.kind == Quantity::Kind::distance ? 0
                                 : quantity.kind == Quantity::Kind::angle  ? 2
                                                                           : 1;
    for (std::size_t i = 0; i < directed; ++i)
      if (shapes_[quantity.features[i]].orientation == Orientation::none)
        return "the shape of " + name(i) + " has neither normal nor axis";
    return {};
  }

  Dual value_of(const Quantity& quantity) const {
    const auto shape = [&](std::size_t i) -> const UncertainShape& { return shapes_[quantity.features[i]]; };
    switch (quantity.kind) {
      case Quantity::Kind::shape_measure:
        return shape(0).measure(quantity.measure);
      case Quantity::Kind::distance:
        return distance(shape(0), shape(1));
      case Quantity::Kind::along:
        return abs(dot(shape(0).direction, shape(2).centroid - shape(1).centroid));
      case Quantity::Kind::across:
        return norm(cross(shape(0).direction, shape(2).centroid - shape(1).centroid));
      case Quantity::Kind::angle:
        return angle(shape(0), shape(1));
    }
    return {};
  }

  Box box_;
  Causes causes_;
  std::vector<UncertainShape> shapes_;
};

}  // namespace

Measurements measure(const Model& model, std::span<const FittedShape* const> shapes, const Box& object_box) {
  const Measurer measurer(shapes, object_box);
  Measurements measured;
  std::vector<Dual> values(model.measures.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    const MeasureExpression& expression = model.measures[i].expression;
    Measurement& each = measured.all.emplace_back();
    each.name = model.measures[i].name;
    each.expression = expression.text;
    each.unit = expression.unit();
    each.why = measurer.evaluate(expression, model, values[i]);
    if (!each.why.empty()) values[i] = {};
    each.value = values[i].value;
    each.sd = std::sqrt(values[i].variance());
  }
  for (const Dual& a : values)
    for (const Dual& b : values) measured.covariance.push_back(a.by.size() > 0 && b.by.size() > 0 ? a.by.dot(b.by) : 0);
  return measured;
}

}  // namespace toposcope
