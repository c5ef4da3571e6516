// SPDX-License-Identifier: BSD-3-Clause
#include "model/model_reading.h"

namespace toposcope {

std::vector<ModelMeasure> read_measures(const YAML::Node& root, const std::vector<ModelFeature>& features,
                                        const ModelReading& reading) {
  std::vector<ModelMeasure> measures;
  if (!root["measures"]) return measures;
  for (const auto& entry : root["measures"]) {
    const YAML::Node& text = entry.second;
    reading.attempt(text, [&] {
      measures.push_back({entry.first.Scalar(),
                          MeasureExpression::parse(text.Scalar(), reading.at(text), features, reading.catalog),
                          reading.at(entry.first)});
    });
  }
  return measures;
}

}  // namespace toposcope
