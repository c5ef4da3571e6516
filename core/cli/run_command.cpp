// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <chrono>

#include "base/errors.h"
#include "base/file_name.h"
#include "commands.h"
#include "formats/problem_io.h"
#include "io/mesh_io.h"
#include "lock/run_lock.h"
#include "model/read_model.h"
#include "options.h"
#include "output.h"
#include "output_folder.h"
#include "report_files.h"
#include "resources.h"
#include "result/feature_table.h"
#include "result/result.h"
#include "scene/scene.h"
#include "session.h"

namespace toposcope::cli {
namespace {

struct RunOptions : CommonOptions {
  std::vector<fs::path> meshes;
  std::string model;
  fs::path out;
  fs::path save_problem;  ///< empty: not written
  fs::path measures;      ///< likewise
  fs::path features;      ///< likewise
  bool report = true;
  fs::path lock, locked;  ///< write a lock file; refuse a run that differs from one
};

/// One file; of a model with classes one for each, FILE-<class>.
void save_problems(const fs::path& path, const Analysis& analysis, Context& context) {
  if (path.empty()) return;
  for (const ClassOutcome& each : analysis.classes) {
    fs::path file = path;
    if (analysis.classes.size() > 1)
      file.replace_filename(path.stem().string() + "-" + file_name(each.name) + path.extension().string());
    for (const std::string& note : write_problem(file, each.problem))
      context.log(LogLevel::info, file.string() + ": " + note);
  }
}

/// What is known of the mesh, to show it. A file that cannot be read costs a warning, not the result.
std::optional<Truth> truth_if_any(const fs::path& mesh, Context& context) {
  const fs::path file = truth_beside(mesh);
  if (file.empty()) return std::nullopt;
  try {
    return read_truth(file);
  } catch (const UsageError& error) {
    context.log(LogLevel::warning, std::string(error.what()) + "; its marks are not shown");
    return std::nullopt;
  }
}

/// Before any plugin is loaded and any mesh is read.
void lock_or_compare(const RunOptions& options, PipelineSession& session, const Model& model) {
  if (options.lock.empty() && options.locked.empty()) return;
  const RunLock now = lock_run({TOPOSCOPE_VERSION, locked_file(fs::canonical("/proc/self/exe"))}, options.seed,
                               session.pipeline(model), model, options.meshes, session.host().catalog());
  if (options.locked.empty())
    write_file(options.lock, to_json(now));
  else
    require_same(read_lock(options.locked), now, options.locked);
}

int run(const RunOptions& options) {
  if (!options.out.empty()) {
    refuse_same_stem(options.meshes, "--out");
    make_folder(options.out, "--out");
  }
  if (!options.save_problem.empty() && options.meshes.size() > 1)
    throw UsageError("--save-problem writes the problem of one mesh, and " + std::to_string(options.meshes.size()) +
                     " are given; run them one by one");
  if (!options.save_problem.empty()) require_problem_extension(options.save_problem);
  PipelineSession session(options);
  const Model model = read_model(find_resource("models", options.model), &session.host().catalog());
  if (!options.measures.empty() && model.measures.empty())
    throw UsageError("--measures " + options.measures.string() + ": model '" + model.name +
                     "' has no measures; add some under 'measures:', as in height: distance(rim, bottom)");
  if (!options.save_problem.empty() && has_families(model))
    throw UsageError("--save-problem " + options.save_problem.string() + ": model '" + model.name +
                     "' has families, and a problem file has no features in any number; give each instance a name");
  lock_or_compare(options, session, model);
  const Stations stations = session.stations(model);

  std::optional<Page> page;
  if (!options.out.empty() && options.report)
    page.emplace("report.html", "; --no-report says nothing of it", session.context());

  std::string measures = measures_csv_head(model);
  FeatureTable features;
  const int code = for_each_mesh(options.meshes, session, [&](const fs::path& path) {
    const auto start = std::chrono::steady_clock::now();
    const RepairedMesh input = session.read(path);
    const double read_ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    const Analysis analysis = analyze(input.mesh, model, stations, {}, session.context());
    save_problems(options.save_problem, analysis, session.context());
    Result result = explain(analysis, model, path.string(), stations, session.context());
    result.repair = input.repair;
    result.timings.insert(result.timings.begin(), {"read", read_ms});
    const fs::path folder = options.out / file_name(path.stem().string());
    if (!options.out.empty()) {
      make_folder(folder, "--out");
      write_labels(folder / "labels.ply", input.mesh, result);
      write_file(folder / "result.json", to_json(result));
      const std::optional<Truth> truth = truth_if_any(path, session.context());
      const Scene scene = make_scene(analysis, model, result, truth ? &*truth : nullptr);
      const std::string document = to_json(scene, program_name());
      write_file(folder / "scene.json", document);
      if (page) page->write(folder / "report.html", document);
    }
    session.status("");
    if (options.json)
      say("{}", to_json_line(result));
    else if (!options.quiet)
      say("{}\n", to_text(result));
    if (!options.out.empty() && !options.quiet && !options.json)
      say("  coloured mesh: {}\n  result:        {}\n{}\n", (folder / "labels.ply").string(),
          (folder / "result.json").string(),
          !page || !page->there() ? "" : "  to look at:    " + (folder / "report.html").string() + "\n");
    flush_output();
    measures += measures_csv_row(result);
    if (!options.features.empty()) features.add(result);
  });
  if (!options.measures.empty()) write_file(options.measures, measures);
  if (!options.features.empty()) write_file(options.features, features.csv());
  return code;
}

}  // namespace

void add_run(CLI::App& app, int& code) {
  CLI::App& command = *app.add_subcommand("run", "label the features of a model on meshes");
  const auto options = std::make_shared<RunOptions>();
  add_meshes(command, options->meshes)->required();
  add_model(command, options->model)->required();
  command.add_option("--out", options->out, "write result.json, labels.ply, scene.json and report.html to DIR/<mesh>/")
      ->type_name("DIR");
  command.add_flag("!--no-report", options->report, "do not write report.html");
  command.add_option("--save-problem", options->save_problem, "write the labelling problem: .json, .cfn, .wcsp, .uai")
      ->type_name("FILE");
  command.add_option("--measures", options->measures, "write the model's measures as CSV, a row for each mesh")
      ->type_name("FILE");
  command.add_option("--features", options->features, "write the features found as CSV, a row for each")
      ->type_name("FILE");
  CLI::Option* lock =
      command.add_option("--lock", options->lock, "write what decides this run to FILE")->type_name("FILE");
  command.add_option("--locked", options->locked, "refuse to run when anything differs from FILE, and say what")
      ->type_name("FILE")
      ->excludes(lock);
  command.add_flag("--json", options->json, "print the results as JSON lines");
  add_common(command, *options);
  command.callback([options, &code] { code = run(*options); });
}

}  // namespace toposcope::cli
