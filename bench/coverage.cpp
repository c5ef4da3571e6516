// SPDX-License-Identifier: BSD-3-Clause

// How many marked features of real meshes have a working set of their own, whatever a model makes of it later.
//
//   coverage DATA PLUGIN [--set OPTION=VALUE]... [--faces N,N,...] [--scale S] [--pictures FOLDER] [--verbose]
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
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>

#include "base/run_context.h"
#include "io/mesh_io.h"
#include "picture.h"
#include "pipeline/working_sets.h"
#include "plugin/plugin_host.h"
#include "table/table.h"
#include "toposcope/geometry/lines.h"
#include "truth/truth.h"

namespace {

using namespace toposcope;
namespace fs = std::filesystem;
using nlohmann::json;

struct Feature {
  std::string name;
  int color = 0;                          ///< its place in the file, whether other features are missing or not
  std::vector<std::vector<Vec3>> groups;  ///< points on the mesh
};

/// The marked vertices of each feature that is there, by groups. \param positions  of the mesh that was marked
std::vector<Feature> read_marks(const Truth& truth, const std::vector<Vec3>& positions) {
  std::vector<Feature> features;
  int color = 0;
  for (const TruthFeature& marked : truth.features) {
    Feature feature{marked.name, color++, {}};
    if (marked.groups.empty() && !marked.vertices.empty()) {
      std::vector<Vec3>& points = feature.groups.emplace_back();
      for (const Index v : marked.vertices) points.push_back(positions[v]);
    }
    for (const TruthGroup& group : marked.groups) {
      std::vector<Vec3>& points = feature.groups.emplace_back();
      for (const Index i : group.members) points.push_back(positions[marked.vertices.at(i)]);
    }
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
  std::size_t set = 0;
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
    const bool covered = held >= 0.8 && near >= 0.5;
    const auto worth = [](double h, double n) { return std::min(h / 0.8, 1.0) + std::min(n / 0.5, 1.0) + 0.1 * h * n; };
    if (covered > best.covered || (covered == best.covered && worth(held, near) > worth(best.held, best.near)))
      best = {s, held, near, sets.type_names[sets.types[s]], covered};
  }
  return best;
}

/// Colour-blind safe (Okabe and Ito).
constexpr std::array<Rgb, 5> palette = {{{0, 158, 115}, {204, 121, 167}, {86, 180, 233}, {230, 159, 0}, {213, 94, 0}}};

/// The best set of each feature in the feature's colour; grey where none covers.
class Painter {
 public:
  explicit Painter(const MeshView& mesh) : mesh_(mesh), feature_(mesh.vertex_count(), -1) {}
  void paint(std::span<const Index> set, int feature) {
    for (Index v : set) feature_[v] = feature;
  }
  void draw(bench::Picture& picture, const bench::View& view, int x, int y, int size) const {
    const auto color = [&](const Triangle& t) -> Rgb {
      for (const Index v : t)
        if (feature_[v] >= 0 && feature_[v] == feature_[v == t[0] ? t[1] : t[0]])
          return palette[static_cast<std::size_t>(feature_[v]) % palette.size()];
      return {200, 200, 200};
    };
    picture.draw(mesh_, color, view, x, y, size);
  }

