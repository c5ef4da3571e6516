// SPDX-License-Identifier: BSD-3-Clause
#include <filesystem>

#include "index/index_document.h"
#include "index/json_table.h"

namespace toposcope {
namespace {

SceneJson labelers_table(const std::vector<Comparison>& comparisons) {
  JsonTable table("labelers", "Labelers over all meshes");
  table.column("labeler", "text")
      .column("meshes", "number")
      .column("proven optimal", "number")
      .column("unsound", "number");
  table.column("mean gap", "number", "nats").column("worst gap", "number", "nats").column("mean posterior", "percent");
  table.column("median", "ms", "ms").column("worst", "ms", "ms").column("nodes", "number");
  table.column("right", "number").column("of", "number").column("part right", "percent");
  for (const Total& t : totals(comparisons))
    table.row({t.labeler, t.meshes, t.proven, t.unsound, finite(t.mean_gap), finite(t.worst_gap),
               finite(t.mean_posterior), finite(t.median_ms), finite(t.worst_ms), t.nodes,
               t.of > 0 ? SceneJson(t.right) : SceneJson(nullptr), t.of > 0 ? SceneJson(t.of) : SceneJson(nullptr),
               part(t.right, t.of)});
  return table.take();
}

std::string name_of(const Comparison& comparison) {
  return std::filesystem::path(comparison.mesh).filename().string();
}

SceneJson entries_table(const std::vector<Comparison>& comparisons) {
  JsonTable table("entries", "Each mesh under each labeler");
  table.column("mesh", "text").column("labeler", "text").column("class", "text").column("cost", "number", "nats");
  table.column("bound", "number", "nats").column("gap", "number", "nats").column("proven", "text");
  table.column("posterior", "percent").column("time", "ms", "ms").column("nodes", "number");
  table.column("right", "number").column("of", "number").column("promise", "text");
  for (const Comparison& comparison : comparisons)
    for (const Entry& e : comparison.entries)
      table.row({name_of(comparison), e.labeler, e.class_name, finite(e.cost), finite(e.bound), finite(e.gap()),
                 e.proven ? "yes" : "no", finite(e.posterior), finite(e.time_ms), e.nodes,
                 e.right ? SceneJson(*e.right) : SceneJson(nullptr), e.of ? SceneJson(*e.of) : SceneJson(nullptr),
                 e.guarantee});
  return table.take();
}

}  // namespace

std::string comparison_index(const std::vector<Comparison>& comparisons, const std::vector<MeshCard>& cards,
                             const std::vector<LabelerView>& views, const std::string& program) {
  SceneJson root = {{"schema", "toposcope.index/1"}, {"title", "Labelers side by side"}, {"program", program}};
  if (comparisons.size() == 1) root["title"] = "Labelers side by side · " + name_of(comparisons[0]);
  root["tables"] = {labelers_table(comparisons), entries_table(comparisons)};
  root["meshes"] = SceneJson::array();
  for (std::size_t m = 0; m < comparisons.size(); ++m) {
    SceneJson verdicts = SceneJson::object();  // of a labeler: whether all that is known of the mesh is right
    for (const Entry& entry : comparisons[m].entries)
      if (entry.of) verdicts[entry.labeler] = *entry.right == *entry.of ? "right" : "wrong";
    root["meshes"].push_back({{"name", name_of(comparisons[m])},
                              {"thumbnail", data_uri(cards[m].thumbnail)},
                              {"verdicts", std::move(verdicts)},
                              {"report", text_or_null(cards[m].report)}});
  }
  root["views"] = SceneJson::array();
  for (const LabelerView& view : views)
    root["views"].push_back({{"name", view.name}, {"scene", SceneJson::parse(to_json(view.scene, program))}});
  return root.dump(-1, ' ', false, SceneJson::error_handler_t::replace) + "\n";
}

}  // namespace toposcope
