// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/working_sets.h"

#include <algorithm>
#include <limits>

#include "base/errors.h"
#include "plugin/guard.h"
#include "toposcope/geometry/large_array.h"

namespace toposcope {
namespace {

constexpr Index none = std::numeric_limits<Index>::max();

/// Copies the sets that a classifier gives, and refuses what is wrong at first sight.
class CopyingSink final : public WorkingSetSink {
 public:
  CopyingSink(const std::string& plugin, WorkingSets& sets) : plugin_(plugin), sets_(sets) {}

  void add(std::string_view type, std::span<const Index> vertices, double saliency) override {
    const auto found = std::find(sets_.type_names.begin(), sets_.type_names.end(), type);
    if (found == sets_.type_names.end())
      fail(plugin_, "of type '" + std::string(type) + "', which its descriptor does not provide");
    if (vertices.empty()) fail(plugin_, "without a vertex");
    if (!(saliency >= 0 && saliency <= 1))
      fail(plugin_, "of saliency " + std::to_string(saliency) + ", not within 0 to 1");
    make_room(sets_.vertices.size() + vertices.size());
    sets_.vertices.insert(sets_.vertices.end(), vertices.begin(), vertices.end());
    sets_.offsets.push_back(static_cast<Index>(sets_.vertices.size()));
    sets_.types.push_back(static_cast<Index>(found - sets_.type_names.begin()));
    sets_.saliency.push_back(saliency);
  }

  [[noreturn]] static void fail(const std::string& plugin, const std::string& what) {
    throw PluginError(plugin, "gave a working set " + what);
  }

 private:
  void make_room(std::size_t needed) {
    if (needed <= sets_.vertices.capacity()) return;
    std::vector<Index> larger;
    reserve_large(larger, std::max(needed, 2 * sets_.vertices.capacity()));
    larger.assign(sets_.vertices.begin(), sets_.vertices.end());
    sets_.vertices.swap(larger);
  }

  const std::string& plugin_;
  WorkingSets& sets_;
};

/// Sorts sets and refuses those that break the contract.
class Checker {
 public:
  Checker(const MeshView& mesh, const std::string& plugin)
      : mesh_(mesh), plugin_(plugin), owner_(large_array<Index>(mesh.vertex_count(), none)) {}

  void check(std::span<Index> vertices, Index set) {
    if (!std::is_sorted(vertices.begin(), vertices.end())) std::sort(vertices.begin(), vertices.end());
    if (vertices.back() >= mesh_.vertex_count())
      CopyingSink::fail(plugin_, "with vertex " + std::to_string(vertices.back()) + "; the mesh has " +
                                     std::to_string(mesh_.vertex_count()));
    if (const auto twice = std::adjacent_find(vertices.begin(), vertices.end()); twice != vertices.end())
      CopyingSink::fail(plugin_, "that names vertex " + std::to_string(*twice) + " twice");
    for (Index v : vertices) owner_[v] = set;
    if (!connected(vertices, set)) CopyingSink::fail(plugin_, "that is not connected");
  }

 private:
  bool connected(std::span<const Index> vertices, Index set) {
    frontier_.assign(1, vertices.front());
    owner_[vertices.front()] = none;  // unmark as reached, so that a second visit stops
    std::size_t reached = 0;
    for (; reached < frontier_.size(); ++reached)
      for (Index q : mesh_.one_ring(frontier_[reached]))
        if (owner_[q] == set) {
          owner_[q] = none;
          frontier_.push_back(q);
        }
    return reached == vertices.size();
  }

  const MeshView& mesh_;
  const std::string& plugin_;
  std::vector<Index> owner_;
  std::vector<Index> frontier_;
};

}  // namespace

WorkingSets classify_mesh(const MeshView& mesh, const WorkingSetStation& station, Context& context) {
  WorkingSets sets;
  sets.type_names = station.types;
  CopyingSink sink(station.id, sets);
  guard(station.id, [&] { station.plugin->classify(mesh, context, sink); });
  // Few chunks: each has a mark per vertex of the mesh.
  const std::size_t chunk = std::max<std::size_t>(16, sets.size() / 8);
  context.parallel_for(sets.size(), chunk, [&](std::size_t first, std::size_t last) {
    Checker checker(mesh, station.id);
    for (std::size_t s = first; s < last; ++s)
      checker.check(std::span(sets.vertices).subspan(sets.offsets[s], sets.offsets[s + 1] - sets.offsets[s]),
                    static_cast<Index>(s));
  });
  return sets;
}

}  // namespace toposcope
