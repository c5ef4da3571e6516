// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// What a plugin author's own test needs, with any test framework or none: the plugin's object from its library, a quiet
// context, meshes and point sets by hand. Not part of the plugin boundary: a plugin does not include it.

#include <dlfcn.h>

#include <cstdio>
#include <cstdlib>
#include <map>
#include <memory>
#include <set>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "toposcope/geometry/point_sets.h"
#include "toposcope/plugin.h"

namespace toposcope::testing {

/// One thread, never cancelled, says nothing, gives a gibibyte.
class QuietContext final : public Context {
 public:
  /// Says nothing.
  void log(LogLevel, std::string_view) override {}
  void progress(double) override {}
  bool cancelled() const override { return false; }
  std::uint64_t seed() const override { return 1; }
  unsigned threads() const override { return 1; }
  /// One part after the other.
  void parallel_for(std::size_t count, std::size_t grain,
                    const std::function<void(std::size_t, std::size_t)>& body) override {
    grain = std::max<std::size_t>(grain, 1);
    for (std::size_t first = 0; first < count; first += grain) body(first, std::min(count, first + grain));
  }
  std::uint64_t memory_budget() const override { return std::uint64_t{1} << 30; }
};

/// Values of an option table: its defaults, and what is given instead. Keep it while its Options are in use.
class Values {
 public:
  /// Values as a user writes them, by name.
  using Given = std::map<std::string, std::string>;
  /// \throw std::invalid_argument  the table has no such option
  Values(std::span<const OptionSpec> table, Given given) {
    for (const OptionSpec& row : table) {
      const auto found = given.extract(row.name);
      const std::string text = found ? found.mapped() : row.default_value;
      const bool yes = row.type == OptionType::boolean && text == "true";
      values_.push_back({row.name, yes ? 1 : std::strtod(text.c_str(), nullptr), text});
    }
    if (!given.empty()) throw std::invalid_argument("the plugin has no option '" + given.begin()->first + "'");
  }
  /// As a plugin reads them.
  Options options() const { return Options(values_); }

 private:
  std::vector<OptionValue> values_;
};

/// A plugin's library and its object; Base is the kind's class, such as ShapeFitter.
template <class Base>
class Plugin {
 public:
  /// \throw std::runtime_error  the library cannot be loaded, is of another kind, or its object cannot be made
  explicit Plugin(const std::string& library, Values::Given options = {})
      : descriptor_(load(library)),
        values_({descriptor_.options, descriptor_.option_count}, std::move(options)),
        options_(values_.options()) {
    std::string error;
    object_.reset(static_cast<Base*>(descriptor_.create(&options_, &error)));
    if (!object_) throw std::runtime_error(library + ": " + error);
  }
  /// The plugin's object.
  const Base& operator*() const { return *object_; }
  /// \copydoc operator*
  const Base* operator->() const { return object_.get(); }
  /// What a model gives: the defaults of the plugin's arguments, and others instead.
  Values arguments(Values::Given given = {}) const {
    return {{descriptor_.arguments, descriptor_.argument_count}, std::move(given)};
  }

 private:
  static const PluginDescriptor& load(const std::string& library) {
    void* const handle = dlopen(library.c_str(), RTLD_NOW | RTLD_NODELETE);
    void* const symbol = handle ? dlsym(handle, TOPOSCOPE_PLUGIN_SYMBOL) : nullptr;
    if (!symbol) throw std::runtime_error(dlerror());
    const auto* descriptor = reinterpret_cast<const PluginDescriptor* (*)()>(symbol)();
    if (std::string(descriptor->kind) != detail::KindOf<Base>::name)
      throw std::runtime_error(library + ": is of kind " + descriptor->kind);
    return *descriptor;
  }

