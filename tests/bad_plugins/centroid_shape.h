// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "toposcope/plugin.h"

namespace {

/// The simplest shape there is: the centroid of its points.
class CentroidShape : public toposcope::ShapeFitter {
 public:
  explicit CentroidShape(const toposcope::Options&) {}
  toposcope::FittedShape fit(const toposcope::FitInput& input, const toposcope::Options&,
                             toposcope::Context&) const override {
    toposcope::FittedShape shape;
    for (const toposcope::Vec3& point : input.points)
      shape.centroid += point / static_cast<double>(input.points.size());
    shape.summary.termination = toposcope::Termination::closed_form;
    return shape;
  }
  double distance(const toposcope::FittedShape& shape, const toposcope::Vec3& point) const override {
    return (point - shape.centroid).norm();
  }
};

/// The descriptor of a sound plugin, to be spoiled.
[[maybe_unused]] toposcope::PluginDescriptor sound_descriptor(const char* id) {
  return toposcope::describe<toposcope::ShapeFitter, CentroidShape>({.id = id,
                                                                     .version = "1.0.0",
                                                                     .summary = "The centroid of the points",
                                                                     .min_arity = 1,
                                                                     .max_arity = 1,
                                                                     .dimension = 0});
}

}  // namespace

/// Ends a wrong plugin: `spoil` is done to the descriptor once.
#define WRONG_PLUGIN(id, spoil)                                                                             \
  extern "C" __attribute__((visibility("default"))) const toposcope::PluginDescriptor* toposcope_plugin() { \
    static const toposcope::PluginDescriptor wrong = [] {                                                   \
      toposcope::PluginDescriptor descriptor = sound_descriptor(id);                                        \
      spoil;                                                                                                \
      return descriptor;                                                                                    \
    }();                                                                                                    \
    return &wrong;                                                                                          \
  }
