// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "model/model.h"
#include "result/result.h"
#include "truth/truth.h"

namespace toposcope {

enum class Verdict {
  right,     ///< the mesh has it, and it was found where it is
  wrong,     ///< found elsewhere
  missed,    ///< the mesh has it, and it was reported missing
  absent,    ///< the mesh does not have it, and so it was reported
  spurious,  ///< found although the mesh does not have it
};
std::string_view to_string(Verdict verdict);
inline bool is_right(Verdict verdict) {
  return verdict == Verdict::right || verdict == Verdict::absent;
}

/// How far a labelled feature may be from its marks and still be right. The marks' own repeat error is 0.06 to 0.3 mean
/// edges, and a handle's marks are rings around its ends.
struct Limits {
  double shape_edges = 2;        ///< mean distance from the marks to a circle, plane, ...; in mean edges
  double ends_diagonal = 0.05;   ///< either end of a segment from its group's centroid; part of the diagonal
  double lines_diagonal = 0.03;  ///< from the marks to a line group, and from the line group to the marks; likewise
};

struct FeatureJudgement {
  std::string feature;
  Verdict verdict = Verdict::absent;
  double distance =
      std::numeric_limits<double>::quiet_NaN();               ///< mean, from the marks to what was labelled, mesh unit;
                                                              ///< of ends the larger; not a number: nothing to measure
  double excess = std::numeric_limits<double>::quiet_NaN();   ///< what was measured over its limit: right up to 1
  double probability = 0;                                     ///< the result's, of what it said
  double offered = std::numeric_limits<double>::quiet_NaN();  ///< wrong or missed: the excess of the best candidate
                                                              ///< that the labeler could have chosen; up to 1: it could
};

struct Judgement {
  std::vector<FeatureJudgement> features;  ///< of the truth that the model knows, in the model's order
  double mean_edge = 0, diagonal = 0;      ///< that the limits refer to
  std::size_t right() const;
};

/// What a feature's shape is off over its limit: right up to 1. \param scale  its mean edge and diagonal
double excess_of(const FittedShape& shape, const ShapeFitter& fitter, const TruthFeature& truth, const Judgement& scale,
                 const Limits& limits = {});

/// Compares a result with the truth. Names that the model cannot tell apart may change places all at once, as a
/// renaming of the model allows: port and starboard of an airplane, the rims of a fitting.
/// \param analysis  that the result explains
Judgement judge(const Result& result, const Analysis& analysis, const Model& model, const Stations& stations,
                const Truth& truth, const Limits& limits = {});

}  // namespace toposcope