  const PluginDescriptor& descriptor_;
  Values values_;
  Options options_;
  std::unique_ptr<Base> object_;
};

/// A mesh from positions and triangles, with all that a MeshView points to.
class TestMesh {
 public:
  /// \pre indices of the triangles are of the positions
  TestMesh(std::vector<Vec3> positions, std::vector<Triangle> triangles)
      : positions_(std::move(positions)), triangles_(std::move(triangles)) {
    std::vector<std::set<Index>> rings(positions_.size()), around(positions_.size());
    for (Index f = 0; f < triangles_.size(); ++f)
      for (std::size_t k = 0; k < 3; ++k) {
        const Index v = triangles_[f][k];
        around[v].insert(f);
        rings[v].insert({triangles_[f][(k + 1) % 3], triangles_[f][(k + 2) % 3]});
      }
    double length = 0;
    for (Index v = 0; v < rings.size(); ++v) {
      for (const Index w : rings[v]) length += (positions_[v] - positions_[w]).norm();
      neighbors_.insert(neighbors_.end(), rings[v].begin(), rings[v].end());
      faces_.insert(faces_.end(), around[v].begin(), around[v].end());
      neighbor_offsets_.push_back(static_cast<Index>(neighbors_.size()));
      face_offsets_.push_back(static_cast<Index>(faces_.size()));
    }
    view_ = {positions_,    triangles_, neighbor_offsets_,        neighbors_,
             face_offsets_, faces_,     oriented_box(positions_), length / static_cast<double>(neighbors_.size())};
  }
  TestMesh(const TestMesh&) = delete;
  TestMesh& operator=(const TestMesh&) = delete;
  /// As plugins see it; lives as long as this.
  const MeshView& view() const { return view_; }

 private:
  std::vector<Vec3> positions_;
  std::vector<Triangle> triangles_;
  std::vector<Index> neighbor_offsets_ = {0}, neighbors_, face_offsets_ = {0}, faces_;
  MeshView view_;
};

/// One set of points, each of which stands for a square of `mean_edge`, fitted as if it were the whole object.
inline FittedShape fit(const ShapeFitter& fitter, std::span<const Vec3> points, double mean_edge,
                       const Options& arguments = {}) {
  const std::vector<double> areas(points.size(), mean_edge * mean_edge);
  const Index offsets[] = {0, static_cast<Index>(points.size())};
  const Box box = points.empty() ? Box{} : oriented_box(points);
  QuietContext context;
  return fitter.fit({points, areas, offsets, {&box, 1}, box, box, mean_edge}, arguments, context);
}

/// The working sets that a classifier gives.
struct FoundSets final : WorkingSetSink {
  /// One of them.
  struct Set {
    std::string type;             ///< of those that the classifier provides
    std::vector<Index> vertices;  ///< of the mesh, as given
    double saliency;              ///< 0 to 1
  };
  void add(std::string_view type, std::span<const Index> vertices, double saliency) override {
    sets.push_back({std::string(type), {vertices.begin(), vertices.end()}, saliency});
  }
  std::vector<Set> sets;  ///< in the order in which they came
};

/// The mesh that a filter makes; untouched where it makes none.
struct FilteredMesh final : MeshSink {
  void set(std::span<const Vec3> p, std::span<const Triangle> t, std::span<const Index> faces,
           std::span<const Index> vertices) override {
    positions.assign(p.begin(), p.end());
    triangles.assign(t.begin(), t.end());
    face_origin.assign(faces.begin(), faces.end());
    vertex_origin.assign(vertices.begin(), vertices.end());
  }
  std::vector<Vec3> positions;       ///< of the vertices
  std::vector<Triangle> triangles;   ///< of vertices
  std::vector<Index> face_origin;    ///< as MeshSink takes it
  std::vector<Index> vertex_origin;  ///< likewise
};

inline int failures = 0;  ///< what the test's main returns

/// Says where it does not hold, and goes on.
#define TOPOSCOPE_EXPECT(condition)                                                       \
  do {                                                                                    \
    if (!(condition)) {                                                                   \
      std::fprintf(stderr, "%s:%d: does not hold: %s\n", __FILE__, __LINE__, #condition); \
      ++::toposcope::testing::failures;                                                   \
    }                                                                                     \
  } while (false)

}  // namespace toposcope::testing
