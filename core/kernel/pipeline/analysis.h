// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "pipeline/classes.h"
#include "pipeline/constructed_features.h"
#include "pipeline/families.h"
#include "pipeline/filters.h"
#include "pipeline/measured_working_sets.h"

namespace toposcope {

/// Milliseconds per station, in the order of the path.
using Timings = std::vector<std::pair<std::string, double>>;

/// All that is learned of a mesh under a model, station by station.
struct Analysis {
  PreparedMesh mesh;
  MeasuredWorkingSets sets;
  ConstructedFeatures features;
  LabelingProblem problem;                  ///< of all features and relationships
  std::vector<ClassOutcome> classes;        ///< one for a model without classes
  std::vector<double> class_evidence;       ///< what `classes` are compared by
  std::vector<double> class_probabilities;  ///< over `classes` and, last, none of them
  std::size_t best = 0;                     ///< the class of greatest evidence
  std::optional<Instances> instances;       ///< of a model with families, to which `classes` then belong
  Timings timings;

  /// The model that `classes` belong to: the one that was given, with its families written out.
  const Model& written_out(const Model& model) const { return instances ? instances->model : model; }
  const Stations& written_out(const Stations& stations) const { return instances ? instances->stations : stations; }
  /// The feature of the given model that one of it is, or is an instance of.
  Index origin(Index feature) const { return instances ? instances->origin[feature] : feature; }
};

/// What an analysis learns before it asks what the model says: the same for all models of one pipeline.
struct ClassifiedMesh {
  PreparedMesh mesh;
  MeasuredWorkingSets sets;
  Timings timings;
};

/// Runs filter and classify. \param types  of working sets that will be asked for (add_asked_types)
ClassifiedMesh classify(const Mesh& mesh, const Stations& stations, const std::vector<std::string>& types,
                        Context& context);

/// Runs fit, relate and the second look on it. \param stations  of the pipeline that classified the mesh
Analysis construct(ClassifiedMesh classified, const Model& model, const Stations& stations, Context& context);

/// Runs filter, classify, fit, relate and, where the model has one, the second look, which a first labelling by the
/// pipeline's labeler guides: all that comes before the labelling proper.
Analysis construct(const Mesh& mesh, const Model& model, const Stations& stations, Context& context);

/// The station *label*: replaces `classes` and what follows from them.
void label(Analysis& analysis, const Model& model, const Stations& stations, const LabelingRequest& request,
           Context& context);

/// Both; then the best class's answer has its features in their most probable shapes.
Analysis analyze(const Mesh& mesh, const Model& model, const Stations& stations, const LabelingRequest& request,
                 Context& context);
Analysis analyze(ClassifiedMesh classified, const Model& model, const Stations& stations,
                 const LabelingRequest& request, Context& context);

}  // namespace toposcope
