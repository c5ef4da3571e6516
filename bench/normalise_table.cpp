// SPDX-License-Identifier: BSD-3-Clause

// What the filter normalise makes of meshes, as a Markdown table.
//
//   normalise_table [--faces N,N,...] [--set OPTION=VALUE] [--write FOLDER] MESH...

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <numeric>

#include "base/run_context.h"
#include "io/mesh_io.h"
#include "plugin/plugin_host.h"
#include "table/table.h"
#include "toposcope/geometry/closest_face.h"

namespace {

using namespace toposcope;
namespace fs = std::filesystem;

struct Caught final : MeshSink {
  void set(std::span<const Vec3> p, std::span<const Triangle> t, std::span<const Index>,
           std::span<const Index>) override {
    soup.positions.assign(p.begin(), p.end());
    soup.triangles.assign(t.begin(), t.end());
    soup.face_origin.resize(t.size());
    std::iota(soup.face_origin.begin(), soup.face_origin.end(), Index{0});
    soup.input_faces = static_cast<Index>(t.size());
  }
  TriangleSoup soup;
};

// The greatest distance to `to` from points of `from` at most `step` apart: its vertices, sides and insides.
double one_sided(const MeshView& from, const ClosestFace& to, double step, Context& context) {
  std::vector<double> greatest(from.face_count(), 0);
  context.parallel_for(from.face_count(), 64, [&](std::size_t first, std::size_t last) {
    for (std::size_t f = first; f < last; ++f) {
      const Triangle& t = from.triangles[f];
      const Vec3 &a = from.positions[t[0]], &b = from.positions[t[1]], &c = from.positions[t[2]];
      const int along = std::max(1, static_cast<int>(std::ceil((b - a).norm() / step)));
      const int across = std::max(1, static_cast<int>(std::ceil((c - a).norm() / step)));
      for (int i = 0; i <= along; ++i)
        for (int j = 0; j * along <= across * (along - i); ++j)
          greatest[f] = std::max(greatest[f],
                                 to(a + double(i) / along * (b - a) + double(j) / across * (c - a)).squared_distance);
      for (int j = 0; j <= along; ++j)
        greatest[f] = std::max(greatest[f], to(b + double(j) / along * (c - b)).squared_distance);
    }
  });
  return std::sqrt(*std::max_element(greatest.begin(), greatest.end()));
}

struct Shape {
  bool manifold = true;
  int components = 0, boundaries = 0, euler = 0;
  double least = 1e300, mean = 0, greatest = 0, variation = 0;  // of edges
};

Index root(std::vector<Index>& parent, Index v) {
  while (parent[v] != v) v = parent[v] = parent[parent[v]];
  return v;
}

Shape describe(const MeshView& mesh) {
  Shape shape;
  std::vector<double> lengths;
  std::vector<Index> parent(mesh.vertex_count()), rim(mesh.vertex_count());
  std::iota(parent.begin(), parent.end(), Index{0});
  rim = parent;
  int vertices = 0;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    vertices += !mesh.one_ring(v).empty();
    for (Index w : mesh.one_ring(v)) {
      if (w < v) continue;
      lengths.push_back((mesh.positions[v] - mesh.positions[w]).norm());
      parent[root(parent, v)] = root(parent, w);
    }
  }
  std::vector<char> on_rim(mesh.vertex_count(), 0);
  try {
    const std::vector<Index> opposite = opposite_half_edges(mesh);
    for (Index h = 0; h < opposite.size(); ++h)
      if (opposite[h] == no_index) {
        const Index a = mesh.triangles[h / 3][h % 3], b = mesh.triangles[h / 3][(h + 1) % 3];
        on_rim[a] = on_rim[b] = 1;
        rim[root(rim, a)] = root(rim, b);
      }
  } catch (const std::invalid_argument& error) {
    shape.manifold = false;
    std::fprintf(stderr, "%s\n", error.what());
  }
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    shape.components += parent[v] == v && !mesh.one_ring(v).empty();
    shape.boundaries += on_rim[v] && rim[v] == v;
  }
  shape.euler = vertices - static_cast<int>(lengths.size()) + static_cast<int>(mesh.face_count());
  double sum = 0, squares = 0;
  for (double length : lengths) {
    sum += length;
    shape.least = std::min(shape.least, length);
    shape.greatest = std::max(shape.greatest, length);
  }
  shape.mean = sum / static_cast<double>(lengths.size());
  for (double length : lengths) squares += (length - shape.mean) * (length - shape.mean);
  shape.variation = std::sqrt(squares / static_cast<double>(lengths.size())) / shape.mean;
  return shape;
}

