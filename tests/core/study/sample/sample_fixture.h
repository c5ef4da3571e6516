// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "base/run_context.h"
#include "sample/sample.h"

namespace toposcope::test {

inline Sample make(const SampleRequest& request, unsigned threads = 2) {
  RunContext context({.threads = threads});
  return make_sample(request, context);
}

inline const TruthFeature& feature(const std::vector<TruthFeature>& features, const std::string& name) {
  for (const TruthFeature& each : features)
    if (each.name == name) return each;
  throw std::out_of_range(name);
}

/// A parameter of a feature's exact shape.
inline const std::vector<double>& value(const TruthFeature& feature, const std::string& name) {
  for (const auto& [key, values] : feature.parameters)
    if (key == name) return values;
  throw std::out_of_range(name);
}

inline Vec3 vec(const std::vector<double>& v) {
  return {v.at(0), v.at(1), v.at(2)};
}

inline double volume(const TriangleSoup& mesh) {
  double six = 0;
  for (const Triangle& t : mesh.triangles)
    six += mesh.positions[t[0]].dot(mesh.positions[t[1]].cross(mesh.positions[t[2]]));
  return six / 6;
}

struct Edges {
  double mean = 0, variation = 0;  ///< mean length; standard deviation / mean
};
inline Edges edges(const TriangleSoup& mesh) {
  double sum = 0, squares = 0, count = 0;
  for (const Triangle& t : mesh.triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      const double length = (mesh.positions[t[i]] - mesh.positions[t[(i + 1) % 3]]).norm();
      sum += length;
      squares += length * length;
      ++count;
    }
  const double mean = sum / count;
  return {mean, std::sqrt(squares / count - mean * mean) / mean};
}

}  // namespace toposcope::test
