// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "mesh/repair.h"
#include "pipeline/analysis.h"
#include "result/conflict.h"
#include "result/measurements.h"

namespace toposcope {

/// A relationship under a labelling.
struct RelationReport {
  std::string name, type;
  std::vector<std::string> features;
  bool tested = false;  ///< false: a feature in its scope is missing
  bool applicable = true;
  std::string why;                     ///< why it is not tested or not applicable
  double residual = 0, tolerance = 0;  ///< in `unit`
  std::string unit;                    ///< "deg" or "length"
  bool satisfied = false;
  double probability = 0;  ///< that it holds, given its residual
};

/// Why a feature is missing.
struct MissingReport {
  std::string reason;
  std::optional<FittedShape> nearest;      ///< the candidate that would have cost least
  double nearest_cost = 0;                 ///< nats that labelling it would have added over leaving it missing
  std::vector<RelationReport> failed;      ///< relationships that the nearest candidate breaks
  std::optional<ConflictReport> conflict;  ///< what forbids all candidates, not the nearest alone
};

struct FeatureReport {
  std::string name, shape_plugin;
  bool present = false;
  double probability =
      0;  ///< present: that this shape (to within a mean edge) is the feature; missing: that it is missing
  double evidence = 0;  ///< nats by which labelling it beats leaving it missing, all else as it is
  FittedShape shape;
  std::vector<Index> working_sets;
  std::vector<Index> triangles;  ///< of the input mesh
  std::vector<Index> faces;      ///< of the input file: a polygon may hold several triangles
  MissingReport missing;
};

/// How many instances of a family there are.
struct FamilyReport {
  std::string name, allowed;    ///< "3 to 8"
  Index found = 0;              ///< instances
  double probability = 0;       ///< that so many would be found; not a number where no sums are made
  std::vector<double> numbers;  ///< the probability of 0, 1, 2, ...
  /// There are more than the model allows: how probable that is where any number is allowed, and the likely number
  /// then.
  std::optional<double> more;
  Index likely = 0;
};

/// How well one class of the model (the model itself when it has no classes) explains the mesh.
struct ClassReport {
  std::string name;
  double log_evidence = 0;  ///< against "everything is clutter"; not a number where none is made
  double least_cost = 0;    ///< what classes are compared by where one has no evidence
  double probability = 0;   ///< over the classes of this model and none of them
  bool fits = false;        ///< a class rule: its features are present, its relationships satisfied
};

struct AlternativeReport {
  double probability = 0;
  double cost = 0;
  std::vector<std::pair<std::string, int>> candidates;  ///< feature, rank of its candidate from 1; 0 = missing
};

/// The coarse mesh that was analysed in the place of a finer one.
struct AnalysedMesh {
  Index vertices = 0, faces = 0;
  double mean_edge = 0;  ///< mesh unit
};

struct Result {
  std::string mesh_path;
  std::string mesh_hash;  ///< of its content (mesh/content_hash.h)
  Index vertices = 0, faces = 0;
  Box box;
  double mean_edge = 0;
  std::optional<AnalysedMesh> analysed;
  RepairReport repair;  ///< of the file, before all else
  std::string model;
  std::string model_hash;  ///< SHA-256 of what its file says, comments and layout apart
  std::string status;      ///< labelled, partial, none
  std::string class_name;  ///< for a model with class rules: the best; empty when none fits
  std::vector<ClassReport> classes;
  double log_evidence = 0;
  std::string guarantee;                              ///< what the labeler promises of the labelling
  std::string probabilities;                          ///< how they were made, plugin first; empty: there are none
  Exactness probability_exactness = Exactness::none;  ///< of the features' probabilities
  double probability_error = 0;                       ///< where that is a `bound`: no probability is off by more
  bool optimal = false;
  std::vector<FeatureReport> features;  ///< of families each instance
  std::vector<FamilyReport> families;
  std::vector<RelationReport> relations;
  std::optional<Sides> sides;
  Measurements measurements;
  std::vector<AlternativeReport> alternatives;
  std::vector<std::pair<std::string, CandidateCount>> candidates;
  std::size_t working_sets = 0;
  Timings timings;
  std::vector<PluginUse> plugins;
};

/// The station *explain*: the labelling mapped back to the input mesh, with reasons.
Result explain(const Analysis& analysis, const Model& model, const std::string& mesh_path, const Stations& stations,
               Context& context);

/// result.json (schemas/result.schema.json).
std::string to_json(const Result& result);
/// The same on one line.
std::string to_json_line(const Result& result);

/// The measures of one mesh as a row of `run --measures`, and the row of names above them: the mesh, and for each
/// measure its value and standard deviation, empty where there is none.
std::string measures_csv_head(const Model& model);
std::string measures_csv_row(const Result& result);

/// The table that `run` prints.
std::string to_text(const Result& result);

/// labels.ply: the input mesh (repaired) with, for each triangle, a label (0 none, 1 + feature index), a colour and the
/// face of the file that it came from.
void write_labels(const std::filesystem::path& path, const Mesh& input, const Result& result);

}  // namespace toposcope
