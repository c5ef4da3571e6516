// SPDX-License-Identifier: BSD-3-Clause

// The path of the data on generated cups, by number of faces: reading, curvature, the whole analysis.

#include <benchmark/benchmark.h>
#include <malloc.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <string>

#include "base/run_context.h"
#include "io/mesh_io.h"
#include "model/read_model.h"
#include "pipeline/analysis.h"
#include "pipeline/pipeline_manifest.h"
#include "pipeline/working_sets.h"
#include "plugin/plugin_host.h"
#include "sample/sample.h"
#include "support/analytic_surfaces.h"
#include "toposcope/geometry/curvature.h"

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

/// Greatest resident memory since it was made, beyond what was resident then.
class PeakMemory {
 public:
  PeakMemory() {
    malloc_trim(0);
    std::ofstream("/proc/self/clear_refs") << 5;  // the peak starts anew
    before_ = read("VmRSS:");
  }
  std::size_t bytes() const { return read("VmHWM:") - before_; }

 private:
  static std::size_t read(const std::string& key) {
    std::ifstream status("/proc/self/status");
    std::string word;
    while (status >> word)
      if (word == key && status >> word) return std::stoull(word) * 1024;
    return 0;
  }
  std::size_t before_ = 0;
};

const MeshView& torus(Index faces) {
  static std::map<Index, Mesh> made;
  auto found = made.find(faces);
  if (found == made.end()) {
    TriangleSoup soup = test::make_surface("torus", faces, test::Sampling::irregular, 0.02, 1).mesh;
    found = made.emplace(faces, Mesh(std::move(soup), "torus")).first;
  }
  return found->second.view();
}

void normals(benchmark::State& state) {
  const MeshView& mesh = torus(static_cast<Index>(state.range(0)));
  RunContext context;
  for (auto _ : state) benchmark::DoNotOptimize(vertex_normals(mesh, context).front());
}

/// The default estimate, normals included.
void curvature(benchmark::State& state) {
  const MeshView& mesh = torus(static_cast<Index>(state.range(0)));
  RunContext context;
  for (auto _ : state) {
    ShapeOperators operators = fit_shape_operators(mesh, context);
    diffuse(mesh, operators, diffusion_passes(mesh, 0.015 * mesh.box.diagonal(), 1), context);
    benchmark::DoNotOptimize(principal_curvatures(operators).maximum.front());
  }
}

void dissertation_curvature(benchmark::State& state) {
  const MeshView& mesh = torus(static_cast<Index>(state.range(0)));
  RunContext context;
  for (auto _ : state)
    benchmark::DoNotOptimize(turning_curvature(mesh, plane_fit_normals(mesh, context), 2, context).maximum.front());
}

/// The station classify: normals, curvature, working sets, and the kernel's check of the sets.
void working_sets(benchmark::State& state) {
  const MeshView& mesh = torus(static_cast<Index>(state.range(0)));
  PluginHost host{PluginCatalog({{fs::path(TOPOSCOPE_BUILD_DIR) / "plugins", true}})};
  const PluginManifest& manifest = host.catalog().require(PluginKind::worksets, "curvature-tree");
  WorkingSetStation station{
      manifest.id, {}, host.worksets(manifest.id, check_options(manifest.options, {}, manifest.id))};
  for (const ProvidedRow& row : manifest.provides) station.types.push_back(row.name);
  RunContext context;
  const PeakMemory memory;
  for (auto _ : state) benchmark::DoNotOptimize(classify_mesh(mesh, {&station, 1}, context).vertices.size());
  state.counters["peak_bytes_a_vertex"] = static_cast<double>(memory.bytes()) / mesh.vertex_count();
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
BENCHMARK(normals)->Arg(20000)->Arg(1000000)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(curvature)->Arg(20000)->Arg(1000000)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(dissertation_curvature)->Arg(20000)->Arg(1000000)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(working_sets)->Arg(20000)->Arg(1000000)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(whole_analysis)->Arg(5000)->Arg(20000)->Arg(100000)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