 private:
  const MeshView& mesh_;
  std::vector<int> feature_;
};

/// From the side and somewhat above, in the object's own frame.
bench::View view_of(const json& frame) {
  const auto vector = [&](const char* name) {
    return Vec3(frame[name][0].get<double>(), frame[name][1].get<double>(), frame[name][2].get<double>());
  };
  if (frame.contains("nose"))
    return bench::look(vector("nose") + 0.8 * vector("port") + 0.9 * vector("up"), vector("up"));
  const Vec3 axis = vector("axis");
  return bench::look(0.8 * any_perpendicular(axis) + 0.65 * axis, axis);
}

std::optional<Mesh> filtered(const MeshView& mesh, const MeshFilter& filter, Context& context) {
  struct Sink final : MeshSink {
    std::optional<TriangleSoup> soup;
    void set(std::span<const Vec3> positions, std::span<const Triangle> triangles, std::span<const Index> origin,
             std::span<const Index>) override {
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

struct Tally {
  int features = 0, covered = 0;
  std::vector<std::size_t> sets;  ///< per mesh
  std::vector<double> times_ms;   ///< of the station classify, per mesh
  std::string missed;
};

/// Measures one class of objects at one resolution and draws its row of the picture.
class Measurement {
 public:
  Measurement(PluginHost& host, const std::string& plugin, const std::vector<std::string>& settings) : host_(host) {
    const PluginManifest& manifest = host.catalog().require(PluginKind::worksets, plugin);
    std::vector<GivenOption> given;
    for (const std::string& text : settings)
      given.push_back({text.substr(0, text.find('=')), text.substr(text.find('=') + 1)});
    station_ = {plugin, {}, host.worksets(plugin, check_options(manifest.options, given, plugin))};
    for (const ProvidedRow& row : manifest.provides) station_.types.push_back(row.name);
  }

  void add(const fs::path& file, int faces, double scale, Tally& tally, bench::Picture& picture, int x, int y) {
    const Truth truth = read_truth(truth_beside(file));
    TriangleSoup soup = read_soup(file);
    for (Vec3& p : soup.positions) p *= scale;
    const std::vector<Feature> features = read_marks(truth, soup.positions);
    Mesh mesh(std::move(soup), file.string());
    if (faces > 0)
      if (auto made = normalised(mesh.view(), faces)) mesh = std::move(*made);

    const auto start = std::chrono::steady_clock::now();
    const WorkingSets sets = classify_mesh(mesh.view(), {&station_, 1}, context_);
    tally.times_ms.push_back(
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
    tally.sets.push_back(sets.size());
    Painter painter(mesh.view());
    for (std::size_t f = 0; f < features.size(); ++f) {
      bool good = true;
      for (const auto& group : features[f].groups) {
        const Best best = cover(mesh.view(), sets, group);
        good = good && best.covered;
        if (best.covered)
          painter.paint(sets[best.set], features[f].color);
        else
          tally.missed +=
              fmt::format("  {} {} {}: holds {:.0f} %, near {:.0f} % ({}), {} marks\n", file.stem().string(),
                          features[f].name, faces, 100 * best.held, 100 * best.near, best.type, group.size());
      }
      ++tally.features;
      tally.covered += good;
    }
    painter.draw(picture, view_of(json::parse(truth.document)["frame"]), x, y, picture_size);
  }

  static constexpr int picture_size = 150;

 private:
  std::optional<Mesh> normalised(const MeshView& mesh, int faces) {
    const PluginManifest& manifest = host_.catalog().require(PluginKind::filters, "normalise");
    const std::vector<GivenOption> given = {{"faces", std::to_string(faces)}};
    return filtered(mesh, *host_.filter("normalise", check_options(manifest.options, given, "normalise")), context_);
  }

  PluginHost& host_;
  WorkingSetStation station_;
  RunContext context_;
};

template <class T>
T median(std::vector<T> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

std::vector<fs::path> meshes(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().extension() == ".off") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Coverage of marked features by working sets"};
  fs::path data, pictures;
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
  app.add_option("--scale", scale, "a factor on all coordinates");
  app.add_option("--pictures", pictures, "folder for CLASS.png: a column a mesh, a row a resolution");
  app.add_flag("--verbose", verbose, "say what is missed");
  CLI11_PARSE(app, argc, argv);

  PluginHost host{PluginCatalog({{fs::path(TOPOSCOPE_BUILD_DIR) / "plugins", true}})};
  Measurement measurement(host, plugin, settings);
  const std::vector<Column> columns = {"class",    "faces",
                                       "features", "covered",
                                       "",         "sets a mesh: median",
                                       "most",     {"ms a mesh: median", "ms", "ms", "{:.0f}"}};
  fmt::print("{}", markdown_header(columns));
  const auto print = [&](const std::string& name, int faces, std::pair<int, int> covered,
                         const std::vector<Cell>& sets) {
    std::vector<Cell> row = {name, faces == 0 ? "as given" : std::to_string(faces), std::to_string(covered.second),
                             std::to_string(covered.first),
                             fmt::format("{:.1f} %", 100.0 * covered.first / covered.second)};
    row.insert(row.end(), sets.begin(), sets.end());
    fmt::print("{}", markdown_row(columns, row));
  };
  constexpr int size = Measurement::picture_size;
  std::map<int, std::pair<int, int>> all;  // features covered, and all of them, by resolution
  for (const std::string& name : classes) {
    const std::vector<fs::path> files = meshes(data / name);
    bench::Picture picture(size * static_cast<int>(files.size()), size * static_cast<int>(resolutions.size()));
    for (std::size_t r = 0; r < resolutions.size(); ++r) {
      const int faces = resolutions[r];
      Tally tally;
      for (std::size_t i = 0; i < files.size(); ++i)
        measurement.add(files[i], faces, scale, tally, picture, size * static_cast<int>(i), size * static_cast<int>(r));
      print(name, faces, {tally.covered, tally.features},
            {median(tally.sets), *std::max_element(tally.sets.begin(), tally.sets.end()), median(tally.times_ms)});
      if (verbose) fmt::print("{}", tally.missed);
      std::fflush(stdout);
      all[faces].first += tally.covered;
      all[faces].second += tally.features;
    }
    if (!pictures.empty()) picture.save(pictures / (name + ".png"));
  }
  for (const int faces : resolutions) print("both", faces, all[faces], {"", "", ""});
}
