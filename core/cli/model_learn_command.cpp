// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "base/errors.h"
#include "base/text_file.h"
#include "commands.h"
#include "io/mesh_io.h"
#include "learn/learn.h"
#include "model/read_model.h"
#include "options.h"
#include "output.h"
#include "resources.h"
#include "session.h"
#include "truth/truth.h"

namespace toposcope::cli {
namespace {

struct LearnOptions : CommonOptions {
  std::string model;
  std::vector<fs::path> truths;
  fs::path out;
  double coverage = 0.99;
};

/// The mesh that a truth file names, beside it.
fs::path mesh_of(const fs::path& file, const Truth& truth) {
  const auto document = nlohmann::json::parse(truth.document);
  const std::string name = document.value("mesh", "");
  const fs::path mesh = file.parent_path() / name;
  std::error_code error;
  if (name.empty() || !fs::is_regular_file(mesh, error))
    throw UsageError(file.string() +
                     ": /mesh: " + (name.empty() ? "names no mesh" : "'" + name + "' is not beside it") +
                     "; the mesh that was marked is needed, in the same folder");
  return mesh;
}

std::string source_of(const std::vector<Observation>& observations) {
  std::string names;
  for (const Observation& each : observations) names += (names.empty() ? "" : ", ") + each.source;
  const std::string count = fmt::format("{} mesh{}", observations.size(), observations.size() == 1 ? "" : "es");
  return "learned from " + (observations.size() > 4 ? count : names);
}

void say_what_was_learned(const Learned& learned) {
  for (const Lesson& lesson : learned.lessons)
    say("  {:<40} {}{}\n", fmt::format("{}", fmt::join(lesson.path.begin() + 1, lesson.path.end(), ".")), lesson.value,
        lesson.before.empty() ? "" : "   (was " + lesson.before + ")");
  for (const std::string& each : learned.contradictions) say("  against the model: {}\n", each);
}

int model_learn(const LearnOptions& options) {
  PipelineSession session(options);
  const fs::path file = find_resource("models", options.model);
  const std::string text = read_text_file(file, "model");
  const Model model = model_from_text(text, file.string(), &session.host().catalog());
  const Stations stations = session.stations(model);
  std::vector<Observation> observations;
  for (const fs::path& path : options.truths) {
    const Truth truth = read_truth(path);
    const RepairedMesh mesh = session.read(mesh_of(path, truth));
    observations.push_back(observe(mesh.mesh, truth, path.filename().string(), model, stations, session.context()));
    stop_if_cancelled(session.context(), options.out.string() + " was not written");
  }
  const Learned learned = learn(model, observations, options.coverage);
  const std::string written = with_lessons(text, file.string(), learned.lessons, source_of(observations));
  model_from_text(written, options.out.string(), &session.host().catalog());
  write_file(options.out, written);
  session.status("");
  say("{}: model '{}', {}\n", options.out.string(), model.name, source_of(observations));
  say_what_was_learned(learned);
  return 0;
}

}  // namespace

void add_model_learn(CLI::App& model, int& code) {
  CLI::App& command =
      *model.add_subcommand("learn", "set ranges, detectabilities and tolerances by a few marked meshes");
  const auto options = std::make_shared<LearnOptions>();
  command.add_option("model", options->model, "name or file")->required();
  command.add_option("--from", options->truths, "truth files, each beside its mesh")->required()->type_name("TRUTH...");
  command.add_option("-o,--out", options->out, "model to write; may be the one that is read")
      ->required()
      ->type_name("FILE");
  command.add_option("--coverage", options->coverage, "share of the next meshes that each range is to hold")
      ->check(CLI::Range(0.5, 0.9999))
      ->capture_default_str();
  add_common(command, *options);
  command.callback([options, &code] { code = model_learn(*options); });
}

}  // namespace toposcope::cli
