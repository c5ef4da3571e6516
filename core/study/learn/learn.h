// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "learn/observe.h"
#include "model/model.h"

namespace toposcope {

/// A value of the model's file that is set anew.
struct Lesson {
  std::vector<std::string> path;  ///< features, rim, ranges, radius
  std::string value;              ///< as the file has it
  std::string before;             ///< "" where there was none
};

struct Learned {
  std::vector<Lesson> lessons;              ///< in the order of the model
  std::vector<std::string> contradictions;  ///< what marks say against the model as it was
};

/// Ranges, detectabilities and tolerances that marked meshes suggest: where the next mesh's values will lie with
/// probability `coverage` (learn/predictive.h). Ranges are set for the measures that the model bounds already, on the
/// sides that it bounds, in units of the side of bb(O) over which they vary least; tolerances where the marks need more
/// than there is.
Learned learn(const Model& model, const std::vector<Observation>& observations, double coverage);

/// The model's text with the lessons in it; all else stays, comments too. Each changed line says where it comes from.
/// \param file    for messages \param source  "3 meshes: a.truth.json, ..."
std::string with_lessons(const std::string& text, const std::string& file, const std::vector<Lesson>& lessons,
                         const std::string& source);

}  // namespace toposcope
