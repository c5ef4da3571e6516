// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>
#include <vector>

#include "model/model.h"
#include "toposcope/shapes.h"

namespace toposcope {

/// A measure of the model on one mesh.
struct Measurement {
  std::string name, expression;
  std::string unit;  ///< "length", "area", "volume", "length^-1", "deg", or "" of a number
  std::string why;   ///< why there is no value; empty: there is one
  double value = 0;  ///< mesh unit, degrees
  double sd = 0;     ///< standard deviation, same unit
};

struct Measurements {
  std::vector<Measurement> all;    ///< in the order of the model
  std::vector<double> covariance;  ///< row-major over `all`, products of their units; 0 where there is no value

  double between(std::size_t i, std::size_t j) const { return covariance[i * all.size() + j]; }
};

/// Values of the model's measures, and how sure they are: to first order, of the covariances of the shapes, which are
/// independent of each other since no two features share a vertex (docs/theory/measures.md).
/// \param shapes  one per model feature; null: missing
Measurements measure(const Model& model, std::span<const FittedShape* const> shapes, const Box& object_box);

}  // namespace toposcope
