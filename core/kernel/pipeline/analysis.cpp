// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/analysis.h"

#include <algorithm>
#include <utility>

#include "base/errors.h"
#include "pipeline/construct_features.h"
#include "pipeline/label.h"
#include "pipeline/most_probable_shapes.h"
#include "pipeline/relate.h"
#include "pipeline/second_look.h"
#include "pipeline/stopwatch.h"

namespace toposcope {

ClassifiedMesh classify(const Mesh& mesh, const Stations& stations, const std::vector<std::string>& types,
                        Context& context) {
  ClassifiedMesh classified;
  Stopwatch watch;
  classified.mesh = prepare_mesh(mesh, stations, context);
  classified.timings.emplace_back("filter", watch.lap_ms());
  const MeshView& view = classified.mesh.view();
  classified.sets = MeasuredWorkingSets(classify_mesh(view, stations.working_sets, context), types, view, context);
  classified.timings.emplace_back("classify", watch.lap_ms());
  return classified;
}

Analysis construct(const Mesh& mesh, const Model& model, const Stations& stations, Context& context) {
  std::vector<std::string> types;
  add_asked_types(model, types);
  return construct(classify(mesh, stations, types, context), model, stations, context);
}

Analysis construct(ClassifiedMesh classified, const Model& model, const Stations& stations, Context& context) {
  Analysis analysis;
  analysis.mesh = std::move(classified.mesh);
  analysis.sets = std::move(classified.sets);
  analysis.timings = std::move(classified.timings);
  Stopwatch watch;
  const auto lap = [&](const char* station) { analysis.timings.emplace_back(station, watch.lap_ms()); };
  const ModelRun run{analysis.mesh.view(), model, stations, context};
  analysis.features = construct_features(run, analysis.sets);
  lap("fit");
  analysis.problem = relate(run, analysis.sets, analysis.features);
  lap("relate");
  if (has_second_look(model)) {
    const auto labelled = first_labeling(analysis.problem, run);
    if (look_again(run, analysis.sets, labelled, analysis.features))
      analysis.problem = relate(run, analysis.sets, analysis.features, &analysis.problem);
    lap("second_look");
  }
  if (context.cancelled()) throw Error("interrupted", interrupted_exit_code);
  return analysis;
}

void label(Analysis& analysis, const Model& model, const Stations& stations, const LabelingRequest& request,
           Context& context) {
  Stopwatch watch;
  const ModelRun run{analysis.mesh.view(), model, stations, context};
  std::vector<Explained> explained;
  double marginals_ms = 0;
  analysis.classes.clear();
  for (ClassOutcome& posed : pose_classes(analysis.problem, model, stations.probability)) {
    analysis.classes.push_back(label_class(std::move(posed), analysis.features, run, request));
    ClassOutcome& solved = analysis.classes.back();
    if (has_families(model)) {
      analysis.instances = write_out_instances(solved, analysis.features, run);
      solved.answer = solved.outcome.labelings.front();
    }
    complete_class(solved);
    explained.push_back({solved.log_evidence, solved.least_cost});
    marginals_ms += solved.marginals_ms;
  }
  analysis.class_evidence = comparable_evidence(explained);
  analysis.class_probabilities = class_probabilities(analysis.class_evidence);
  analysis.best =
      static_cast<std::size_t>(std::max_element(analysis.class_evidence.begin(), analysis.class_evidence.end()) -
                               analysis.class_evidence.begin());
  std::erase_if(analysis.timings, [](const auto& each) { return each.first == "label" || each.first == "marginals"; });
  analysis.timings.emplace_back("label", watch.lap_ms() - marginals_ms);
  if (stations.marginals) analysis.timings.emplace_back("marginals", marginals_ms);
  if (context.cancelled()) throw Error("interrupted", interrupted_exit_code);
}

Analysis analyze(const Mesh& mesh, const Model& model, const Stations& stations, const LabelingRequest& request,
                 Context& context) {
  std::vector<std::string> types;
  add_asked_types(model, types);
  return analyze(classify(mesh, stations, types, context), model, stations, request, context);
}

Analysis analyze(ClassifiedMesh classified, const Model& model, const Stations& stations,
                 const LabelingRequest& request, Context& context) {
  Analysis analysis = construct(std::move(classified), model, stations, context);
  label(analysis, model, stations, request, context);
  Stopwatch watch;
  ClassOutcome& best = analysis.classes[analysis.best];
  if (analysis.instances) return analysis;  // shapes of instances depend on their number: no labeler can tell it
  best.answer = with_most_probable_shapes(best, analysis.features, {analysis.mesh.view(), model, stations, context});
  for (auto& [station, ms] : analysis.timings)
    if (station == "label") ms += watch.lap_ms();
  return analysis;
}

}  // namespace toposcope
