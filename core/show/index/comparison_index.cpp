// SPDX-License-Identifier: BSD-3-Clause
#include <filesystem>

#include "index/index_document.h"
#include "index/json_values.h"
#include "table/table_json.h"

namespace toposcope {
namespace {

Table labelers_table(const std::vector<Comparison>& comparisons) {
  Table table{.title = "Labelers over all meshes", .id = "labelers"};
  table.columns = {"labeler",
                   {"meshes", "number"},
                   {"proven optimal", "number"},
                   {"unsound", "number"},
                   {"mean gap", "number", "nats"},
                   {"worst gap", "number", "nats"},
                   {"mean posterior", "percent"},
                   {"median", "ms", "ms"},
                   {"worst", "ms", "ms"},
                   {"nodes", "number"},
                   {"right", "number"},
                   {"of", "number"},
                   {"part right", "percent"}};
  const Cell none;
  for (const Total& t : totals(comparisons))
    table.rows.push_back({t.labeler, t.meshes, t.proven, t.unsound, t.mean_gap, t.worst_gap, t.mean_posterior,
                          t.median_ms, t.worst_ms, t.nodes, t.of > 0 ? Cell(t.right) : none,
                          t.of > 0 ? Cell(t.of) : none, share(t.right, t.of)});
  return table;
}

std::string name_of(const Comparison& comparison) {
  return std::filesystem::path(comparison.mesh).filename().string();
}

Table entries_table(const std::vector<Comparison>& comparisons) {
  Table table{.title = "Each mesh under each labeler", .id = "entries"};
  table.columns = {"mesh",
                   "labeler",
                   "class",
                   {"cost", "number", "nats"},
                   {"bound", "number", "nats"},
                   {"gap", "number", "nats"},
                   "proven",
                   {"posterior", "percent"},
                   {"time", "ms", "ms"},
                   {"nodes", "number"},
                   {"right", "number"},
                   {"of", "number"},
                   "promise"};
  for (const Comparison& comparison : comparisons)
    for (const Entry& e : comparison.entries)
      table.rows.push_back({name_of(comparison), e.labeler, e.class_name, e.cost, e.bound, e.gap(),
                            e.proven ? "yes" : "no", e.posterior, e.time_ms, e.nodes, e.right, e.of, e.guarantee});
  return table;
}

}  // namespace

std::string comparison_index(const std::vector<Comparison>& comparisons, const std::vector<MeshCard>& cards,
                             const std::vector<LabelerView>& views, const std::string& program) {
  SceneJson root = {{"schema", "toposcope.index/1"}, {"title", "Labelers side by side"}, {"program", program}};
  if (comparisons.size() == 1) root["title"] = "Labelers side by side · " + name_of(comparisons[0]);
  root["tables"] = {to_json(labelers_table(comparisons)), to_json(entries_table(comparisons))};
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
