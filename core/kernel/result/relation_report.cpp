// SPDX-License-Identifier: BSD-3-Clause
#include "result/relation_report.h"

#include "pipeline/bound_relation.h"
#include "probability/likelihood.h"

namespace toposcope {

RelationReport report_relation(const ModelRun& run, const ClassOutcome& posed, const ConstructedFeatures& features,
                               Index constraint, const Labeling& labeling) {
  const Index r = posed.relationships[constraint];
  const Relationship& relationship = run.model.relationships[r];
  RelationReport report;
  report.name = relationship.name;
  report.type = relationship.plugin;
  report.unit = run.stations.relationships[r].unit;
  std::vector<const ConstructedFeature*> given;
  for (const Index v : posed.problem.constraints[constraint].scope) {
    const LabelingVariable& variable = posed.problem.variables[v];
    report.features.push_back(variable.name);
    if (labeling.values[v] == 0)
      report.why = "'" + report.features.back() + "' is missing";
    else
      given.push_back(&features.all[variable.candidates[labeling.values[v] - 1]]);
  }
  if (!report.why.empty()) return report;
  const RelationResult result = test_relationship(run, r, given);
  const double scale = report.unit == "deg" ? 180 / pi : 1;
  report.tested = true;
  report.applicable = result.applicable;
  report.why = result.why;
  report.residual = result.residual * scale;
  report.tolerance = result.tolerance * scale;
  report.satisfied = violation(result) <= 1;
  report.probability = relation_probability(run.stations.probability, result);
  return report;
}

}  // namespace toposcope
