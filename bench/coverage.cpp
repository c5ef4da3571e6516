// SPDX-License-Identifier: BSD-3-Clause

// How many marked features of real meshes have a working set of their own, whatever a model makes of it later.
//
//   coverage DATA PLUGIN [--set OPTION=VALUE]... [--faces N,N,...] [--type-of FEATURE...] [--verbose]
//
// DATA holds cup/*.off and airplane/*.off with *.truth.json beside them. A feature is covered when some candidate set
// holds at least 80 % of its marked vertices (on a normalised mesh: the vertices nearest to the marked points) and at
// most half of the set's own vertices lie farther than 4 mean edges from all marked points. A handle connection has two
// rings of marks, each of which wants a set.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>

#include "base/run_context.h"
#include "io/mesh_io.h"
#include "pipeline/working_sets.h"
#include "plugin/plugin_host.h"

namespace {

using namespace toposcope;
namespace fs = std::filesystem;
using nlohmann::json;

using Marks = std::vector<std::vector<Vec3>>;  ///< groups of points on the mesh

struct Feature {
  std::string name;
  Marks groups;
};

std::vector<Feature> read_marks(const fs::path& file, const TriangleSoup& soup) {
  std::ifstream stream(file);
  const json truth = json::parse(stream);
  std::vector<Feature> features;
  for (const auto& [name, entry] : truth["features"].items()) {
    Feature feature{name, {}};
    const auto add = [&](const json& group) {
      std::vector<Vec3> points;
      for (const json& v : group.value("vertices", json::array())) points.push_back(soup.positions[v.get<Index>()]);
      if (!points.empty()) feature.groups.push_back(std::move(points));
    };
    if (entry.contains("groups"))
      for (const json& group : entry["groups"]) add(group);
    else
      add(entry);
    if (!feature.groups.empty()) features.push_back(std::move(feature));
  }
  return features;
}

Index nearest_vertex(const MeshView& mesh, const Vec3& point) {
  Index best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (Index v = 0; v < mesh.vertex_count(); ++v)
    if (const double d = (mesh.positions[v] - point).squaredNorm(); d < least && !mesh.one_ring(v).empty()) {
      least = d;
      best = v;
    }
  return best;
}

struct Best {
  double held = 0, near = 0;  ///< parts
  std::string type;
  bool covered = false;
};

/// The set that covers the group best.
Best cover(const MeshView& mesh, const WorkingSets& sets, const std::vector<Vec3>& marks) {
  std::vector<bool> marked(mesh.vertex_count(), false), close(mesh.vertex_count(), false);
  for (const Vec3& p : marks) marked[nearest_vertex(mesh, p)] = true;
  const auto wanted = static_cast<double>(std::count(marked.begin(), marked.end(), true));
  const double reach = 4 * mesh.mean_edge;
  for (Index v = 0; v < mesh.vertex_count(); ++v)
    close[v] = std::any_of(marks.begin(), marks.end(),
                           [&](const Vec3& p) { return (p - mesh.positions[v]).squaredNorm() <= reach * reach; });
  Best best;
  for (std::size_t s = 0; s < sets.size(); ++s) {
    double held = 0, near = 0;
    for (Index v : sets[s]) {
      held += marked[v];
      near += close[v];
    }
    held /= wanted;
    near /= static_cast<double>(sets[s].size());
    const auto worth = [](double h, double n) { return std::min(h / 0.8, 1.0) + std::min(n / 0.5, 1.0); };
    if (worth(held, near) > worth(best.held, best.near))
      best = {held, near, sets.type_names[sets.types[s]], held >= 0.8 && near >= 0.5};
  }
  return best;
}

std::optional<Mesh> filtered(const MeshView& mesh, const MeshFilter& filter, Context& context) {
  struct Sink final : MeshSink {
    std::optional<TriangleSoup> soup;
    void set(std::span<const Vec3> positions, std::span<const Triangle> triangles,
             std::span<const Index> origin) override {
      soup.emplace();
      soup->positions.assign(positions.begin(), positions.end());
      soup->triangles.assign(triangles.begin(), triangles.end());
      soup->face_origin.assign(origin.begin(), origin.end());
    }
  } sink;
  filter.apply(mesh, context, sink);
  if (!sink.soup) return std::nullopt;
  sink.soup->input_faces = mesh.face_count();
  return Mesh(std::move(*sink.soup), "normalised");
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Coverage of marked features by working sets"};
  fs::path data;
  std::string plugin;
  std::vector<std::string> settings, classes = {"cup", "airplane"};
  std::vector<int> resolutions = {0};
  double scale = 1;
  bool verbose = false;
  app.add_option("data", data)->required();
  app.add_option("plugin", plugin)->required();
  app.add_option("--set", settings)->allow_extra_args(false);
  app.add_option("--faces", resolutions, "face counts to normalise to; 0: as given")->delimiter(',');
  app.add_option("--class", classes)->delimiter(',');
  app.add_option("--scale", scale);
  app.add_flag("--verbose", verbose);
  CLI11_PARSE(app, argc, argv);

  PluginHost host{PluginCatalog({{fs::path(TOPOSCOPE_BUILD_DIR) / "plugins", true}})};
  const auto given = [](const std::vector<std::string>& texts) {
    std::vector<GivenOption> options;
    for (const std::string& text : texts)
      options.push_back({text.substr(0, text.find('=')), text.substr(text.find('=') + 1)});
    return options;
  };
  const PluginManifest& manifest = host.catalog().require(PluginKind::worksets, plugin);
  const auto classifier = host.worksets(plugin, check_options(manifest.options, given(settings), plugin));
  std::vector<std::string> types;
  for (const ProvidedRow& row : manifest.provides) types.push_back(row.name);
  RunContext context;

  fmt::print("| class | faces | features | covered | | sets a mesh: median | most | ms a mesh: median |\n");
  fmt::print("|---|---|---|---|---|---|---|---|\n");
  for (const int faces : resolutions) {
    int all = 0, all_covered = 0;
    for (const std::string& name : classes) {
      std::vector<fs::path> files;
      for (const auto& entry : fs::directory_iterator(data / name))
        if (entry.path().extension() == ".off") files.push_back(entry.path());
      std::sort(files.begin(), files.end());
      int features = 0, covered = 0;
      std::vector<std::size_t> counts;
      std::vector<double> times;
      std::string missed;
      for (const fs::path& file : files) {
        TriangleSoup soup = read_soup(file);
        for (Vec3& p : soup.positions) p *= scale;
        const std::vector<Feature> marks = read_marks(fs::path(file).replace_extension(".truth.json"), soup);
        Mesh mesh(std::move(soup), file.string());
        if (faces > 0) {
          const PluginManifest& filter = host.catalog().require(PluginKind::filters, "normalise");
          const auto options = check_options(filter.options, given({"faces=" + std::to_string(faces)}), "normalise");
          if (auto made = filtered(mesh.view(), *host.filter("normalise", options), context)) mesh = std::move(*made);
        }
        const auto start = std::chrono::steady_clock::now();
        const WorkingSets sets = classify_mesh(mesh.view(), *classifier, plugin, types, context);
        times.push_back(std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
        counts.push_back(sets.size());
        for (const Feature& feature : marks) {
          ++features;
          bool good = true;
          for (const auto& group : feature.groups) {
            const Best best = cover(mesh.view(), sets, group);
            good = good && best.covered;
            if (verbose && !best.covered)
              missed += fmt::format("  {} {} {}: holds {:.0f} %, near {:.0f} % ({}), {} marks\n", file.stem().string(),
                                    feature.name, faces, 100 * best.held, 100 * best.near, best.type, group.size());
          }
          covered += good;
        }
      }
      std::sort(counts.begin(), counts.end());
      std::sort(times.begin(), times.end());
      fmt::print("| {} | {} | {} | {} | {:.1f} % | {} | {} | {:.0f} |\n", name,
                 faces == 0 ? "as given" : std::to_string(faces), features, covered, 100.0 * covered / features,
                 counts[counts.size() / 2], counts.back(), times[times.size() / 2]);
      if (verbose) fmt::print("{}", missed);
      all += features;
      all_covered += covered;
    }
    fmt::print("| all | {} | {} | {} | {:.1f} % | | | |\n", faces == 0 ? "as given" : std::to_string(faces), all,
               all_covered, 100.0 * all_covered / all);
    std::fflush(stdout);
  }
}
