// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/working_sets.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <unordered_map>

#include "base/errors.h"
#include "plugin/guard.h"
#include "toposcope/geometry/large_array.h"

namespace toposcope {
namespace {

constexpr Index none = std::numeric_limits<Index>::max();

/// Copies the sets that a classifier gives, and refuses what is wrong at first sight.
class CopyingSink final : public WorkingSetSink {
 public:
  CopyingSink(const WorkingSetStation& station, WorkingSets& sets)
      : plugin_(station.id), provided_(station.types), sets_(sets), number_(number_in(sets.plugin_names, station.id)) {}

  void add(std::string_view type, std::span<const Index> vertices, double saliency) override {
    if (std::find(provided_.begin(), provided_.end(), type) == provided_.end())
      fail(plugin_, "of type '" + std::string(type) + "', which its descriptor does not provide");
    if (vertices.empty()) fail(plugin_, "without a vertex");
    if (!(saliency >= 0 && saliency <= 1))
      fail(plugin_, "of saliency " + std::to_string(saliency) + ", not within 0 to 1");
    make_room(sets_.vertices.size() + vertices.size());
    sets_.vertices.insert(sets_.vertices.end(), vertices.begin(), vertices.end());
    sets_.offsets.push_back(static_cast<Index>(sets_.vertices.size()));
    sets_.types.push_back(number_in(sets_.type_names, type));
    sets_.plugins.push_back(number_);
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

  /// The place of a name; it is added where it is new.
  static Index number_in(std::vector<std::string>& names, std::string_view name) {
    const auto found = std::find(names.begin(), names.end(), name);
    if (found != names.end()) return static_cast<Index>(found - names.begin());
    names.emplace_back(name);
    return static_cast<Index>(names.size() - 1);
  }

  const std::string& plugin_;
  const std::vector<std::string>& provided_;
  WorkingSets& sets_;
  Index number_;
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

/// The sets of one classifier, after those that are there.
void classify_by(const WorkingSetStation& station, const MeshView& mesh, Context& context, WorkingSets& sets) {
  const std::size_t before = sets.size();
  CopyingSink sink(station, sets);
  guard(station.id, [&] { station.plugin->classify(mesh, context, sink); });
  // Few chunks: each has a mark per vertex of the mesh.
  const std::size_t count = sets.size() - before, chunk = std::max<std::size_t>(16, count / 8);
  context.parallel_for(count, chunk, [&](std::size_t first, std::size_t last) {
    Checker checker(mesh, station.id);
    for (std::size_t s = before + first; s < before + last; ++s)
      checker.check(std::span(sets.vertices).subspan(sets.offsets[s], sets.offsets[s + 1] - sets.offsets[s]),
                    static_cast<Index>(s));
  });
}

/// Whether two sets are one: of one type, with the same vertices.
bool same_set(const WorkingSets& sets, Index a, Index b) {
  return sets.types[a] == sets.types[b] && std::equal(sets[a].begin(), sets[a].end(), sets[b].begin(), sets[b].end());
}

/// For each set the first that is the same.
std::vector<Index> first_of_equals(const WorkingSets& sets) {
  std::unordered_map<std::uint64_t, std::vector<Index>> seen;
  std::vector<Index> first(sets.size());
  for (Index s = 0; s < sets.size(); ++s) {
    std::uint64_t hash = sets.types[s];
    for (const Index v : sets[s]) hash = (hash ^ v) * 0x9E3779B97F4A7C15u + (hash >> 29);
    std::vector<Index>& alike = seen[hash];
    const auto same = std::find_if(alike.begin(), alike.end(), [&](Index other) { return same_set(sets, other, s); });
    first[s] = same == alike.end() ? s : *same;
    if (same == alike.end()) alike.push_back(s);
  }
  return first;
}

void remove_doubles(WorkingSets& sets) {
  const std::vector<Index> first = first_of_equals(sets);
  for (Index s = 0; s < first.size(); ++s)
    sets.saliency[first[s]] = std::max(sets.saliency[first[s]], sets.saliency[s]);
  Index kept = 0, end = 0;
  for (Index s = 0; s < first.size(); ++s) {
    if (first[s] != s) continue;
    const std::span<const Index> from = sets[s];
    std::copy(from.begin(), from.end(), sets.vertices.begin() + end);
    end += static_cast<Index>(from.size());
    sets.plugins[kept] = sets.plugins[s];
    sets.types[kept] = sets.types[s];
    sets.saliency[kept] = sets.saliency[s];
    sets.offsets[++kept] = end;  // that of a set which has been read
  }
  sets.vertices.resize(end);
  sets.offsets.resize(kept + 1);
  sets.plugins.resize(kept);
  sets.types.resize(kept);
  sets.saliency.resize(kept);
}

}  // namespace

WorkingSets classify_mesh(const MeshView& mesh, std::span<const WorkingSetStation> stations, Context& context) {
  WorkingSets sets;
  for (const WorkingSetStation& station : stations)
    for (const std::string& type : station.types)
      if (std::find(sets.type_names.begin(), sets.type_names.end(), type) == sets.type_names.end())
        sets.type_names.push_back(type);
  for (const WorkingSetStation& station : stations) classify_by(station, mesh, context, sets);
  if (stations.size() > 1) remove_doubles(sets);
  return sets;
}

}  // namespace toposcope
