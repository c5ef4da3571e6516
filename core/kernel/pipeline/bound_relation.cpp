// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/bound_relation.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "base/errors.h"
#include "plugin/guard.h"
#include "plugin/option_check.h"

namespace toposcope {
namespace {

std::vector<OptionValue> relation_arguments(const MeshView& mesh, const Relationship& relationship,
                                            const RelationshipStation& station) {
  std::vector<OptionValue> values = station.defaults;
  for (const auto& argument : relationship.arguments) {
    const std::string& name = argument.first;
    const Expression& expression = argument.second;
    auto value = std::find_if(values.begin(), values.end(), [&](const OptionValue& v) { return v.name == name; });
    if (value == values.end()) value = values.insert(value, {name, 0, ""});
    value->number = expression.evaluate({mesh.box, Box{}});
    if (!std::isfinite(value->number))
      refuse_on_mesh(expression, {mesh.box, Box{}}, relationship.where, name, "must be a number; mind divisions by 0");
  }
  for (const auto& [name, text] : relationship.words)
    for (OptionValue& value : values)
      if (value.name == name) value.text = text;
  check_order(station.arguments, values,
              relationship.where.str() + ": relationship '" + relationship.name + "' on this mesh");
  return values;
}

/// What the costs are made of must be numbers.
void check(const RelationResult& result) {
  if (!result.applicable) return;
  const bool sound = std::isfinite(result.residual) && result.residual >= 0 && result.tolerance > 0 && result.sd >= 0 &&
                     result.dof >= 1 && result.slack >= 0 && result.samples >= 0 && result.clutter_density > 0 &&
                     std::isfinite(result.clutter_density);
  if (!sound) throw std::runtime_error("gave a residual, tolerance, deviation or density that is out of its range");
}

}  // namespace

BoundRelation::BoundRelation(const ModelRun& run, Index relationship)
    : run_(&run),
      relationship_(relationship),
      arguments_(relation_arguments(run.mesh, this->relationship(), station())) {
  if (const auto& given = this->relationship().tolerance)
    tolerance_ = positive_on_mesh(*given, {run.mesh.box, Box{}}, this->relationship().where, "tolerance") *
                 (station().unit == "deg" ? pi / 180 : 1);
}

bool BoundRelation::same_test(const BoundRelation& other) const {
  return station().tester == other.station().tester && tolerance_ == other.tolerance_ && arguments_ == other.arguments_;
}

RelationResult BoundRelation::test(std::span<const ConstructedFeature* const> features,
                                   std::vector<RelationOperand>& operands) const {
  const MeshView& mesh = run_->mesh;
  operands.clear();
  for (const ConstructedFeature* feature : features)
    operands.push_back({&feature->shape, feature->points, feature->box, feature->vertices});
  RelationResult result =
      station().tester->test({operands, mesh.box, mesh.mean_edge, &mesh}, Options(arguments_), run_->context);
  if (tolerance_) result.tolerance = *tolerance_;
  check(result);
  return result;
}

RelationResult test_relationship(const ModelRun& run, Index relationship,
                                 std::span<const ConstructedFeature* const> features) {
  const BoundRelation relation(run, relationship);
  std::vector<RelationOperand> operands;
  return guard(relation.relationship().plugin, [&] { return relation.test(features, operands); });
}

}  // namespace toposcope
