// SPDX-License-Identifier: BSD-3-Clause

// From a binary PLY on disk (in the page cache) to a checked mesh with adjacency, beside other libraries' readers. CGAL
// and VTK take part where CMake finds them; VTK's reader makes no adjacency.

#include <benchmark/benchmark.h>

#include <filesystem>
#include <fstream>

#include "base/run_context.h"
#include "io/mesh_io.h"
#include "mesh/repair.h"
#include "rivals.h"
#include "support/analytic_surfaces.h"

namespace {

using namespace toposcope;
namespace fs = std::filesystem;

/// As most programs write it: coordinates in single precision, a count byte and three 32-bit indices a face.
fs::path torus_file(Index faces) {
  const fs::path file = fs::temp_directory_path() / ("toposcope-bench-" + std::to_string(faces) + ".ply");
  if (fs::exists(file)) return file;
  const TriangleSoup soup = test::make_surface("torus", faces, test::Sampling::irregular, 0.02, 1).mesh;
  std::ofstream out(file, std::ios::binary);
  out << "ply\nformat binary_little_endian 1.0\nelement vertex " << soup.positions.size()
      << "\nproperty float x\nproperty float y\nproperty float z\nelement face " << soup.triangles.size()
      << "\nproperty list uchar int vertex_indices\nend_header\n";
  for (const Vec3& p : soup.positions) {
    const Eigen::Vector3f single = p.cast<float>();
    out.write(reinterpret_cast<const char*>(single.data()), sizeof single);
  }
  for (const Triangle& t : soup.triangles) {
    out.put(3);
    out.write(reinterpret_cast<const char*>(t.data()), sizeof t);
  }
  return file;
}

void read_ours(benchmark::State& state) {
  const fs::path file = torus_file(static_cast<Index>(state.range(0)));
  RunContext context({.threads = 2});
  for (auto _ : state) benchmark::DoNotOptimize(read_mesh(file, &context).view().mean_edge);
}

/// The check (and repair) that `run` and `prepare` make between reading and adjacency.
void repair_of_a_clean_mesh(benchmark::State& state) {
  const TriangleSoup read = read_soup(torus_file(static_cast<Index>(state.range(0))));
  for (auto _ : state) {
    state.PauseTiming();
    TriangleSoup soup = read;
    state.ResumeTiming();
    benchmark::DoNotOptimize(repair(soup, "torus").genus);
  }
}

template <std::size_t (*read)(const std::string&)>
void read_rival(benchmark::State& state) {
  const std::string file = torus_file(static_cast<Index>(state.range(0))).string();
  for (auto _ : state)
    if (read(file) == 0) state.SkipWithError("not read");
}

void sizes(benchmark::internal::Benchmark* b) {
  for (const int faces : {20000, 200000, 1000000}) b->Arg(faces);
  b->Unit(benchmark::kMillisecond)->UseRealTime();
}

BENCHMARK(read_ours)->Apply(sizes);
BENCHMARK(repair_of_a_clean_mesh)->Apply(sizes);
BENCHMARK(read_rival<bench::read_openmesh>)->Name("read_openmesh")->Apply(sizes);
#ifdef TOPOSCOPE_BENCH_CGAL
BENCHMARK(read_rival<bench::read_cgal>)->Name("read_cgal")->Apply(sizes);
#endif
#ifdef TOPOSCOPE_BENCH_VTK
BENCHMARK(read_rival<bench::read_vtk>)->Name("read_vtk")->Apply(sizes);
#endif

}  // namespace
