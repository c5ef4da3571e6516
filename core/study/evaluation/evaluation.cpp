// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/evaluation.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <mutex>
#include <new>

#include "base/errors.h"
#include "base/sha256.h"
#include "evaluation/dataset_mesh.h"
#include "result/result.h"

namespace toposcope {
namespace {

/// Of one mesh among many: no progress of its own, and chunks in a row where meshes run side by side.
class MeshContext final : public Context {
 public:
  MeshContext(Context& outer, const std::string& name, bool alone) : outer_(outer), name_(name), alone_(alone) {}
  void log(LogLevel level, std::string_view message) override {
    outer_.log(std::min(level, LogLevel::info), name_ + ": " + std::string(message));
  }
  void progress(double) override {}
  bool cancelled() const override { return outer_.cancelled(); }
  std::uint64_t seed() const override { return outer_.seed(); }
  unsigned threads() const override { return alone_ ? outer_.threads() : 1; }
  void parallel_for(std::size_t count, std::size_t grain,
                    const std::function<void(std::size_t, std::size_t)>& body) override {
    if (alone_) return outer_.parallel_for(count, grain, body);
    const std::size_t step = std::max<std::size_t>(1, grain);
    for (std::size_t first = 0; first < count; first += step) body(first, std::min(count, first + step));
  }
  std::uint64_t memory_budget() const override { return outer_.memory_budget() / (alone_ ? 1 : outer_.threads()); }

 private:
  Context& outer_;
  const std::string& name_;
  bool alone_;
};

class Evaluator {
 public:
  Evaluator(const Model& model, const Stations& stations, PluginHost& host, bool by_class, const MeshObserver& observer)
      : model_(model), stations_(stations), host_(host), by_class_(by_class), observer_(observer) {}

  MeshEvaluation mesh(std::size_t number, const DatasetMesh& item, Context& context) const {
    MeshEvaluation evaluation;
    evaluation.name = item.name;
    evaluation.object = item.object;
    evaluation.variant = item.variant;
    if (const auto* file = std::get_if<MeshFile>(&item.source)) evaluation.expected_class = file->class_name;
    try {
      const KnownMesh known = load(item, host_, context);
      if (!model_.classes.empty() && evaluation.expected_class.empty())
        evaluation.expected_class = known.truth.class_name;
      label(number, known, evaluation, context);
      // Nothing to compare with is no success.
      if (by_class_ && !evaluation.class_known())
        throw UsageError(item.name + ": its class is not known; give it in the data set, or in a truth file");
      if (!by_class_ && evaluation.judgement.features.empty())
        throw UsageError(item.name + ": no truth of the model's features; put <mesh>.truth.json beside the mesh");
    } catch (const Error& error) {
      if (context.cancelled()) throw;
      miss_all(error.what(), evaluation);
    } catch (const std::bad_alloc&) {
      miss_all(item.name + ": out of memory; give fewer faces, or fewer meshes at once with --threads", evaluation);
    }
    return evaluation;
  }

 private:
  void miss_all(const std::string& why, MeshEvaluation& evaluation) const {
    evaluation.error = why;
    evaluation.judgement = {};
    for (const ModelFeature& feature : model_.features)
      evaluation.judgement.features.push_back({.feature = feature.name, .verdict = Verdict::missed});
  }

  void label(std::size_t number, const KnownMesh& known, MeshEvaluation& evaluation, Context& context) const {
    const auto start = std::chrono::steady_clock::now();
    const Analysis analysis = analyze(known.mesh, model_, stations_, {}, context);
    Result result = explain(analysis, model_, evaluation.name, stations_, context);
    result.repair = known.repair;
    const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - start;
    evaluation.time_ms = took.count();
    evaluation.faces = result.faces;
    evaluation.hash = result.mesh_hash;
    evaluation.judgement = judge(result, analysis, model_, stations_, known.truth);
    for (const RelationReport& relation : result.relations)
      if (relation.satisfied) evaluation.satisfied.push_back(relation.name);
    if (observer_) observer_({number, known, analysis, result, context});
    if (model_.classes.empty()) return;
    evaluation.found_class = result.class_name;
    evaluation.class_probability =
        result.class_name.empty() ? analysis.class_probabilities.back() : analysis.class_probabilities[analysis.best];
  }

  const Model& model_;
  const Stations& stations_;
  PluginHost& host_;
  bool by_class_;
  const MeshObserver& observer_;
};

}  // namespace

Evaluation evaluate(const Dataset& dataset, const Model& model, const Stations& stations, PluginHost& host,
                    Context& context, const MeshObserver& observer) {
  const auto start = std::chrono::steady_clock::now();
  Evaluation evaluation;
  evaluation.dataset = dataset.name;
  evaluation.summary = dataset.summary;
  evaluation.model = dataset.model;
  evaluation.model_hash = sha256_of_text(model.document);
  evaluation.by_class = dataset.by_class;
  evaluation.absent = dataset.absent;
  evaluation.meshes.resize(dataset.meshes.size());
  const Evaluator evaluator(model, stations, host, dataset.by_class, observer);
  const bool alone = dataset.meshes.size() < 2 * context.threads();
  std::mutex mutex;
  std::size_t finished = 0;
  const auto one = [&](std::size_t i) {
    if (context.cancelled()) return;
    MeshContext inner(context, dataset.meshes[i].name, alone);
    evaluation.meshes[i] = evaluator.mesh(i, dataset.meshes[i], inner);
    const std::lock_guard lock(mutex);
    context.progress(static_cast<double>(++finished) / static_cast<double>(dataset.meshes.size()));
  };
  if (alone)
    for (std::size_t i = 0; i < dataset.meshes.size(); ++i) one(i);
  else
    context.parallel_for(dataset.meshes.size(), 1, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) one(i);
    });
  if (context.cancelled()) throw Error("interrupted", interrupted_exit_code);
  evaluation.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return evaluation;
}

std::vector<const MeshEvaluation*> all_of(const Evaluation& evaluation) {
  std::vector<const MeshEvaluation*> meshes;
  for (const MeshEvaluation& mesh : evaluation.meshes) meshes.push_back(&mesh);
  return meshes;
}

}  // namespace toposcope
