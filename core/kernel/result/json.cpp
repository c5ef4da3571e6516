// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <nlohmann/json.hpp>

#include "result/classification.h"
#include "result/exactness.h"
#include "result/repair_words.h"
#include "result/result.h"
#include "result/shape_json.h"

namespace toposcope {
namespace {

using Json = nlohmann::ordered_json;

/// JSON has no NaN or infinity.
Json number(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

Json fit(const FittedShape& shape) {
  static constexpr const char* terminations[] = {"closed-form", "converged", "iteration-limit", "failed", "degenerate"};
  Json object = {{"termination", terminations[static_cast<std::size_t>(shape.summary.termination)]},
                 {"iterations", shape.summary.iterations},
                 {"initial_cost", number(shape.summary.initial_cost)},
                 {"final_cost", number(shape.summary.final_cost)},
                 {"explained", shape.explained},
                 {"unexplained", shape.unexplained},
                 {"coverage", shape.coverage}};
  if (!shape.summary.message.empty()) object["message"] = shape.summary.message;
  return object;
}

Json uncertainty(const FittedShape& shape) {
  Json object = Json::object();
  for (const Measure& measure : shape.measures) object[measure.name] = number(measure.sd);
  object["centroid"] = number(shape.centroid_sd);
  if (shape.orientation != Orientation::none) object["direction_deg"] = number(shape.direction_sd * 180 / pi);
  if (!shape.covariance_of.empty()) {
    object["covariance_of"] = shape.covariance_of;
    Json rows = Json::array();
    const std::size_t n = shape.covariance_of.size();
    for (std::size_t i = 0; i < n; ++i) {
      Json row = Json::array();
      for (std::size_t j = 0; j < n; ++j) row.push_back(number(shape.covariance[i * n + j]));
      rows.push_back(std::move(row));
    }
    object["covariance"] = std::move(rows);
  }
  return object;
}

Json measures(const FittedShape& shape) {
  Json object = Json::object();
  for (const Measure& measure : shape.measures) object[measure.name] = number(measure.value);
  return object;
}

Json relation(const RelationReport& report) {
  Json object = {{"name", report.name}, {"type", report.type}, {"features", report.features}};
  object["tested"] = report.tested;
  if (report.tested && report.applicable) {
    object["residual"] = number(report.residual);
    object["tolerance"] = number(report.tolerance);
    object["unit"] = report.unit;
    object["satisfied"] = report.satisfied;
    object["probability"] = number(report.probability);
  } else {
    object["satisfied"] = false;
    object["why"] = report.why;
  }
  return object;
}

Json feature(const FeatureReport& report) {
  Json object = {{"present", report.present}};
  if (report.present) {
    object["probability"] = number(report.probability);
    object["evidence"] = number(report.evidence);
    object["shape"] = report.shape_plugin;
    object["parameters"] = parameters_json(report.shape.parameters);
    object["measures"] = measures(report.shape);
    object["fit_error"] = number(report.shape.rms);
    object["fit"] = fit(report.shape);
    object["uncertainty"] = uncertainty(report.shape);
    object["working_sets"] = report.working_sets;
    object["faces"] = report.faces;
    return object;
  }
  object["probability_missing"] = number(report.probability);
  Json why = {{"reason", report.missing.reason}};
  if (report.missing.nearest) {
    why["nearest_candidate"] = {{"parameters", parameters_json(report.missing.nearest->parameters)},
                                {"fit_error", number(report.missing.nearest->rms)},
                                {"cost", number(report.missing.nearest_cost)}};
    why["relations_failed"] = Json::array();
    for (const RelationReport& failed : report.missing.failed) why["relations_failed"].push_back(relation(failed));
  }
  if (const auto& conflict = report.missing.conflict)
    why["conflict"] = {
        {"relations", conflict->relations}, {"exclusions", conflict->exclusions}, {"smallest", conflict->smallest}};
  object["why"] = std::move(why);
  return object;
}

/// Numbers of a probability that counts; others are as good as 0.
Json family(const FamilyReport& report) {
  Json object = {{"allowed", report.allowed}, {"found", report.found}, {"probability", number(report.probability)}};
  object["numbers"] = Json::object();
  for (std::size_t k = 0; k < report.numbers.size(); ++k)
    if (report.numbers[k] >= 1e-6) object["numbers"][std::to_string(k)] = report.numbers[k];
  if (report.more) object["more_than_allowed"] = {{"probability", *report.more}, {"likely_number", report.likely}};
  return object;
}

Json measurement(const Measurement& each) {
  Json object = {{"expression", each.expression}, {"unit", each.unit}};
  if (!each.why.empty()) {
    object["value"] = nullptr;
    object["why"] = each.why;
  } else {
    object["value"] = number(each.value);
    object["sd"] = number(each.sd);
  }
  return object;
}

/// Of those that have a value.
Json measurement_covariance(const Measurements& measured) {
  Json of = Json::array(), rows = Json::array();
  for (std::size_t i = 0; i < measured.all.size(); ++i) {
    if (!measured.all[i].why.empty()) continue;
    of.push_back(measured.all[i].name);
    Json row = Json::array();
    for (std::size_t j = 0; j < measured.all.size(); ++j)
      if (measured.all[j].why.empty()) row.push_back(number(measured.between(i, j)));
    rows.push_back(std::move(row));
  }
  return {{"of", of}, {"covariance", rows}};
}

Json candidate_count(const CandidateCount& count) {
  Json bounds = Json::array();
  for (const BoundCount& bound : count.bounds)
    bounds.push_back({{"bound", bound.words},
                      {"groups", bound.groups},
                      {"nearest", number(bound.nearest)},
                      {"limit", number(bound.limit)}});
  return {{"kept", count.kept},
          {"groups", count.groups},
          {"boxed_out", count.boxed_out},
          {"unusable", count.unusable},
          {"out_of_range", count.out_of_range},
          {"poor_fit", count.poor_fit},
          {"beaten", count.beaten},
          {"broken_bounds", bounds}};
}

Json directions(const Sides& sides) {
  const auto axis = [](const OwnAxis& each) {
    return Json{each.direction.x(), each.direction.y(), each.direction.z()};
  };
  return {{"up", axis(*sides.axes.up)},
          {"front", axis(*sides.axes.front)},
          {"right", axis(*sides.axes.right)},
          {"probability", number(sides.probability)}};
}

Json document(const Result& result) {
  Json root;
  root["schema"] = "toposcope.result/1";
  root["mesh"] = {{"path", result.mesh_path},
                  {"sha256", result.mesh_hash},
                  {"vertices", result.vertices},
                  {"faces", result.faces},
                  {"box", {{"a", result.box.a()}, {"b", result.box.b()}, {"c", result.box.c()}}},
                  {"mean_edge", result.mean_edge},
                  {"components", result.repair.components},
                  {"closed_components", result.repair.closed_components},
                  {"holes", result.repair.holes},
                  {"euler", result.repair.euler},
                  {"genus", result.repair.genus}};
  if (const auto& coarse = result.analysed)
    root["mesh"]["analysed"] = {
        {"vertices", coarse->vertices}, {"faces", coarse->faces}, {"mean_edge", coarse->mean_edge}};
  for (const RepairCount& each : repair_counts(result.repair)) root["mesh"]["repair"][each.name] = each.count;
  root["model"] = result.model;
  root["model_sha256"] = result.model_hash;
  root["status"] = result.status;
  root["class"] = result.class_name.empty() ? Json(nullptr) : Json(result.class_name);
  for (const ClassReport& each : result.classes) root["class_probabilities"][each.name] = each.probability;
  root["log_evidence"] = number(result.log_evidence);
  root["optimal"] = result.optimal;
  root["guarantee"] = result.guarantee;
  root["probabilities"] = result.probabilities.empty() ? Json(nullptr) : Json(result.probabilities);
  root["probability_exactness"] = name_of(result.probability_exactness);
  root["probability_error"] =
      result.probability_exactness == Exactness::bound ? Json(result.probability_error) : Json(nullptr);
  root["features"] = Json::object();
  for (const FeatureReport& report : result.features) root["features"][report.name] = feature(report);
  if (!result.families.empty())
    for (const FamilyReport& report : result.families) root["families"][report.name] = family(report);
  if (result.sides) root["directions"] = directions(*result.sides);
  root["relations"] = Json::array();
  for (const RelationReport& report : result.relations) root["relations"].push_back(relation(report));
  if (!result.measurements.all.empty()) {
    for (const Measurement& each : result.measurements.all) root["measures"][each.name] = measurement(each);
    root["measures_covariance"] = measurement_covariance(result.measurements);
  }
  root["alternatives"] = Json::array();
  for (const AlternativeReport& report : result.alternatives) {
    Json alternative = {{"probability", number(report.probability)}, {"cost", number(report.cost)}};
    for (const auto& [name, rank] : report.candidates) alternative["candidates"][name] = rank;
    root["alternatives"].push_back(std::move(alternative));
  }
  root["working_sets"] = result.working_sets;
  root["candidates"] = Json::object();
  for (const auto& [name, count] : result.candidates) root["candidates"][name] = candidate_count(count);
  for (const auto& [station, ms] : result.timings) root["timings_ms"][station] = std::round(ms * 1000) / 1000;
  root["plugins"] = Json::array();
  for (const PluginUse& use : result.plugins) {
    Json options = Json::object();
    for (const auto& [name, value] : use.options) options[name] = value;
    root["plugins"].push_back({{"kind", use.kind}, {"id", use.id}, {"version", use.version}, {"options", options}});
  }
  return root;
}

}  // namespace

std::string to_json(const Result& result) {
  return document(result).dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string to_json_line(const Result& result) {
  return document(result).dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string to_json_line(const Classification& classification) {
  Json root;
  root["schema"] = "toposcope.classification/1";
  root["mesh"] = classification.mesh_path;
  root["model"] = classification.model;
  root["class"] = classification.class_name.empty() ? Json(nullptr) : Json(classification.class_name);
  for (const auto& [name, probability] : classification.probabilities) root["probabilities"][name] = probability;
  root["relations"] = Json::array();
  for (const RelationReport& report : classification.relations) root["relations"].push_back(relation(report));
  return root.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace toposcope
