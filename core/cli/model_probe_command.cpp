// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "base/errors.h"
#include "base/nearest_name.h"
#include "commands.h"
#include "model/read_model.h"
#include "options.h"
#include "output.h"
#include "resources.h"
#include "result/probe.h"
#include "session.h"

namespace toposcope::cli {
namespace {

struct ProbeOptions : CommonOptions {
  std::string model;
  fs::path mesh;
  std::string feature;
  std::uint32_t most = 5;
};

/// Those that are asked for: one, or all.
std::vector<Index> asked_features(const Model& model, const std::string& name) {
  std::vector<Index> features;
  std::vector<std::string> names;
  for (Index f = 0; f < model.features.size(); ++f) {
    names.push_back(model.features[f].name);
    if (name.empty() || names.back() == name) features.push_back(f);
  }
  if (features.empty())
    throw UsageError("--feature " + name + ": model '" + model.name + "' has no such feature; " +
                     name_remedy(name, names));
  return features;
}

int model_probe(const ProbeOptions& options) {
  PipelineSession session(options);
  const Model model = read_model(find_resource("models", options.model), &session.host().catalog());
  const std::vector<Index> features = asked_features(model, options.feature);
  const Stations stations = session.stations(model);
  const RepairedMesh input = session.read(options.mesh);
  const Analysis analysis = analyze(input.mesh, model, stations, {}, session.context());
  std::vector<FeatureProbe> probes;
  for (const Index feature : features)
    probes.push_back(probe(analysis, model, stations, feature, options.most, session.context()));
  session.status("");
  if (options.json) {
    say("{}", to_json(probes, options.mesh.string(), model.name));
    return 0;
  }
  const Box& box = analysis.mesh.input->view().box;
  say("{}: model '{}', bb(O) {:.4g} x {:.4g} x {:.4g}\n", options.mesh.string(), model.name, box.a(), box.b(), box.c());
  for (const FeatureProbe& each : probes) say("\n{}", to_text(each));
  return 0;
}

}  // namespace

void add_model_probe(CLI::App& model, int& code) {
  CLI::App& command = *model.add_subcommand(
      "probe", "say what each bound of a feature rejected on a mesh, and what its candidates lack");
  const auto options = std::make_shared<ProbeOptions>();
  command.add_option("model", options->model, "name or file")->required();
  command.add_option("mesh", options->mesh, "mesh file")->required()->type_name("MESH");
  command.add_option("--feature", options->feature, "this feature alone");
  command.add_option("--most", options->most, "candidates to show of each feature")
      ->check(whole_number(0, 1000))
      ->capture_default_str();
  command.add_flag("--json", options->json, "print it as JSON");
  add_common(command, *options);
  command.callback([options, &code] { code = model_probe(*options); });
}

}  // namespace toposcope::cli
