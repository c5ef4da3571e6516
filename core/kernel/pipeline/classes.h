// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "model/model.h"
#include "pipeline/own_axes.h"
#include "pipeline/stations.h"
#include "toposcope/labeling/families.h"

namespace toposcope {

/// How many instances of a family there are.
struct FamilyCount {
  Index feature = 0;            ///< of the model
  Index found = 0;              ///< in the labelling of least cost
  std::vector<double> numbers;  ///< the probability of finding 0, 1, 2, ...; empty: none is made
  /// Where as many were found as there may be: the probability that there would be more if any number were allowed, and
  /// the most probable number then.
  std::optional<std::pair<double, Index>> beyond;
};

/// Which side is which, told by handedness: among features that nothing else tells apart.
struct Sides {
  OwnAxes axes;
  double probability = 0;   ///< that the names are not those of the mirror image
  std::vector<bool> named;  ///< per variable: its name hangs on it
};

/// The labelling of a model, or of one of its classes.
struct ClassOutcome {
  std::string name;                  ///< of the class; of the model when it has no classes
  std::vector<Index> features;       ///< model feature of each variable
  std::vector<Index> relationships;  ///< model relationship of each constraint
  LabelingProblem problem;           ///< interchangeable features told apart by the best labelling
  LabelingOutcome outcome;           ///< the labeler's; its probabilities are those of the pipeline's marginals, if any
  std::string probabilities;         ///< how they were made; empty: there are none
  std::optional<Sides> sides;        ///< nothing: the model, or what was found, tells none
  std::vector<std::vector<Index>> renamings;  ///< of its features that mean the same (renamings_of), `sides` kept
  Labeling answer;  ///< what is reported: the labelling of least cost, or one of most probable shapes

  /// Before interchangeable features are told apart:
  double log_evidence = 0;                ///< over all labellings; not a number where none is made
  double least_cost = 0;                  ///< of the labellings found
  double lower_bound = 0;                 ///< the labeler's
  std::uint64_t nodes = 0;                ///< the labeler's
  double label_ms = 0, marginals_ms = 0;  ///< to solve it; without the time to tell features apart

  /// Of a model with families: sets of instances, until these are written out as features.
  FamilyOutcome sets;
  std::vector<FamilyCount> families;

  bool complete = false;  ///< every feature present, every relationship within tolerance
};

/// The questions that a model puts: one per class rule, with only the features that its relationships name and these
/// relationships as constraints; the whole problem when the model has no classes. A feature that a class
/// names belongs to it, so that its detectability there is `certainty`.
/// \param problem  of all features and relationships of the model
std::vector<ClassOutcome> pose_classes(const LabelingProblem& problem, const Model& model,
                                       const ProbabilityModel& probability);

/// All renamings of a class's features that leave its question as it is (`renamings` of probability/symmetry.h).
std::vector<std::vector<Index>> renamings_of(const ClassOutcome& posed, const Model& model, const Stations& stations);

/// What classes are compared by, in the order given: the log evidence of each, or, where not all have one, minus the
/// cost of each one's best labelling. 0 is that of "everything is clutter".
struct Explained {
  double log_evidence, least_cost;
};
std::vector<double> comparable_evidence(const std::vector<Explained>& classes);

/// Probability of each class and, last, of none, when all are equally likely beforehand.
/// \param log_evidence  per class, in nats; -infinity: impossible
std::vector<double> class_probabilities(std::vector<double> log_evidence);

}  // namespace toposcope
