// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

#include "pipeline/constructed_features.h"
#include "pipeline/filters.h"

namespace toposcope {

/// Milliseconds per station, in the order of the path.
using Timings = std::vector<std::pair<std::string, double>>;

/// The labelling of a model, or of one of its classes.
struct ClassOutcome {
  std::string name;                  ///< of the class; of the model when it has no classes
  std::vector<Index> features;       ///< model feature of each variable
  std::vector<Index> relationships;  ///< model relationship of each constraint
  LabelingProblem problem;           ///< interchangeable features told apart by the best labelling
  LabelingOutcome outcome;           ///< the labeler's; its probabilities are those of the pipeline's marginals, if any
  std::string probabilities;         ///< how they were made; empty: there are none
  Labeling answer;                   ///< what is reported: the labelling of least cost, or in_most_probable_places

  /// Before interchangeable features are told apart:
  double log_evidence = 0;                ///< over all labellings; not a number where none is made
  double least_cost = 0;                  ///< of the labellings found
  double lower_bound = 0;                 ///< the labeler's
  std::uint64_t nodes = 0;                ///< the labeler's
  double label_ms = 0, marginals_ms = 0;  ///< to solve it; without the time to tell features apart

  bool complete = false;  ///< every feature present, every relationship within tolerance
};

/// What classes are compared by, in the order given: the log evidence of each, or, where not all have one, minus the
/// cost of each one's best labelling. 0 is that of "everything is clutter".
struct Explained {
  double log_evidence, least_cost;
};
std::vector<double> comparable_evidence(const std::vector<Explained>& classes);

/// Probability of each class and, last, of none, when all are equally likely beforehand.
/// \param log_evidence  per class, in nats; -infinity: impossible
std::vector<double> class_probabilities(std::vector<double> log_evidence);

/// All that is learned of a mesh under a model, station by station.
struct Analysis {
  PreparedMesh mesh;
  WorkingSets sets;
  ConstructedFeatures features;
  LabelingProblem problem;                  ///< of all features and relationships
  std::vector<ClassOutcome> classes;        ///< one for a model without classes
  std::vector<double> class_evidence;       ///< what `classes` are compared by
  std::vector<double> class_probabilities;  ///< over `classes` and, last, none of them
  std::size_t best = 0;                     ///< the class of greatest evidence
  Timings timings;
};

/// Runs filter, classify, fit, relate and, where the model has one, the second look, which a first labelling by the
/// pipeline's labeler guides: all that comes before the labelling proper.
Analysis construct(const Mesh& mesh, const Model& model, const Stations& stations, Context& context);

/// The station *label*: replaces `classes` and what follows from them.
void label(Analysis& analysis, const Model& model, const Stations& stations, const LabelingRequest& request,
           Context& context);

/// Both; then the best class's answer has its features in their most probable places.
Analysis analyze(const Mesh& mesh, const Model& model, const Stations& stations, const LabelingRequest& request,
                 Context& context);

}  // namespace toposcope
