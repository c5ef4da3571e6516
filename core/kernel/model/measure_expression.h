// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "model/expression_program.h"
#include "model/source_location.h"
#include "plugin/catalog.h"
#include "toposcope/types.h"

namespace toposcope {

struct ModelFeature;

/// What a measure asks of found features.
struct Quantity {
  enum class Kind {
    shape_measure,  ///< a measure of one feature's shape
    distance,       ///< of the first from the second
    along,          ///< the first's axis: from the second to the third
    across,         ///< the first's axis: from the second to the third
    angle           ///< between two directions, 0 to 90 degrees
  };
  Kind kind = Kind::shape_measure;
  std::vector<Index> features;  ///< by index into Model::features
  std::string measure;          ///< of a shape_measure: its name
};

/// A checked expression over found features: what Expression has but for bb(w), and quantities of features.
struct MeasureExpression {
  std::vector<Instruction> code;     ///< postfix; Operation::quantity names one of `quantities`
  std::vector<Quantity> quantities;  ///< each once
  int dimension = 0;                 ///< power of length
  int angle = 0;                     ///< power of degrees
  std::string text;                  ///< as written

  /// \param where    of the first character of `text`
  /// \param catalog  null: measures of shapes are not looked up, and fit every dimension
  /// \throw UsageError  syntax, an unknown feature or measure, a sum or comparison of unlike dimensions
  static MeasureExpression parse(std::string_view text, const SourceLocation& where,
                                 const std::vector<ModelFeature>& features, const PluginCatalog* catalog);

  std::vector<Index> features() const;  ///< that it names, each once
  std::string unit() const;             ///< "length", "area", "volume", "length^-1", "deg", or "" of a number
};

/// A measure of a shape that is an angle, in degrees: its name says so.
bool is_angle_measure(std::string_view measure);

/// A named number over found features.
struct ModelMeasure {
  std::string name;
  MeasureExpression expression;
  SourceLocation where;
};

}  // namespace toposcope
