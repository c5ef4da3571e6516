// SPDX-License-Identifier: BSD-3-Clause
#include "result/feature_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/csv.h"

namespace toposcope {
namespace {

std::string cell(double value) {
  return std::isfinite(value) ? fmt::format(",{}", value) : ",";
}

std::string cells(const Vec3& v) {
  return cell(v.x()) + cell(v.y()) + cell(v.z());
}

}  // namespace

void FeatureTable::add(const Result& result) {
  for (const FeatureReport& report : result.features) {
    if (!report.present) continue;
    Record& record = records_.emplace_back(Record{result.mesh_path, report});
    record.report.triangles.clear();
    record.report.faces.clear();
    record.report.shape.outline.clear();
    for (const Measure& measure : report.shape.measures)
      if (std::find(measures_.begin(), measures_.end(), measure.name) == measures_.end())
        measures_.push_back(measure.name);
  }
}

std::string FeatureTable::csv() const {
  std::string text = "mesh,feature,shape,probability,fit_error,x,y,z,direction_x,direction_y,direction_z";
  for (const std::string& name : measures_) text += "," + csv_field(name) + "," + csv_field(name + "_sd");
  text += "\n";
  for (const auto& [mesh, report] : records_) {
    const FittedShape& shape = report.shape;
    text += csv_field(mesh) + "," + csv_field(report.name) + "," + csv_field(report.shape_plugin) +
            cell(report.probability) + cell(shape.rms) + cells(shape.centroid);
    text += shape.orientation == Orientation::none ? ",,," : cells(shape.direction);
    for (const std::string& name : measures_) {
      const Measure* measure = shape.measure(name);
      text += measure ? cell(measure->value) + cell(measure->sd) : ",,";
    }
    text += "\n";
  }
  return text;
}

}  // namespace toposcope
