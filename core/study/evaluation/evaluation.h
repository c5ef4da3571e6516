// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "evaluation/dataset_mesh.h"
#include "result/result.h"
#include "table/table.h"
#include "truth/judgement.h"

namespace toposcope {

class PluginHost;

/// What was made of one mesh.
struct MeshEvaluation {
  std::string name, object, variant;
  std::string hash;   ///< of its content (mesh/content_hash.h); empty: it was not read
  std::string error;  ///< empty: it went through; else why not, and all its features count as missed
  Index faces = 0;
  Judgement judgement;
  std::string found_class, expected_class;  ///< found: empty where no class fits; expected: empty where not known
  double class_probability = 0;             ///< of what was found
  std::vector<std::string> satisfied;       ///< relationships of the model that hold for the labelling
  double time_ms = 0;  ///< read, analysed and explained; on one thread where meshes run side by side

  bool class_known() const { return !expected_class.empty(); }
  bool class_right() const { return class_known() && found_class == expected_class; }
  bool features_right() const { return error.empty() && judgement.right() == judgement.features.size(); }
};

struct Evaluation {
  std::string dataset, summary, model, pipeline;
  std::string model_hash;  ///< SHA-256 of what its file says
  bool by_class = false;
  std::vector<MeshEvaluation> meshes;
  std::vector<std::string> absent;  ///< see Dataset
  double seconds = 0;               ///< of everything, made meshes included
  bool right(const MeshEvaluation& mesh) const { return by_class ? mesh.class_right() : mesh.features_right(); }
};

/// What was made of one mesh, while it is all there.
struct MeshAtHand {
  std::size_t number = 0;  ///< of the mesh in the data set
  const KnownMesh& known;
  const Analysis& analysis;
  const Result& result;
  Context& context;
};
/// Called once for each mesh that went through, from several threads.
using MeshObserver = std::function<void(const MeshAtHand&)>;

/// Labels every mesh of a data set and judges the result. Several meshes run side by side, each on one thread; the
/// numbers are the same at any thread count. A mesh that cannot be used is part of the result.
Evaluation evaluate(const Dataset& dataset, const Model& model, const Stations& stations, PluginHost& host,
                    Context& context, const MeshObserver& observer = {});

// ---- numbers ----

struct FeatureSummary {
  std::string name;
  std::size_t right = 0, wrong = 0, missed = 0, absent = 0, spurious = 0;
  std::size_t measured = 0;  ///< features that are there and were found: what the distances are means of
  double distance = 0, edges = 0, diagonal = 0;  ///< mean distance: mesh unit, mean edges, part of the diagonal
  double worst_edges = 0;
  std::size_t all() const { return right + wrong + missed + absent + spurious; }
};
/// Per feature in the model's order and, last, "all".
std::vector<FeatureSummary> summarize(const std::vector<const MeshEvaluation*>& meshes);

/// What was reported at about one probability.
struct ReliabilityBin {
  std::size_t count = 0, right = 0;
  double probability = 0;  ///< mean
};
struct Reliability {
  std::vector<ReliabilityBin> bins;  ///< ten, of equal width from 0 to 1
  std::size_t count = 0;
  double expected_calibration_error = 0;  ///< sum over bins of count / all * |right / count - probability|
};
/// Of every feature, found or reported missing, and, where the class is known, of every class.
Reliability reliability(const std::vector<const MeshEvaluation*>& meshes);

/// Expected class, then found class ("unknown": none fits), and how often.
std::map<std::string, std::map<std::string, std::size_t>> confusion(const std::vector<const MeshEvaluation*>& meshes);

std::vector<const MeshEvaluation*> all_of(const Evaluation& evaluation);

// ---- as tables ----

/// In the order of reading: distances (Table 6.1), classes (Table 6.3) or confusion, features, reliability, what went
/// wrong, time.
std::vector<Table> tables(const Evaluation& evaluation);
/// What differs from an earlier evaluation of the same name, from its JSON. \throw UsageError  it is none
std::vector<Table> changes(const Evaluation& evaluation, const std::string& baseline_json, const std::string& file);

/// One line that says how good it is.
std::string headline(const Evaluation& evaluation);
std::string to_json(const std::vector<Evaluation>& evaluations);
/// One row per mesh and feature; a mesh whose class is judged has one for its class.
std::string to_csv(const std::vector<Evaluation>& evaluations);

}  // namespace toposcope