Column real(const char* name, const char* format) {
  return {name, "number", "", format};
}

const std::vector<Column> columns = {"mesh",
                                     "target",
                                     "faces",
                                     real("CV of edges", "{:.3f}"),
                                     real("mean edge, % of diagonal", "{:.3f}"),
                                     real("min / mean", "{:.2f}"),
                                     real("max / mean", "{:.2f}"),
                                     "Hausdorff to, from input, %",
                                     "genus",
                                     "components",
                                     "boundaries",
                                     "manifold",
                                     "ms"};

/// The row of a mesh. \param diagonal  of the input
void print(const std::string& name, const std::string& target, const MeshView& mesh, double diagonal,
           const std::string& distances, const std::string& time) {
  const Shape s = describe(mesh);
  const int genus = s.components - (s.euler + s.boundaries) / 2;
  fmt::print("{}", markdown_row(columns, {name, target, mesh.face_count(), s.variation, 100 * s.mean / diagonal,
                                          s.least / s.mean, s.greatest / s.mean, distances, std::to_string(genus),
                                          std::to_string(s.components), std::to_string(s.boundaries),
                                          s.manifold ? "yes" : "no", time}));
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<int> targets = {5000, 10000, 20000};
  std::vector<GivenOption> settings;
  std::vector<fs::path> files;
  fs::path folder;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--faces" && i + 1 < argc) {
      targets.clear();
      for (char* part = std::strtok(argv[++i], ","); part; part = std::strtok(nullptr, ","))
        targets.push_back(std::atoi(part));
    } else if (word == "--set" && i + 1 < argc) {
      const std::string given = argv[++i];
      settings.push_back({given.substr(0, given.find('=')), given.substr(given.find('=') + 1)});
    } else if (word == "--write" && i + 1 < argc) {
      folder = argv[++i];
    } else {
      files.emplace_back(word);
    }
  }
  PluginHost host{PluginCatalog({{fs::path(TOPOSCOPE_BUILD_DIR) / "plugins", true}})};
  RunContext context(
      {.threads = 0,
       .seed = 1,
       .time_limit_s = {},
       .log = [](LogLevel, std::string_view line) { std::fprintf(stderr, "%s\n", std::string(line).c_str()); },
       .progress = {}});
  fmt::print("{}", markdown_header(columns));
  for (const fs::path& file : files) try {
      const Mesh input = read_mesh(file);
      const std::string name = file.stem().string();
      const double diagonal = input.view().box.diagonal();
      print(name, "input", input.view(), diagonal, "", "");
      const ClosestFace to_input(input.view().positions, input.view().triangles);
      for (const int faces : targets) {
        std::vector<GivenOption> given = settings;
        given.push_back({"faces", std::to_string(faces)});
        const auto plugin = host.filter(
            "normalise",
            check_options(host.catalog().require(PluginKind::filters, "normalise").options, given, "table"));
        Caught caught;
        const auto begin = std::chrono::steady_clock::now();
        plugin->apply(input.view(), context, caught);
        const std::chrono::duration<double, std::milli> taken = std::chrono::steady_clock::now() - begin;
        const Mesh output(std::move(caught.soup), name);
        const ClosestFace to_output(output.view().positions, output.view().triangles);
        const double step = 0.1 * output.view().mean_edge;
        const std::string distances =
            fmt::format("{:.3f}, {:.3f}", 100 * one_sided(output.view(), to_input, step, context) / diagonal,
                        100 * one_sided(input.view(), to_output, step, context) / diagonal);
        print(name, std::to_string(faces), output.view(), diagonal, distances, std::to_string(int(taken.count())));
        if (!folder.empty())
          write_mesh(folder / (name + "-" + std::to_string(faces) + ".ply"), output.view().positions,
                     output.view().triangles);
      }
    } catch (const std::exception& error) {
      std::fprintf(stderr, "%s: %s\n", file.c_str(), error.what());
    }
  return 0;
}
