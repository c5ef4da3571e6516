// SPDX-License-Identifier: BSD-3-Clause

// The program: reads the command line, runs a command, turns errors into messages and exit codes.

#include <CLI/CLI.hpp>
#include <cstdio>
#include <new>

#include "base/errors.h"
#include "commands.h"
#include "result_commands.h"

namespace {

using namespace toposcope::cli;

void add_plugin_dirs(CLI::App* app, std::vector<fs::path>& dirs) {
  app->add_option("--plugin-dir", dirs, "further folders with plugins")->type_name("DIR")->allow_extra_args(false);
}

void add_session(CLI::App* app, CommonOptions& options) {
  add_plugin_dirs(app, options.plugin_dirs);
  app->add_option("--set", options.overrides, "override one value: station.option=value")
      ->type_name("S.O=V")
      ->allow_extra_args(false);
  app->add_option("--threads", options.threads, "threads; 0: one per processor")
      ->check(CLI::Range(0U, 1024U))
      ->capture_default_str();
  app->add_flag("-q,--quiet", options.quiet, "errors only");
  app->add_flag("-v,--verbose", options.verbose, "say more");
}

void add_common(CLI::App* app, CommonOptions& options) {
  app->add_option("--pipeline", options.pipeline, "name or file of the pipeline")->capture_default_str();
  app->add_option("--labeler", options.labeler, "labeler to use instead of the pipeline's")->type_name("ID");
  app->add_option("--seed", options.seed, "seed of everything random")->capture_default_str();
  add_session(app, options);
}

/// `--smooth scan.ply` means the default and a mesh.
void sort_out_smooth(const CLI::Option* smooth, PrepareOptions& options) {
  if (smooth->count() == 0) return;
  const std::string given = options.smooth;
  const bool number = !given.empty() && given.find_first_not_of("+-.0123456789eE") == given.npos;
  if (number) return;
  options.smooth = "10";
  if (!given.empty()) options.meshes.insert(options.meshes.begin(), given);
}

void add_prepare(CLI::App& app, PrepareOptions& options, int& code) {
  CLI::App* prepare_app =
      app.add_subcommand("prepare", "repair meshes, change their resolution, say what they are like");
  prepare_app->add_option("mesh", options.meshes, "PLY, OBJ, STL, OFF or glTF files")->type_name("MESH...");
  prepare_app->add_option("-o,--out", options.out, "mesh to write; of several meshes, or with a folder: DIR/<mesh>.ply")
      ->type_name("MESH|DIR");
  const CLI::Range count(1U, 100000000U);
  CLI::Option* smooth = prepare_app->add_option("--smooth", options.smooth, "smooth without shrinking; 10 passes")
                            ->type_name("[PASSES]")
                            ->expected(0, 1);
  prepare_app->add_option("--decimate", options.decimate, "fewer faces, the shape kept as well as can be")
      ->type_name("N")
      ->check(count);
  CLI::Option* faces =
      prepare_app->add_option("--faces", options.faces, "even edges, about N faces")->type_name("N")->check(count);
  prepare_app->add_option("--edge", options.edge, "even edges of about length L, in the mesh's unit")
      ->type_name("L")
      ->excludes(faces);
  prepare_app->add_flag("--json", options.json, "print a JSON object per mesh");
  add_session(prepare_app, options);
  prepare_app->callback([&options, &code, smooth] {
    sort_out_smooth(smooth, options);
    if (options.meshes.empty()) throw CLI::RequiredError("mesh");
    code = prepare(options);
  });
}

void add_label(CLI::App& app, LabelOptions& options, int& code) {
  CLI::App* label_app = app.add_subcommand("label", "solve a labelling problem from a file");
  label_app->add_option("problem", options.problem, "JSON, CFN, WCSP or UAI file")->required()->type_name("PROBLEM");
  label_app->add_option("--labeler", options.labeler, "labeler; default: least-error")->type_name("ID");
  label_app->add_option("--k-best", options.k_best, "how many labellings to list, the best first")
      ->type_name("K")
      ->check(CLI::Range(std::size_t{1}, std::size_t{1000000}))
      ->capture_default_str();
  label_app->add_option("--within", options.within, "leave out what costs more than the best by over T")
      ->type_name("T")
      ->check(CLI::NonNegativeNumber);
  label_app->add_flag("--marginals", options.marginals, "the probability of every value");
  label_app->add_option("--time-limit", options.time_limit_s, "seconds")
      ->type_name("S")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  label_app->add_option("--save-problem", options.save, "write the problem too, in the format of its extension")
      ->type_name("FILE");
  label_app->add_flag("--json", options.json, "print a JSON object");
  label_app->add_option("--seed", options.seed, "seed of everything random")->capture_default_str();
  add_session(label_app, options);
  label_app->callback([&] { code = label(options); });
}

void add_compare(CLI::App& app, CompareOptions& options, int& code) {
  CLI::App* compare_app =
      app.add_subcommand("compare", "the same labelling problem under several labelers, as a table");
  compare_app->add_option("mesh", options.meshes, "mesh files; <mesh>.truth.json beside one tells what is right")
      ->required()
      ->type_name("MESH...");
  compare_app->add_option("--model", options.model, "name or file of the model")->required();
  compare_app
      ->add_option("--labelers", options.labelers,
                   "separated by commas, each with its own options: annealing:sweeps=50,least-error; all: every one")
      ->type_name("A,B")
      ->capture_default_str();
  compare_app->add_option("--time-limit", options.time_limit_s, "seconds for each labeler and problem")
      ->type_name("S")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  compare_app->add_option("--out", options.out, "write index.html, comparison.json and .csv to DIR")->type_name("DIR");
  CLI::Option* json = compare_app->add_flag("--json", options.json, "print JSON");
  CLI::Option* csv = compare_app->add_flag("--csv", options.csv, "print a row per mesh and labeler")->excludes(json);
  compare_app->add_flag("--markdown", options.markdown, "print the table over all meshes")
      ->excludes(json)
      ->excludes(csv);
  compare_app->add_option("--pipeline", options.pipeline, "name or file of the pipeline")->capture_default_str();
  compare_app->add_option("--seed", options.seed, "seed of everything random")->capture_default_str();
  add_session(compare_app, options);
  compare_app->callback([&] { code = compare(options); });
}

void add_evaluate(CLI::App& app, EvaluateOptions& options, int& code) {
  CLI::App* evaluate_app = app.add_subcommand("evaluate", "label meshes whose truth is known, and say how good it is");
  evaluate_app->add_option("dataset", options.datasets, "data sets: which meshes, which model")
      ->required()
      ->type_name("DATASET.yaml...");
  evaluate_app->add_option("--model", options.model, "name or file of the model to use instead of the data set's");
  CLI::Option* out =
      evaluate_app->add_option("--out", options.out, "write index.html, evaluation.txt, .md, .json and .csv to DIR")
          ->type_name("DIR");
  evaluate_app->add_flag("--reports", options.reports, "write a report for each mesh too, to DIR/<data set>/<mesh>/")
      ->needs(out);
  evaluate_app->add_option("--baseline", options.baseline, "an earlier evaluation.json: show what changed")
      ->type_name("FILE");
  CLI::Option* json = evaluate_app->add_flag("--json", options.json, "print JSON");
  CLI::Option* csv = evaluate_app->add_flag("--csv", options.csv, "print a row per mesh and feature")->excludes(json);
  evaluate_app->add_flag("--markdown", options.markdown, "print the tables for a document")
      ->excludes(json)
      ->excludes(csv);
  add_common(evaluate_app, options);
  evaluate_app->callback([&] { code = evaluate(options); });
}

void add_plugins(CLI::App& app, PluginsOptions& options, int& code) {
  CLI::App* plugins_app = app.add_subcommand("plugins", "list, describe, check or begin plugins");
  plugins_app->require_subcommand(1);
  CLI::App* list_app = plugins_app->add_subcommand("list", "all plugins that can be found");
  CLI::App* describe_app = plugins_app->add_subcommand("describe", "a plugin's options and what it provides");
  CLI::App* check_app = plugins_app->add_subcommand("check", "hold plugins against what every plugin of its kind owes");
  CLI::App* new_app = plugins_app->add_subcommand("new", "write a plugin that works, to be changed into yours");
  describe_app->add_option("id", options.id, "the plugin's id")->required();
  describe_app->add_option("--page", options.page, "renew the tables of its documentation page")->type_name("FILE.md");
  check_app->add_option("path", options.paths, "libraries, folders of them or build folders; none: all that are found");
  check_app->add_flag("--valgrind", options.valgrind, "also under valgrind: leaks and accesses out of bounds");
  check_app->add_option("--child", options.child)->group("");
  check_app->add_flag("--brief", options.brief)->group("");
  for (CLI::App* sub : {list_app, describe_app, check_app}) sub->add_flag("--json", options.json, "print JSON");
  for (CLI::App* sub : {list_app, describe_app, check_app, new_app}) add_plugin_dirs(sub, options.plugin_dirs);
  new_app->add_option("kind", options.kind, "workset, shape, relation, labeler or filter")->required();
  new_app->add_option("name", options.id, "the plugin's id and folder: lower-case words joined by '-'")->required();
  list_app->callback([&] { code = plugins_list(options); });
  describe_app->callback([&] { code = plugins_describe(options); });
  check_app->callback([&] { code = plugins_check(options); });
  new_app->callback([&] { code = plugins_new(options); });
}

int dispatch(int argc, char** argv) {
  CLI::App app{"Finds, names and measures the features of a class of objects on triangle meshes.", "toposcope"};
  app.set_version_flag("--version", TOPOSCOPE_VERSION);
  app.require_subcommand(1);
  app.footer(
      "Exit codes: 0 done; 2 bad usage, model or pipeline; 3 a mesh that cannot be used; 4 a plugin that cannot "
      "be used.");
  int code = 0;

  RunOptions run_options;
  CLI::App* run_app = app.add_subcommand("run", "label the features of a model on meshes");
  run_app->add_option("mesh", run_options.meshes, "PLY, OBJ, STL or OFF files")->required()->type_name("MESH...");
  run_app->add_option("--model", run_options.model, "name or file of the model")->required();
  run_app
      ->add_option("--out", run_options.out, "write result.json, labels.ply, scene.json and report.html to DIR/<mesh>/")
      ->type_name("DIR");
  run_app->add_flag("!--no-report", run_options.report, "do not write report.html");
  run_app
      ->add_option("--save-problem", run_options.save_problem, "write the labelling problem: .json, .cfn, .wcsp, .uai")
      ->type_name("FILE");
  CLI::Option* lock =
      run_app->add_option("--lock", run_options.lock, "write what decides this run to FILE")->type_name("FILE");
  run_app->add_option("--locked", run_options.locked, "refuse to run when anything differs from FILE, and say what")
      ->type_name("FILE")
      ->excludes(lock);
  run_app->add_flag("--json", run_options.json, "print the results as JSON lines");
  add_common(run_app, run_options);
  run_app->callback([&] { code = run(run_options); });

  ClassifyOptions classify_options;
  CLI::App* classify_app = app.add_subcommand("classify", "which class of objects explains a mesh best");
  classify_app->add_option("mesh", classify_options.meshes, "PLY, OBJ, STL or OFF files")
      ->required()
      ->type_name("MESH...");
  classify_app->add_option("--models", classify_options.models, "a folder of models, or names separated by commas")
      ->required()
      ->type_name("DIR|LIST");
  classify_app->add_flag("--json", classify_options.json, "print a JSON object per mesh");
  add_common(classify_app, classify_options);
  classify_app->callback([&] { code = classify(classify_options); });

  CompareOptions compare_options;
  add_compare(app, compare_options, code);

  EvaluateOptions evaluate_options;
  add_evaluate(app, evaluate_options, code);

  LabelOptions label_options;
  add_label(app, label_options, code);

  PrepareOptions prepare_options;
  add_prepare(app, prepare_options, code);

  ResultOptions result_options;
  add_result_commands(app, result_options, code);

  SampleOptions sample_options;
  CLI::App* sample_app = app.add_subcommand("sample", "make a parametric object and its truth");
  sample_app->add_option("kind", sample_options.kind, "cup, tee, ...; see --list");
  sample_app->add_flag("--list", sample_options.list, "list the kinds and their parameters");
  sample_app->add_option("-o,--out", sample_options.out, "mesh to write; its truth goes beside it")->type_name("MESH");
  sample_app->add_option("--faces", sample_options.faces, "number of faces")->capture_default_str();
  sample_app->add_option("--noise", sample_options.noise, "sd of the noise along the normal, part of the diagonal")
      ->capture_default_str();
  std::vector<std::string> assignments;
  sample_app->add_option("--set", assignments, "one parameter: name=value")->type_name("P=V")->allow_extra_args(false);
  sample_app->add_option("--preset", sample_options.preset, "named parameters to start from; see --list");
  sample_app->add_flag("--random", sample_options.random, "draw the parameters that --set does not give");
  sample_app->add_option("--seed", sample_options.seed, "seed of noise, pose and --random")->capture_default_str();
  sample_app->add_option("--threads", sample_options.threads, "threads; 0: one per processor")
      ->check(CLI::Range(0U, 1024U))
      ->capture_default_str();
  sample_app->add_flag("--scan", sample_options.scan, "turn the object, scan it and make the mesh of what was seen");
  const std::vector<CLI::Option*> scan_options = {
      sample_app->add_option("--views", sample_options.viewpoints, "viewpoints of the scan")->capture_default_str(),
      sample_app->add_option("--view", sample_options.seen_from, "keep only what so many viewpoints on one side see")
          ->capture_default_str(),
      sample_app->add_option("--scan-noise", sample_options.scan_noise, "sd along the ray, part of the diagonal")
          ->capture_default_str(),
      sample_app->add_option("--scan-smooth", sample_options.smoothing, "passes of Taubin's filter after the scan")
          ->capture_default_str()};
  for (CLI::Option* option : scan_options) option->needs("--scan");
  add_plugin_dirs(sample_app, sample_options.plugin_dirs);
  sample_app->callback([&] {
    for (const std::string& assignment : assignments) {
      const std::size_t equals = assignment.find('=');
      if (equals == std::string::npos)
        throw toposcope::UsageError("--set " + assignment + ": expected name=value; see toposcope sample --list");
      sample_options.parameters[assignment.substr(0, equals)] = assignment.substr(equals + 1);
    }
    code = sample(sample_options);
  });

  ModelOptions model_options;
  CLI::App* model_app = app.add_subcommand("model", "check or show a model");
  model_app->require_subcommand(1);
  CLI::App* model_check_app = model_app->add_subcommand("check", "report all errors of a model file");
  CLI::App* model_show_app = model_app->add_subcommand("show", "print a model's networks, features and relationships");
  for (CLI::App* sub : {model_check_app, model_show_app}) {
    sub->add_option("model", model_options.model, "name or file")->required();
    add_plugin_dirs(sub, model_options.plugin_dirs);
  }
  model_show_app->add_option("--format", model_options.format, "text or dot (Graphviz)")
      ->check(CLI::IsMember({"text", "dot"}))
      ->capture_default_str();
  model_check_app->callback([&] { code = model_check(model_options); });
  model_show_app->callback([&] { code = model_show(model_options); });

  PluginsOptions plugins_options;
  add_plugins(app, plugins_options, code);

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  return code;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const int code = dispatch(argc, argv);
    if (std::fflush(stdout) != 0 || std::ferror(stdout)) {
      std::fprintf(stderr, "toposcope: the output could not be written; is the disk full?\n");
      return 1;
    }
    return code;
  } catch (const toposcope::Error& error) {
    std::fprintf(stderr, "toposcope: %s\n", error.what());
    return error.exit_code;
  } catch (const std::bad_alloc&) {
    std::fprintf(stderr, "toposcope: out of memory\n");
    return 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "toposcope: internal error: %s\n", error.what());
    return 1;
  }
}
