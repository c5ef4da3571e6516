// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// A fitted shape's parameters, read by their names.

#include <stdexcept>
#include <string>
#include <string_view>

#include "toposcope/shapes.h"

namespace toposcope {

/// All numbers of a parameter. \throw std::logic_error  the shape has none of that name
inline const std::vector<double>& parameter_values(const FittedShape& shape, std::string_view name) {
  if (const ShapeParameter* parameter = shape.parameter(name)) return parameter->values;
  throw std::logic_error("the shape has no parameter '" + std::string(name) + "'; it was made by another fitter");
}

/// A parameter that is one number. \throw std::logic_error  as above
inline double number_parameter(const FittedShape& shape, std::string_view name) {
  return parameter_values(shape, name)[0];
}

/// A parameter that is one point or direction. \throw std::logic_error  as above
inline Vec3 vector_parameter(const FittedShape& shape, std::string_view name) {
  return Vec3(parameter_values(shape, name).data());
}

}  // namespace toposcope
