// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/working_sets.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include "base/errors.h"

namespace toposcope {
namespace {

constexpr Index none = std::numeric_limits<Index>::max();

/// Copies the sets that a classifier gives, and refuses what breaks its contract.
class CheckedSink final : public WorkingSetSink {
 public:
  CheckedSink(const MeshView& mesh, const std::string& plugin, WorkingSets& sets)
      : mesh_(mesh), plugin_(plugin), sets_(sets), owner_(mesh.vertex_count(), none) {}

  void add(std::string_view type, std::span<const Index> vertices, double saliency) override {
    const auto found = std::find(sets_.type_names.begin(), sets_.type_names.end(), type);
    if (found == sets_.type_names.end())
      fail("of type '" + std::string(type) + "', which its descriptor does not provide");
    if (vertices.empty()) fail("without a vertex");
    if (!(saliency >= 0 && saliency <= 1)) fail("of saliency " + std::to_string(saliency) + ", not within 0 to 1");
    const Index set = static_cast<Index>(sets_.size());
    for (Index v : vertices) {
      if (v >= mesh_.vertex_count())
        fail("with vertex " + std::to_string(v) + "; the mesh has " + std::to_string(mesh_.vertex_count()));
      if (owner_[v] == set) fail("that names vertex " + std::to_string(v) + " twice");
      owner_[v] = set;
    }
    if (!connected(vertices, set)) fail("that is not connected");
    const auto begin = static_cast<std::ptrdiff_t>(sets_.vertices.size());
    sets_.vertices.insert(sets_.vertices.end(), vertices.begin(), vertices.end());
    if (!std::is_sorted(sets_.vertices.begin() + begin, sets_.vertices.end()))
      std::sort(sets_.vertices.begin() + begin, sets_.vertices.end());
    sets_.offsets.push_back(static_cast<Index>(sets_.vertices.size()));
    sets_.types.push_back(static_cast<Index>(found - sets_.type_names.begin()));
    sets_.saliency.push_back(saliency);
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
  [[noreturn]] void fail(const std::string& what) const { throw PluginError(plugin_, "gave a working set " + what); }

  const MeshView& mesh_;
  const std::string& plugin_;
  WorkingSets& sets_;
  std::vector<Index> owner_;
  std::vector<Index> frontier_;
};

}  // namespace

WorkingSets classify_mesh(const MeshView& mesh, const WorkingSetClassifier& classifier, const std::string& plugin,
                          const std::vector<std::string>& types, Context& context) {
  WorkingSets sets;
  sets.type_names = types;
  CheckedSink sink(mesh, plugin, sets);
  classifier.classify(mesh, context, sink);
  return sets;
}

BitMatrix overlaps(const WorkingSets& sets, Index vertex_count) {
  // Sets that hold each vertex, in compressed rows.
  std::vector<Index> offsets(vertex_count + 1, 0);
  for (Index v : sets.vertices) ++offsets[v + 1];
  std::partial_sum(offsets.begin(), offsets.end(), offsets.begin());
  std::vector<Index> holders(sets.vertices.size());
  std::vector<Index> next(offsets.begin(), offsets.end() - 1);
  for (Index s = 0; s < sets.size(); ++s)
    for (Index v : sets[s]) holders[next[v]++] = s;

  BitMatrix shared(sets.size());
  std::span<const Index> previous;
  for (Index v = 0; v < vertex_count; ++v) {
    const std::span<const Index> row = std::span(holders).subspan(offsets[v], offsets[v + 1] - offsets[v]);
    // Most vertices are held by the same sets as the one before.
    if (std::equal(row.begin(), row.end(), previous.begin(), previous.end())) continue;
    previous = row;
    for (Index a : row)
      for (Index b : row) shared.set(a, b);
  }
  return shared;
}

}  // namespace toposcope
