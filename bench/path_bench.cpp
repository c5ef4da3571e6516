// SPDX-License-Identifier: BSD-3-Clause

// The path of the data on generated cups, by number of faces: reading, curvature, the whole analysis.

#include <benchmark/benchmark.h>

#include <filesystem>
#include <map>

#include "base/run_context.h"
#include "io/mesh_io.h"
#include "model/read_model.h"
#include "pipeline/analysis.h"
#include "pipeline/pipeline_manifest.h"
#include "plugin/plugin_host.h"
#include "sample/sample.h"
#include "toposcope/curvature.h"

namespace {

using namespace toposcope;
namespace fs = std::filesystem;

const TriangleSoup& cup(Index faces) {
  static std::map<Index, TriangleSoup> made;
  if (const auto found = made.find(faces); found != made.end()) return found->second;
  RunContext context;
  return made[faces] = make_sample({.kind = "cup", .faces = faces}, context).mesh;
}

void read_binary_ply(benchmark::State& state) {
  const TriangleSoup& soup = cup(static_cast<Index>(state.range(0)));
  const fs::path file = fs::temp_directory_path() / "toposcope-bench.ply";
  write_mesh(file, soup.positions, soup.triangles);
  for (auto _ : state) benchmark::DoNotOptimize(read_mesh(file).view().mean_edge);
  fs::remove(file);
}

void curvature(benchmark::State& state) {
  const Mesh mesh(cup(static_cast<Index>(state.range(0))), "cup");
  RunContext context;
  for (auto _ : state)
    benchmark::DoNotOptimize(
        turning_curvature(mesh.view(), plane_fit_normals(mesh.view(), context), 2, context).maximum.front());
}

void whole_analysis(benchmark::State& state) {
  const Mesh mesh(cup(static_cast<Index>(state.range(0))), "cup");
  PluginHost host{PluginCatalog({{fs::path(TOPOSCOPE_BUILD_DIR) / "plugins", true}})};
  const fs::path source = TOPOSCOPE_SOURCE_DIR;
  const Model model = read_model(source / "models/cup.yaml", &host.catalog());
  const Stations stations =
      make_stations(host, read_pipeline(source / "pipelines/default.yaml", host.catalog()), model);
  RunContext context;
  for (auto _ : state) benchmark::DoNotOptimize(analyze(mesh, model, stations, {}, context).best);
}

BENCHMARK(read_binary_ply)->Arg(5000)->Arg(20000)->Arg(100000)->Unit(benchmark::kMillisecond);
BENCHMARK(curvature)->Arg(5000)->Arg(20000)->Arg(100000)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(whole_analysis)->Arg(5000)->Arg(20000)->Arg(100000)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
