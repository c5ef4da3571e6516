// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "model/model.h"

namespace toposcope {

/// "point", "line", "surface", "volume"
std::string object_kind(int dimension);

/// "line-group (segments 3)"
std::string shape_in_words(const ShapeSpec& shape);
/// "cylinder or cone"
std::string shapes_in_words(const ModelFeature& feature);

/// "bb(w).c/2 < radius < bb(O).a"
std::string range_in_words(const Range& range);

/// "radius < bb(O).a"; \param bound  2 r + 0 the lower and + 1 the upper one of range r; after them max_fit_error
std::string bound_in_words(const ModelFeature& feature, Index bound);

/// "min 0, max bb(O).c/4, tolerance 20"; "" without any
std::string arguments_in_words(const Relationship& relationship);

/// "convex + concave"
std::string worksets_in_words(const ModelFeature& feature);

/// With spaces up to a width.
std::string padded(std::string text, std::size_t width);

/// "0.5", the shortest that reads back the same
/// "3 to 8", "4", "any number of", "at least 2"; of a single feature "required" or nothing.
std::string count_in_words(const InstanceCount& count);

std::string number_in_words(double number);

}  // namespace toposcope
