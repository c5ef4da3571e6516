// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>

#include "base/errors.h"
#include "base/run_context.h"
#include "commands.h"
#include "io/mesh_io.h"
#include "plugin/option_check.h"
#include "sample/sample.h"
#include "sample/scan.h"
#include "session.h"

namespace toposcope::cli {
namespace {

void list_kinds() {
  for (const SampleKind& kind : sample_kinds()) {
    fmt::print("{}: {}\n", kind.name, kind.summary);
    for (const OptionRow& row : kind.parameters)
      fmt::print("  {:<22} {:<8} {} [{}; default {}; --random: {}]\n", row.name, row.unit, row.meaning,
                 describe_constraint(row), row.default_value, describe_range(kind, row.name));
    for (const SamplePreset& preset : kind.presets) fmt::print("  --preset {:<13} {}\n", preset.name, preset.summary);
    fmt::print("\n");
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
  for (const auto& [name, value] : options.parameters)
    request.parameters[name] = kind == kinds.end() ? 0 : sample_parameter(*kind, name, value);
  request.preset = options.preset;
  request.random = options.random;
  return request;
}

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
  const Sample target = make_scan_target(request_of(options), session.context());
  return scan(target, settings, session.host(), session.context());
}

Sample exact(const SampleOptions& options) {
  RunSettings settings;
  settings.threads = options.threads;
  settings.seed = options.seed;
  RunContext context(settings);
  return make_sample(request_of(options), context);
}

}  // namespace

int sample(const SampleOptions& options) {
  if (options.list) {
    list_kinds();
    return 0;
  }
  if (options.kind.empty()) throw UsageError("sample: name a kind of object; toposcope sample --list shows them");
  if (options.out.empty()) throw UsageError("sample: where to? give the mesh to write with -o");
  const Sample made = options.scan ? scanned(options) : exact(options);
  const fs::path truth = fs::path(options.out).replace_extension(".truth.json");
  write_mesh(options.out, made.mesh.positions, made.mesh.triangles);
  write_file(truth, truth_json(made, options.out.filename().string()));
  fmt::print("{}: {} with {} faces\n{}: its truth\n", options.out.string(), made.truth.class_name,
             made.mesh.triangles.size(), truth.string());
  return 0;
}

}  // namespace toposcope::cli
