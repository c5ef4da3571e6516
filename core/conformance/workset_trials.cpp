// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>

#include "base/errors.h"
#include "base/run_context.h"
#include "mesh_trial.h"
#include "pipeline/working_sets.h"

namespace toposcope {
namespace {

/// Sets as they were given, before anything is checked.
struct RawSets final : WorkingSetSink, WorkingSetClassifier {
  struct Set {
    std::string type;
    std::vector<Index> vertices;
    double saliency;
  };
  void add(std::string_view type, std::span<const Index> vertices, double saliency) override {
    sets.push_back({std::string(type), {vertices.begin(), vertices.end()}, saliency});
  }
  /// Gives them to the kernel's own check.
  void classify(const MeshView&, Context&, WorkingSetSink& sink) const override {
    for (const Set& set : sets) sink.add(set.type, set.vertices, set.saliency);
  }
  std::vector<Set> sets;
};

class WorksetTrial final : public MeshTrial {
 public:
  WorksetTrial(std::string called, TriangleSoup soup, std::vector<std::string> types, Poison poison = Poison::none)
      : MeshTrial(std::move(called), std::move(soup), poison), types_(std::move(types)) {}

  Answer run(const void* object, const Options&, Context& context) const override {
    auto raw = std::make_shared<RawSets>();
    static_cast<const WorkingSetClassifier*>(object)->classify(view(), context, *raw);
    Answer answer;
    RunContext quiet({.threads = 1});
    try {
      const WorkingSetStation station{"", types_, raw};
      classify_mesh(view(), {&station, 1}, quiet);
    } catch (const PluginError& error) {
      answer.flaw = std::string(error.what()).substr(std::string("plugin '': ").size());
    }
    append_bytes(answer.bytes, raw->sets.size());
    for (const RawSets::Set& set : raw->sets) {
      append_bytes(answer.bytes, set.type);
      append_bytes(answer.bytes, set.vertices);
      append_bytes(answer.bytes, set.saliency);
    }
    answer.value = std::move(raw);
    return answer;
  }

  std::unique_ptr<Trial> moved(const Motion& motion) const override {
    return std::make_unique<WorksetTrial>(name, toposcope::moved(soup(), motion), types_);
  }

  /// Weighted by size, how much of the sets of each answer is found as a set of the other.
  std::string change(const Answer& before, const Answer& after, const Motion& motion) const override {
    const auto& first = *static_cast<const RawSets*>(before.value.get());
    RawSets second = *static_cast<const RawSets*>(after.value.get());
    const std::vector<Index> old_of = vertex_order(motion);
    if (!old_of.empty())
      for (RawSets::Set& set : second.sets)
        for (Index& v : set.vertices) v = old_of[v];
    const double kept = std::min(agreement(first, second), agreement(second, first));
    if (kept >= 0.9) return "";
    return fmt::format("on {}, {:.0f} % of what is in {} sets is found again in {} sets; at least 90 % must be", name,
                       100 * kept, first.sets.size(), second.sets.size());
  }

 private:
  double agreement(const RawSets& of, const RawSets& in) const {
    double sum = 0, weight = 0;
    for (const RawSets::Set& set : of.sets) {
      std::vector<char> inside(view().vertex_count(), 0);
      for (const Index v : set.vertices) inside[v] = 1;
      double best = 0;
      for (const RawSets::Set& other : in.sets) {
        if (other.type != set.type) continue;
        const auto both = static_cast<double>(
            std::count_if(other.vertices.begin(), other.vertices.end(), [&](Index v) { return inside[v] != 0; }));
        best = std::max(best, both / (static_cast<double>(set.vertices.size() + other.vertices.size()) - both));
      }
      const auto size = static_cast<double>(set.vertices.size());
      sum += best * size;
      weight += size;
    }
    return weight > 0 ? sum / weight : (in.sets.empty() ? 1 : 0);
  }

  std::vector<std::string> types_;
};

}  // namespace

TrialSet workset_trials(const PluginManifest& plugin) {
  std::vector<std::string> types;
  for (const ProvidedRow& row : plugin.provides) types.push_back(row.name);
  return mesh_trials([&](std::string name, TriangleSoup soup, Poison poison) -> std::unique_ptr<Trial> {
    return std::make_unique<WorksetTrial>(std::move(name), std::move(soup), types, poison);
  });
}

}  // namespace toposcope
