// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "pipeline/constructed_features.h"
#include "pipeline/model_run.h"
#include "toposcope/relations.h"

namespace toposcope {

/// A relationship of the model made ready for one mesh: its expressions evaluated.
class BoundRelation {
 public:
  /// \param run  must outlive it
  /// \throw UsageError  an argument or tolerance is no fit number on this mesh
  BoundRelation(const ModelRun& run, Index relationship);

  const ModelRun& run() const { return *run_; }
  const Relationship& relationship() const { return run_->model.relationships[relationship_]; }
  bool ordered() const { return station().ordered; }

  /// Whether the other asks the same of the features that it is given.
  bool same_test(const BoundRelation& other) const;

  /// \param features  in the order of the relationship
  /// \param operands  room that tests may share
  /// \throw std::runtime_error  the result is no result
  RelationResult test(std::span<const ConstructedFeature* const> features,
                      std::vector<RelationOperand>& operands) const;

 private:
  const RelationshipStation& station() const { return run_->stations.relationships[relationship_]; }

  const ModelRun* run_;
  Index relationship_;
  std::vector<OptionValue> arguments_;
  std::optional<double> tolerance_;  ///< rad or mesh unit; nothing: the relation's own
};

/// Tests a relationship of the model between constructed features, given in its order.
/// \throw UsageError, PluginError
RelationResult test_relationship(const ModelRun& run, Index relationship,
                                 std::span<const ConstructedFeature* const> features);

}  // namespace toposcope
