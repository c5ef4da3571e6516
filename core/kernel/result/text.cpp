// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/csv.h"
#include "io/mesh_io.h"
#include "result/exactness.h"
#include "result/palette.h"
#include "result/repair_words.h"
#include "result/result.h"

namespace toposcope {
namespace {

/// The dissertation's ranking of labellings makes no probabilities.
std::string probability(double value) {
  return std::isnan(value) ? "-" : fmt::format("{:.3f}", value);
}

std::string value_of(const FeatureReport& report) {
  std::string text;
  for (const Measure& measure : report.shape.measures)
    if (text.size() < 60)
      text += fmt::format("{}{} {:.4g}{}", text.empty() ? "" : ", ", measure.name, measure.value,
                          measure.sd > 0 ? fmt::format(" +- {:.2g}", measure.sd) : "");
  return text;
}

std::string measures_text(const Measurements& measured) {
  std::size_t name = 7, expression = 10;
  for (const Measurement& each : measured.all) {
    name = std::max(name, each.name.size());
    expression = std::max(expression, each.expression.size());
  }
  std::string text = fmt::format("\n  {:<{}} {:<{}} {:>10} {:>10} {}\n", "measure", name, "expression", expression,
                                 "value", "sd", "unit");
  for (const Measurement& each : measured.all)
    text += each.why.empty()
                ? fmt::format("  {:<{}} {:<{}} {:>10.5g} {:>10.2g} {}\n", each.name, name, each.expression, expression,
                              each.value, each.sd, each.unit)
                : fmt::format("  {:<{}} {:<{}} {}\n", each.name, name, each.expression, expression, each.why);
  return text;
}

std::string families_text(const std::vector<FamilyReport>& families) {
  std::string text =
      fmt::format("\n  {:<14}{:<9}{:<6}  {}\n", "family", "found", "prob.", "instances that the model allows");
  for (const FamilyReport& report : families) {
    text += fmt::format("  {:<14}{:<9}{:<6}  {}", report.name, report.found, probability(report.probability),
                        report.allowed);
    if (report.more)
      text += fmt::format("; if it allowed any number there would be {}, and more than {} with probability {:.3f}",
                          report.likely, report.found, *report.more);
    text += "\n";
  }
  return text;
}

}  // namespace

std::string to_text(const Result& result) {
  std::string text = fmt::format("{}: model '{}', {}", result.mesh_path, result.model, result.status);
  for (const ClassReport& each : result.classes)
    if (each.name == result.class_name) text += fmt::format(", class {} ({:.3f})", each.name, each.probability);
  text += fmt::format("\n  {} vertices, {} faces, box {:.4g} x {:.4g} x {:.4g}, mean edge {:.3g}\n", result.vertices,
                      result.faces, result.box.a(), result.box.b(), result.box.c(), result.mean_edge);
  if (const auto& coarse = result.analysed)
    text += fmt::format("  analysed on {} faces, mean edge {:.3g}\n", coarse->faces, coarse->mean_edge);
  if (result.repair.notable()) text += fmt::format("  repaired: {}\n", repair_in_words(result.repair));
  text += "\n";
  text += fmt::format("  {:<14}{:<9}{:<6}  {:<11}{:<44} {:>9} {:>6}\n", "feature", "", "prob.", "shape", "measured",
                      "fit error", "faces");
  for (const FeatureReport& report : result.features) {
    if (report.present)
      text += fmt::format("  {:<14}{:<9}{:<6}  {:<11}{:<44} {:>9.3g} {:>6}\n", report.name, "found",
                          probability(report.probability), report.shape_plugin, value_of(report), report.shape.rms,
                          report.faces.size());
    else
      text += fmt::format("  {:<14}{:<9}{:<6}  {}\n", report.name, "missing", probability(report.probability),
                          report.missing.reason);
    if (report.missing.conflict) text += fmt::format("  {:<31}{}\n", "", in_words(*report.missing.conflict));
    for (const RelationReport& failed : report.missing.failed)
      text += failed.applicable ? fmt::format("  {:<31}{} {}: residual {:.4g} {}, tolerance {:.3g}\n", "", failed.name,
                                              failed.type, failed.residual, failed.unit, failed.tolerance)
                                : fmt::format("  {:<31}{} {}: {}\n", "", failed.name, failed.type, failed.why);
  }
  if (!result.families.empty()) text += families_text(result.families);
  if (result.probability_exactness != Exactness::none)
    text += fmt::format("\n  probabilities: {}\n", in_words(result.probability_exactness, result.probability_error));
  std::size_t name = 5, type = 21;  // the columns are as wide as what stands in them
  for (const RelationReport& report : result.relations) {
    name = std::max(name, report.name.size());
    type = std::max(type, report.type.size());
  }
  text += fmt::format("\n  {:<{}} {:<{}} {:<34}{:>10} {:>10} {:<7}{:<12}{:>6}\n", "", name, "relationship", type,
                      "features", "residual", "tolerance", "unit", "", "prob.");
  for (const RelationReport& report : result.relations) {
    const std::string features = fmt::format("{}", fmt::join(report.features, ", "));
    if (report.tested && report.applicable)
      text += fmt::format("  {:<{}} {:<{}} {:<34}{:>10.4g} {:>10.4g} {:<7}{:<12}{:>6.3f}\n", report.name, name,
                          report.type, type, features, report.residual, report.tolerance, report.unit,
                          report.satisfied ? "satisfied" : "not met", report.probability);
    else
      text += fmt::format("  {:<{}} {:<{}} {:<34}{}\n", report.name, name, report.type, type, features, report.why);
  }
  if (result.sides)
    text += fmt::format("\n  right and left by up and front, probability {:.3f}\n", result.sides->probability);
  if (!result.measurements.all.empty()) text += measures_text(result.measurements);
  return text;
}

std::string measures_csv_head(const Model& model) {
  std::string row = "mesh";
  for (const ModelMeasure& measure : model.measures)
    row += "," + csv_field(measure.name) + "," + csv_field(measure.name + "_sd");
  return row + "\n";
}

std::string measures_csv_row(const Result& result) {
  std::string row = csv_field(result.mesh_path);
  for (const Measurement& each : result.measurements.all)
    row += each.why.empty() ? fmt::format(",{},{}", each.value, each.sd) : ",,";
  return row + "\n";
}

void write_labels(const std::filesystem::path& path, const Mesh& input, const Result& result) {
  const MeshView& view = input.view();
  std::vector<Rgb> colors(view.face_count(), no_label_color);
  std::vector<std::int32_t> labels(view.face_count(), 0);
  for (std::size_t f = 0; f < result.features.size(); ++f)
    for (Index t : result.features[f].triangles) {
      colors[t] = feature_color(f);
      labels[t] = static_cast<std::int32_t>(f + 1);
    }
  write_mesh(path, view.positions, view.triangles, {colors, labels, input.face_origin()});
}

}  // namespace toposcope
