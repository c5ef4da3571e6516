// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/analysis.h"
#include "truth/judgement.h"

namespace toposcope {

/// A labeler with its options, under the name that the tables give it.
struct Contender {
  std::string name;  ///< the plugin's id, with the options that were given
  std::string id;
  std::shared_ptr<const Labeler> labeler;
};

/// What one labeler made of one mesh. Bounds are of the labelling problem as the model poses it, the same for all; to
/// tell interchangeable features apart changes the cost of no labelling.
struct Entry {
  std::string labeler;
  std::string class_name;  ///< of the model that it found best; the model's own name without
  std::vector<std::pair<std::string, Index>> labeling;  ///< feature and number of its candidate; 0: missing
  double cost = 0;       ///< of its first labelling; infinite: it breaks a hard constraint
  double bound = 0;      ///< no labelling costs less: the best bound of all labelers
  bool proven = false;   ///< its cost is the optimum, to rounding: cost = bound
  double posterior = 0;  ///< of the labelling, exp(-cost) / sum over all; may be no number
  double time_ms = 0;    ///< the labeler's own, without that of the probabilities
  std::uint64_t nodes = 0;
  std::optional<std::size_t> right, of;  ///< features right of those that the truth tells of; none without truth
  std::string guarantee;
  std::string error = {};  ///< empty: it went through; else why there is no labelling
  double gap() const { return cost - bound; }
};

/// One mesh under all labelers, in the order given.
struct Comparison {
  std::string mesh;
  std::vector<Entry> entries;
};

/// A labeler over all meshes.
struct Total {
  std::string labeler;
  std::size_t meshes = 0, proven = 0;  ///< of which its labelling is the optimum, known as such
  std::size_t unsound = 0;             ///< of which its labelling breaks a hard constraint
  double mean_gap = 0, worst_gap = 0;  ///< over the other meshes
  double mean_posterior = 0;           ///< over the meshes that have one; not a number without any
  double median_ms = 0, worst_ms = 0;
  std::uint64_t nodes = 0;
  std::size_t right = 0, of = 0;
};
std::vector<Total> totals(const std::vector<Comparison>& comparisons);

/// Called after each labeler, with what it made of the mesh.
using LabelerObserver = std::function<void(const Contender&, const Analysis&, const Result&)>;

/// Solves the problem of a mesh with each labeler.
/// \param analysis  constructed; its labels are replaced
/// \param stations  of the pipeline; its marginals serve every labeler
/// \param truth     null: unknown
Comparison compare(Analysis& analysis, const Model& model, const Stations& stations, const std::string& mesh,
                   const std::vector<Contender>& contenders, const LabelingRequest& request, const Truth* truth,
                   Context& context, const LabelerObserver& observer = {});

/// The table of one mesh, and that over all.
std::string to_text(const Comparison& comparison);
std::string to_text(const std::vector<Total>& totals);
/// One object per mesh and one of totals.
std::string to_json(const std::vector<Comparison>& comparisons);
/// One row per mesh and labeler, with a header line; a labeler's total has no mesh.
std::string to_csv(const std::vector<Comparison>& comparisons);
/// The table over all, for a document.
std::string to_markdown(const std::vector<Total>& totals);

}  // namespace toposcope
