// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "result/probe.h"
#include "result/shape_json.h"

namespace toposcope {
namespace {

using Json = nlohmann::ordered_json;

std::string bounds_text(const FeatureProbe& probe) {
  const CandidateCount& count = probe.count;
  std::string text = fmt::format("{}: {} on {}: {} groups, {} candidates", probe.name, probe.shape, probe.types,
                                 count.groups, count.kept);
  if (count.beaten > 0)
    text += fmt::format(" (and {} beaten: the same as a better one, or beyond their number)", count.beaten);
  text += "\n";
  if (count.unusable > 0) text += fmt::format("  {:>7} groups without a usable {}\n", count.unusable, probe.shape);
  for (const BoundCount& bound : count.bounds)
    text += fmt::format("  {:>7} groups break {} = {:.4g}; the nearest has {:.4g}\n", bound.groups, bound.words,
                        bound.limit, bound.nearest);
  return text;
}

std::string changes_text(const FeatureProbe& probe) {
  if (probe.changes.empty()) return "";
  std::string text = probe.changes.size() == 1 && probe.enough ? "  one change lets the nearest one in:\n"
                     : probe.enough ? "  the nearest one comes in when all of these change:\n"
                                    : "  these changes do not suffice; look at working set and shape:\n";
  for (const NeededChange& change : probe.changes)
    text += fmt::format("    {} -> {}   (it has {:.4g}, the bound is {:.4g})\n", change.bound, change.remedy,
                        change.value, change.limit);
  return text;
}

std::string candidate_text(const ProbedCandidate& candidate) {
  std::string text = fmt::format(
      "  {}{:>3}  prob. {}  evidence {:.4g}  cost over missing {:.4g}{}\n       ", candidate.labelled ? "*" : " ",
      candidate.rank, std::isnan(candidate.probability) ? "-" : fmt::format("{:.3f}", candidate.probability),
      candidate.evidence, candidate.cost, candidate.in_conflict ? "  shares vertices with another feature" : "");
  for (const Measure& measure : candidate.shape.measures)
    text += fmt::format(" {} {:.4g}{}", measure.name, measure.value,
                        measure.sd > 0 ? fmt::format(" +- {:.2g}", measure.sd) : "");
  text += fmt::format(" fit error {:.3g}\n", candidate.shape.rms);
  for (const RelationReport& relation : candidate.relations) {
    text += fmt::format("        {} {}({}): ", relation.name, relation.type, fmt::join(relation.features, ", "));
    text += relation.tested && relation.applicable
                ? fmt::format("residual {:.4g} {}, tolerance {:.4g}, {}\n", relation.residual, relation.unit,
                              relation.tolerance, relation.satisfied ? "satisfied" : "not met")
                : relation.why + "\n";
  }
  return text;
}

Json relation_json(const RelationReport& relation) {
  Json object = {{"name", relation.name}, {"type", relation.type}, {"features", relation.features}};
  if (relation.tested && relation.applicable) {
    object["residual"] = relation.residual;
    object["tolerance"] = relation.tolerance;
    object["unit"] = relation.unit;
  } else {
    object["why"] = relation.why;
  }
  object["satisfied"] = relation.satisfied;
  return object;
}

Json candidate_json(const ProbedCandidate& candidate) {
  Json object = {{"rank", candidate.rank},
                 {"labelled", candidate.labelled},
                 {"shares_vertices", candidate.in_conflict},
                 {"probability", candidate.probability},
                 {"evidence", candidate.evidence},
                 {"cost_over_missing", candidate.cost},
                 {"parameters", parameters_json(candidate.shape.parameters)},
                 {"fit_error", candidate.shape.rms}};
  object["measures"] = Json::object();
  for (const Measure& measure : candidate.shape.measures)
    object["measures"][measure.name] = {{"value", measure.value}, {"sd", measure.sd}};
  object["relations"] = Json::array();
  for (const RelationReport& relation : candidate.relations) object["relations"].push_back(relation_json(relation));
  return object;
}

Json probe_json(const FeatureProbe& probe) {
  Json object = {{"worksets", probe.types},          {"shape", probe.shape},     {"groups", probe.count.groups},
                 {"unusable", probe.count.unusable}, {"kept", probe.count.kept}, {"beaten", probe.count.beaten}};
  object["broken_bounds"] = Json::array();
  for (const BoundCount& bound : probe.count.bounds)
    object["broken_bounds"].push_back(
        {{"bound", bound.words}, {"groups", bound.groups}, {"nearest", bound.nearest}, {"limit", bound.limit}});
  object["candidates"] = Json::array();
  for (const ProbedCandidate& candidate : probe.candidates) object["candidates"].push_back(candidate_json(candidate));
  object["changes"] = Json::array();
  for (const NeededChange& change : probe.changes)
    object["changes"].push_back(
        {{"bound", change.bound}, {"value", change.value}, {"limit", change.limit}, {"remedy", change.remedy}});
  object["changes_suffice"] = probe.enough;
  return object;
}

}  // namespace

std::string to_text(const FeatureProbe& probe) {
  std::string text = bounds_text(probe) + changes_text(probe);
  for (const ProbedCandidate& candidate : probe.candidates) text += candidate_text(candidate);
  return text;
}

std::string to_json(const std::vector<FeatureProbe>& probes, const std::string& mesh, const std::string& model) {
  Json root = {{"mesh", mesh}, {"model", model}, {"features", Json::object()}};
  for (const FeatureProbe& probe : probes) root["features"][probe.name] = probe_json(probe);
  return root.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace toposcope
