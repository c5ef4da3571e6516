// SPDX-License-Identifier: BSD-3-Clause
#include "result/classification.h"

#include <fmt/format.h>

#include <algorithm>

namespace toposcope {

Classification classify(const std::vector<Result>& results) {
  Classification classification;
  std::vector<Explained> explained;
  for (const Result& result : results)
    for (const ClassReport& each : result.classes) explained.push_back({each.log_evidence, each.least_cost});
  const std::vector<double> evidence = comparable_evidence(explained);
  const std::vector<double> probabilities = class_probabilities(evidence);
  const Result* best = nullptr;
  const ClassReport* best_class = nullptr;
  double best_evidence = 0;
  std::size_t c = 0;
  for (const Result& result : results)
    for (const ClassReport& each : result.classes) {
      classification.probabilities.emplace_back(each.name, probabilities[c]);
      if (!best_class || evidence[c] > best_evidence) {
        best = &result;
        best_class = &each;
        best_evidence = evidence[c];
      }
      ++c;
    }
  classification.probabilities.emplace_back("none", probabilities.back());
  if (!best) return classification;
  classification.mesh_path = best->mesh_path;
  classification.model = best->model;
  classification.relations = best->relations;
  if (best_class->fits && best_evidence > 0) classification.class_name = best_class->name;
  return classification;
}

std::string to_text(const Classification& classification) {
  std::string text = fmt::format("{}\n", classification.mesh_path);
  for (const RelationReport& report : classification.relations) {
    text += fmt::format("  {} {:<6}{:<20}{:<28}", report.satisfied ? "*" : " ", report.name, report.type,
                        fmt::format("{}", fmt::join(report.features, ", ")));
    text += report.tested && report.applicable
                ? fmt::format("residual {:.4g} {}, tolerance {:.3g}\n", report.residual, report.unit, report.tolerance)
                : report.why + "\n";
  }
  std::string ranked;
  auto probabilities = classification.probabilities;
  std::stable_sort(probabilities.begin(), probabilities.end(),
                   [](const auto& a, const auto& b) { return a.second > b.second; });
  for (const auto& [name, probability] : probabilities)
    if (probability >= 5e-4) ranked += fmt::format("{}{} {:.3f}", ranked.empty() ? "" : ", ", name, probability);
  return text + fmt::format("  => {}   ({})\n\n",
                            classification.class_name.empty() ? "unknown" : classification.class_name, ranked);
}

}  // namespace toposcope
