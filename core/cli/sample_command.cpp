// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <optional>

#include "base/assignment.h"
#include "base/errors.h"
#include "base/run_context.h"
#include "commands.h"
#include "io/mesh_io.h"
#include "options.h"
#include "output.h"
#include "plugin/option_check.h"
#include "sample/sample.h"
#include "sample/scan.h"
#include "session.h"

namespace toposcope::cli {
namespace {

struct SampleOptions : CommonOptions {
  std::string kind;
  std::uint32_t faces = 20000;
  double noise = 0;
  fs::path out;
  bool list = false;
  bool scan = false;
  std::uint32_t viewpoints = 60, seen_from = 0;
  double scan_noise = 0.0005;
  int smoothing = 3;
  std::string preset;
  bool random = false;
  const CLI::Option* faces_option = nullptr;
};

void list_kinds() {
  for (const SampleKind& kind : sample_kinds()) {
    say("{}: {}\n", kind.name, kind.summary);
    for (const OptionRow& row : kind.parameters)
      say("  {:<22} {:<8} {} [{}; default {}; --random: {}]\n", row.name, row.unit, row.meaning,
          describe_constraint(row), row.default_value, describe_range(kind, row.name));
    for (const SamplePreset& preset : kind.presets) say("  --preset {:<13} {}\n", preset.name, preset.summary);
    say("\n");
  }
}

SampleRequest request_of(const SampleOptions& options) {
  SampleRequest request;
  request.kind = options.kind;
  request.faces = options.faces;
  request.noise_rel = options.noise;
  request.seed = options.seed;
  const std::vector<SampleKind> kinds = sample_kinds();
  const auto kind =
      std::find_if(kinds.begin(), kinds.end(), [&](const SampleKind& k) { return k.name == options.kind; });
  for (const std::string& text : options.overrides) {
    const auto parameter = split_assignment(text);
    if (!parameter) throw UsageError("--set " + text + ": expected name=value; see toposcope sample --list");
    const auto& [name, value] = *parameter;
    request.parameters[name] = kind == kinds.end() ? 0 : sample_parameter(*kind, name, value);
  }
  request.preset = options.preset;
  request.random = options.random;
  return request;
}

/// Leaves a computation in the midst once it is cancelled, because half a scan is of no use.
class ImpatientContext final : public Context {
 public:
  explicit ImpatientContext(Context& patient) : patient_(patient) {}
  void log(LogLevel level, std::string_view message) override { patient_.log(level, message); }
  void progress(double fraction) override { patient_.progress(fraction); }
  bool cancelled() const override { return patient_.cancelled(); }
  std::uint64_t seed() const override { return patient_.seed(); }
  unsigned threads() const override { return patient_.threads(); }
  std::uint64_t memory_budget() const override { return patient_.memory_budget(); }
  void parallel_for(std::size_t count, std::size_t grain,
                    const std::function<void(std::size_t, std::size_t)>& body) override {
    patient_.parallel_for(count, grain, [&](std::size_t first, std::size_t last) {
      stop_if_cancelled(patient_, "nothing was written");
      body(first, last);
    });
  }

 private:
  Context& patient_;
};

Sample scanned(const SampleOptions& options) {
  if (options.noise > 0)
    throw UsageError(
        fmt::format("--noise {}: moves the vertices of an exact mesh; a scan has --scan-noise", options.noise));
  const ScanSettings settings{.faces = options.faces,
                              .viewpoints = options.viewpoints,
                              .seen_from = options.seen_from,
                              .noise_rel = options.scan_noise,
                              .smoothing = options.smoothing,
                              .seed = options.seed};
  Session session(options);
  ImpatientContext context(session.context());
  std::optional<Sample> made;
  try {
    made = scan(make_scan_target(request_of(options), context), settings, session.host(), context);
  } catch (const Error&) {
    if (!context.cancelled()) throw;
  }
  stop_if_cancelled(context, options.out.string() + " was not written");
  return std::move(*made);
}

Sample exact(const SampleOptions& options) {
  RunSettings settings;
  settings.threads = options.threads;
  settings.seed = options.seed;
  RunContext context(settings);
  Sample made = make_sample(request_of(options), context);
  if (made.tessellated && options.faces_option->count() > 0)
    throw UsageError(
        fmt::format("--faces {}: a {} has as many faces as its 'segments' ask for; --set segments=N, or --scan",
                    options.faces, options.kind));
  return made;
}

int sample(const SampleOptions& options) {
  if (options.list) {
    list_kinds();
    return 0;
  }
  if (options.kind.empty()) throw UsageError("sample: name a kind of object; toposcope sample --list shows them");
  if (options.out.empty()) throw UsageError("sample: where to? give the mesh to write with -o");
  if (!can_write_mesh(options.out))
    throw UsageError("-o " + options.out.string() + ": write a mesh as .ply, .obj, .stl or .off");
  const Sample made = options.scan ? scanned(options) : exact(options);
  const fs::path truth = fs::path(options.out).replace_extension(".truth.json");
  write_mesh(options.out, made.mesh.positions, made.mesh.triangles);
  write_file(truth, truth_json(made, options.out.filename().string()));
  say("{}: {} with {} faces\n{}: its truth\n", options.out.string(), made.truth.class_name, made.mesh.triangles.size(),
      truth.string());
  return 0;
}

}  // namespace

void add_sample(CLI::App& app, int& code) {
  CLI::App& command = *app.add_subcommand("sample", "make a parametric object and its truth");
  const auto options = std::make_shared<SampleOptions>();
  constexpr std::uint64_t most = std::numeric_limits<std::uint32_t>::max();
  command.add_option("kind", options->kind, "cup, tee, ...; see --list");
  command.add_flag("--list", options->list, "list the kinds and their parameters");
  command.add_option("-o,--out", options->out, "mesh to write; its truth goes beside it")->type_name("MESH");
  options->faces_option =
      command.add_option("--faces", options->faces, "number of faces; of plate and flange of their scans")
          ->check(whole_number(0, most))
          ->capture_default_str();
  command.add_option("--noise", options->noise, "sd of the noise along the normal, part of the diagonal")
      ->capture_default_str();
  command.add_option("--set", options->overrides, "one parameter: name=value")
      ->type_name("P=V")
      ->allow_extra_args(false);
  command.add_option("--preset", options->preset, "named parameters to start from; see --list");
  command.add_flag("--random", options->random, "draw the parameters that --set does not give");
  add_seed(command, options->seed, "noise, pose and --random");
  add_threads(command, options->threads);
  command.add_flag("--scan", options->scan, "turn the object, scan it and make the mesh of what was seen");
  const std::vector<CLI::Option*> scan_options = {
      command.add_option("--views", options->viewpoints, "viewpoints of the scan")
          ->check(whole_number(0, most))
          ->capture_default_str(),
      command.add_option("--view", options->seen_from, "keep only what so many viewpoints on one side see")
          ->check(whole_number(0, most))
          ->capture_default_str(),
      command.add_option("--scan-noise", options->scan_noise, "sd along the ray, part of the diagonal")
          ->capture_default_str(),
      command.add_option("--scan-smooth", options->smoothing, "passes of Taubin's filter after the scan")
          ->check(whole_number(0, 10000))
          ->capture_default_str()};
  for (CLI::Option* option : scan_options) option->needs("--scan");
  add_plugin_dirs(command, options->plugin_dirs);
  command.callback([options, &code] { code = sample(*options); });
}

}  // namespace toposcope::cli
