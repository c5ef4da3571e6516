// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "evaluation/evaluation.h"

namespace toposcope {
namespace {

void count(FeatureSummary& summary, const FeatureJudgement& judged, const Judgement& scale) {
  switch (judged.verdict) {
    case Verdict::right:
      ++summary.right;
      break;
    case Verdict::wrong:
      ++summary.wrong;
      break;
    case Verdict::missed:
      ++summary.missed;
      break;
    case Verdict::absent:
      ++summary.absent;
      break;
    case Verdict::spurious:
      ++summary.spurious;
      break;
  }
  if (!std::isfinite(judged.distance)) return;
  ++summary.measured;
  summary.distance += judged.distance;
  summary.edges += judged.distance / scale.mean_edge;
  summary.diagonal += judged.distance / scale.diagonal;
  summary.worst_edges = std::max(summary.worst_edges, judged.distance / scale.mean_edge);
}

constexpr std::size_t bins = 10;

void count(Reliability& reliability, double probability, bool right) {
  if (std::isnan(probability)) return;
  const auto bin = std::min(bins - 1, static_cast<std::size_t>(std::max(0.0, probability) * bins));
  ReliabilityBin& into = reliability.bins[bin];
  ++into.count;
  into.right += right;
  into.probability += probability;
  ++reliability.count;
}

}  // namespace

std::vector<FeatureSummary> summarize(const std::vector<const MeshEvaluation*>& meshes) {
  std::vector<FeatureSummary> summaries;
  FeatureSummary all;
  all.name = "all";
  for (const MeshEvaluation* mesh : meshes)
    for (const FeatureJudgement& judged : mesh->judgement.features) {
      auto found = std::find_if(summaries.begin(), summaries.end(),
                                [&](const FeatureSummary& s) { return s.name == judged.feature; });
      if (found == summaries.end()) {
        found = summaries.emplace(summaries.end());
        found->name = judged.feature;
      }
      count(*found, judged, mesh->judgement);
      count(all, judged, mesh->judgement);
    }
  summaries.push_back(all);
  for (FeatureSummary& summary : summaries) {
    const auto n = static_cast<double>(std::max<std::size_t>(1, summary.measured));
    summary.distance /= n;
    summary.edges /= n;
    summary.diagonal /= n;
  }
  return summaries;
}

Reliability reliability(const std::vector<const MeshEvaluation*>& meshes) {
  Reliability reliability;
  reliability.bins.resize(bins);
  for (const MeshEvaluation* mesh : meshes) {
    if (!mesh->error.empty()) continue;
    for (const FeatureJudgement& judged : mesh->judgement.features)
      count(reliability, judged.probability, is_right(judged.verdict));
    if (mesh->class_known()) count(reliability, mesh->class_probability, mesh->class_right());
  }
  for (ReliabilityBin& bin : reliability.bins) {
    if (bin.count == 0) continue;
    const auto n = static_cast<double>(bin.count);
    bin.probability /= n;
    reliability.expected_calibration_error +=
        n / static_cast<double>(reliability.count) * std::abs(static_cast<double>(bin.right) / n - bin.probability);
  }
  return reliability;
}

std::map<std::string, std::map<std::string, std::size_t>> confusion(const std::vector<const MeshEvaluation*>& meshes) {
  std::map<std::string, std::map<std::string, std::size_t>> counts;
  for (const MeshEvaluation* mesh : meshes)
    if (mesh->class_known()) ++counts[mesh->expected_class][mesh->found_class.empty() ? "unknown" : mesh->found_class];
  return counts;
}

}  // namespace toposcope
