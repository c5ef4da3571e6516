// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "model/expression.h"
#include "model/measure_expression.h"
#include "model/source_location.h"
#include "toposcope/types.h"

namespace toposcope {

// ---- abstract symbolic model (dissertation 3.2) ----

struct SpatialObject {
  std::string name;
  int dimension = 0;  ///< 0 point, 1 line, 2 surface, 3 volume
  SourceLocation where;
};

/// A directed link of one of the networks, by index into AbstractModel::objects. The inverse is implied.
struct Link {
  Index from = 0, to = 0;
  std::string kind;  ///< "bounded-by"; "has-part"; "adjacent-to" or a direction: up, down, front, back, right, left
  SourceLocation where;
};

/// Features along whose normal or axis one of the object's directions runs, either way: `axes: {up: [seat]}`.
struct AxisFeatures {
  std::string direction;        ///< up, front or right
  std::vector<Index> features;  ///< by index into Model::features
  SourceLocation where;
};

struct AbstractModel {
  std::vector<SpatialObject> objects;
  std::vector<Link> topology;      ///< from is bounded by to; to has dimension one less
  std::vector<Link> parts;         ///< from has part to; same dimension; no cycles
  std::vector<Link> associations;  ///< adjacent-to, and directions along the object's own symbolic axes
  Index root = 0;                  ///< the one object that is part of nothing and bounds nothing
};

// ---- working model (3.3) ----

/// low < measure < high, in the unit of the measure.
struct Range {
  std::string measure;  ///< `radius`, `length`, `length_2`
  std::optional<Expression> low, high;
  SourceLocation where;
};

/// A plugin named in a model, with its arguments as written (checked against the plugin's argument table).
struct ShapeSpec {
  std::string plugin;
  std::vector<std::pair<std::string, std::string>> arguments;
  SourceLocation where;
};

/// How many instances of a feature an object has.
struct InstanceCount {
  Index least = 0;
  std::optional<Index> most = 1;  ///< nothing: any number
  bool family() const { return !most || *most > 1; }
};

struct ModelFeature {
  std::string name;
  std::string realises;               ///< abstract object; empty when the model has no abstract part
  std::vector<std::string> worksets;  ///< one type per working set of the group
  /// The same for the groups that a second look tries, of sets that no other feature has taken; empty: there is none.
  std::vector<std::string> second_look;
  ShapeSpec shape;
  std::vector<ShapeSpec> other_shapes;      ///< alternatives to it: of `shape: [cylinder, cone]` all but the first
  std::vector<Range> ranges;                ///< of the measures that a shape has: what one lacks does not bound it
  std::optional<Expression> max_fit_error;  ///< t_err of 3.4.1, a length
  double detectability = 1;                 ///< 0 to 1
  InstanceCount count;                      ///< at most one, as most features have; else a family of instances
  SourceLocation where;

  /// One there must be: a labelling without it pays what it would have been worth.
  bool required() const { return count.least > 0; }
};

struct Relationship {
  std::string name;    ///< r1, r2, ...
  std::string plugin;  ///< relation type = plugin id
  /// By index into Model::features, each once but for a family: named twice it stands for each pair of instances.
  std::vector<Index> features;
  std::vector<std::pair<std::string, Expression>> arguments;
  std::vector<std::pair<std::string, std::string>> words;  ///< arguments that are texts, checked
  /// In the residual's unit (deg or length), over bb(O); without it the relation's own option decides.
  std::optional<Expression> tolerance;
  SourceLocation where;
  std::string because = {};  ///< what of the abstract part it follows from; empty: it is written
};

/// A relationship that would follow from the abstract part, had the writer not said otherwise.
struct Overruled {
  std::string because;  ///< what it would follow from
  std::string by;       ///< the relationship that says it
};

/// A class of objects told apart by which relationships hold (Tables 5.5, 6.2): exactly the features that these
/// relationships name are present, and every one of them is satisfied.
struct ClassRule {
  std::string name;
  std::vector<Index> relationships;
  SourceLocation where;
};

struct Model {
  std::string name, summary, citation;
  std::string pipeline;  ///< that it asks for, by name or file; empty: none
  SourceLocation pipeline_where;
  std::string file;
  std::string document;  ///< the file as JSON
  AbstractModel abstract;
  std::vector<ModelFeature> features;
  std::vector<Relationship> relationships;  ///< as written, then those that the abstract part implies
  std::vector<Overruled> overruled;
  std::vector<AxisFeatures> axes;
  std::vector<ClassRule> classes;  ///< empty for most models
  std::vector<ModelMeasure> measures;
};

}  // namespace toposcope
