// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <string_view>

#include "result/dual.h"
#include "toposcope/shapes.h"

namespace toposcope {

/// A fitted shape whose numbers know what moves them.
struct UncertainShape {
  const FittedShape* shape = nullptr;  ///< null: missing
  Orientation orientation = Orientation::none;
  bool is_plane = false;  ///< it goes on without end along its plane
  DualVector centroid, direction;
  std::map<std::string, Dual, std::less<>> measures;

  const Dual& measure(std::string_view name) const { return measures.find(name)->second; }
};

/// The independent causes that move the shapes of a mesh.
class Causes {
 public:
  /// Its numbers by its causes: those of its covariance, and what its standard deviations say beyond that. What the
  /// covariance does not name moves by itself.
  UncertainShape add(const FittedShape& shape);
  /// Gives all derivatives of a shape the length that there are causes, once all are added.
  void finish(UncertainShape& shape) const;

 private:
  Eigen::Index count_ = 0;
};

}  // namespace toposcope
