// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "base/errors.h"
#include "core/kernel/model/model_catalog.h"
#include "model/read_model.h"

namespace toposcope::test {

/// A model without faults. Tests count on its line numbers.
inline const std::string sound_model = R"(schema: toposcope.model/1
name: cup
objects:
  cup: volume
  body: volume
  wall: surface
  floor: surface
  rimLine: line
  edgeLine: line
topology:
  body: [wall, floor]
  wall: [rimLine, edgeLine]
parts:
  cup: [body]
associations:
  - {from: rimLine, up: edgeLine}
features:
  rim:
    realises: rimLine
    worksets: [convex]
    shape: circle
    ranges:
      radius: bb(w).c/2 < r < bb(O).a
    max_fit_error: bb(O).a/20
    detectability: 0.75
  edge: {realises: edgeLine, worksets: [convex, concave], shape: {plugin: line-group, segments: 3, closed: true}}
  bottom: {realises: floor, worksets: [planar], shape: plane}
relationships:
  r1: {features: [rim, edge], type: concentric}
  r2: {features: [edge, bottom], type: centroid-distance, max: bb(O).c/4}
classes:
  plain: [r1]
  full: [r2, r1]
)";

/// Reads models from text, against a catalog of plugins.
class ReadModel : public ::testing::Test {
 protected:
  std::string error_of(const std::string& text, bool with_catalog = true) const {
    try {
      model_from_text(text, "m.yaml", with_catalog ? &catalog_ : nullptr);
      return "no error";
    } catch (const UsageError& error) {
      EXPECT_EQ(error.exit_code, 2);
      return error.what();
    }
  }
  /// The error of the sound model with one place changed.
  std::string error_with(const std::string& from, const std::string& to, bool with_catalog = true) const {
    std::string text = sound_model;
    const std::size_t place = text.find(from);
    EXPECT_NE(place, std::string::npos) << "the sound model has no " << from;
    return error_of(text.replace(place, from.size(), to), with_catalog);
  }

  PluginCatalog catalog_ = ModelCatalog().read();
};

/// What an error says of the sound model with one place changed.
struct Change {
  const char* from;
  const char* to;
  const char* place;  ///< line:column
  const char* says;
};

}  // namespace toposcope::test
