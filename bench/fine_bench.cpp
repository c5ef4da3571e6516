// SPDX-License-Identifier: BSD-3-Clause

// A whole run on a cup of a million faces, from the file to the result, beside another library's reading of that file.

#include <benchmark/benchmark.h>

#include <filesystem>

#include "base/run_context.h"
#include "io/mesh_io.h"
#include "model/read_model.h"
#include "pipeline/analysis.h"
#include "pipeline/pipeline_manifest.h"
#include "plugin/plugin_host.h"
#include "result/result.h"
#include "rivals.h"
#include "sample/sample.h"

namespace {

using namespace toposcope;
namespace fs = std::filesystem;

fs::path cup_file(Index faces) {
  const fs::path file = fs::temp_directory_path() / ("toposcope-bench-cup-" + std::to_string(faces) + ".ply");
  if (fs::exists(file)) return file;
  RunContext context;
  const TriangleSoup soup = make_sample({.kind = "cup", .faces = faces}, context).mesh;
  write_mesh(file, soup.positions, soup.triangles);
  return file;
}

/// Read, repair and adjacency, as `run` has them.
void fine_read(benchmark::State& state) {
  const fs::path file = cup_file(static_cast<Index>(state.range(0)));
  RunContext context({.threads = 2});
  for (auto _ : state) benchmark::DoNotOptimize(read_repaired_mesh(file, &context).mesh.view().mean_edge);
}

void fine_coarsen(benchmark::State& state) {
  RunContext context({.threads = 2});
  const RepairedMesh fine = read_repaired_mesh(cup_file(static_cast<Index>(state.range(0))), &context);
  for (auto _ : state) benchmark::DoNotOptimize(coarsen(fine.mesh.view(), 40000, context)->clusters.size());
}

void fine_run(benchmark::State& state) {
  const fs::path file = cup_file(static_cast<Index>(state.range(0)));
  PluginHost host{PluginCatalog({{fs::path(TOPOSCOPE_BUILD_DIR) / "plugins", true}})};
  const fs::path source = TOPOSCOPE_SOURCE_DIR;
  const Model model = read_model(source / "models/cup.yaml", &host.catalog());
  const Stations stations =
      make_stations(host, read_pipeline(source / "pipelines/default.yaml", host.catalog()), model);
  RunContext context({.threads = 2});
  for (auto _ : state) {
    const RepairedMesh input = read_repaired_mesh(file, &context);
    const Analysis analysis = analyze(input.mesh, model, stations, {}, context);
    benchmark::DoNotOptimize(to_json(explain(analysis, model, file.string(), stations, context)).size());
  }
}

void fine_read_openmesh(benchmark::State& state) {
  const std::string file = cup_file(static_cast<Index>(state.range(0))).string();
  for (auto _ : state)
    if (bench::read_openmesh(file) == 0) state.SkipWithError("not read");
}

BENCHMARK(fine_run)->Arg(1000000)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(fine_read)->Arg(1000000)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(fine_coarsen)->Arg(1000000)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(fine_read_openmesh)->Arg(1000000)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
