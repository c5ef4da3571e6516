// SPDX-License-Identifier: BSD-3-Clause
#include "result/preparation.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "result/repair_words.h"

namespace toposcope {
namespace {

using Json = nlohmann::ordered_json;

/// Standard deviation of the edges' lengths over their mean, about the mean: no cancellation.
double edge_variation(const MeshView& mesh) {
  double squares = 0;
  std::size_t edges = 0;
  for (Index v = 0; v < mesh.vertex_count(); ++v)
    for (Index w : mesh.one_ring(v)) {
      if (w < v) continue;
      const double deviation = (mesh.positions[w] - mesh.positions[v]).norm() / mesh.mean_edge - 1;
      squares += deviation * deviation;
      ++edges;
    }
  return std::sqrt(squares / static_cast<double>(edges));
}

Json json_of(const MeshSummary& summary) {
  return {{"vertices", summary.vertices},
          {"faces", summary.faces},
          {"components", summary.components},
          {"closed_components", summary.closed_components},
          {"holes", summary.holes},
          {"border_edges", summary.border_edges},
          {"euler", summary.euler},
          {"genus", summary.genus},
          {"closed", summary.border_edges == 0},
          {"mean_edge", summary.mean_edge},
          {"edge_variation", summary.edge_variation},
          {"box", {{"a", summary.box.a()}, {"b", summary.box.b()}, {"c", summary.box.c()}}}};
}

std::string box_in_words(const Box& box) {
  return fmt::format("{:.4g} x {:.4g} x {:.4g}", box.a(), box.b(), box.c());
}

}  // namespace

MeshSummary summary_of(const MeshView& mesh, const RepairReport& topology) {
  return {mesh.vertex_count(),
          mesh.face_count(),
          topology.components,
          topology.closed_components,
          topology.holes,
          topology.border_edges,
          topology.euler,
          topology.genus,
          mesh.mean_edge,
          edge_variation(mesh),
          mesh.box};
}

std::string to_text(const Preparation& preparation) {
  const MeshSummary& before = preparation.repaired;
  std::string text = fmt::format("{}: {} vertices, {} faces\n  {}\n", preparation.mesh_path, preparation.file_vertices,
                                 preparation.file_faces, repair_in_words(preparation.repair));
  for (const PluginUse& use : preparation.filters) {
    text += "  filter " + use.id + ":";
    for (const auto& [name, value] : use.options) text += " " + name + " " + value;
    text += "\n";
  }
  text += fmt::format("\n  {:<20}{:<30}{}\n", "", "repaired", preparation.prepared ? "prepared" : "");
  const auto row = [&](const char* name, const auto& value) {
    const auto after = preparation.prepared ? fmt::format("{}", value(*preparation.prepared)) : "";
    text += fmt::format("  {:<20}{:<30}{}\n", name, value(before), after);
  };
  row("vertices", [](const MeshSummary& m) { return m.vertices; });
  row("faces", [](const MeshSummary& m) { return m.faces; });
  row("components", [](const MeshSummary& m) { return m.components; });
  row("closed", [](const MeshSummary& m) {
    return m.border_edges == 0 ? std::string("yes") : fmt::format("{} of {}", m.closed_components, m.components);
  });
  row("holes", [](const MeshSummary& m) { return m.holes; });
  row("border edges", [](const MeshSummary& m) { return m.border_edges; });
  row("genus", [](const MeshSummary& m) { return m.genus; });
  row("mean edge", [](const MeshSummary& m) { return fmt::format("{:.4g}", m.mean_edge); });
  row("edge sd / mean", [](const MeshSummary& m) { return fmt::format("{:.3f}", m.edge_variation); });
  row("box", [](const MeshSummary& m) { return box_in_words(m.box); });
  if (!preparation.written.empty()) text += "\n  written: " + preparation.written + "\n";
  return text;
}

std::string to_json_line(const Preparation& preparation) {
  Json root;
  root["schema"] = "toposcope.preparation/1";
  root["mesh"] = preparation.mesh_path;
  root["file"] = {{"vertices", preparation.file_vertices}, {"faces", preparation.file_faces}};
  for (const RepairCount& each : repair_counts(preparation.repair)) root["repair"][each.name] = each.count;
  root["repaired"] = json_of(preparation.repaired);
  root["filters"] = Json::array();
  for (const PluginUse& use : preparation.filters) {
    Json options = Json::object();
    for (const auto& [name, value] : use.options) options[name] = value;
    root["filters"].push_back({{"id", use.id}, {"version", use.version}, {"options", options}});
  }
  root["prepared"] = preparation.prepared ? json_of(*preparation.prepared) : Json(nullptr);
  root["written"] = preparation.written.empty() ? Json(nullptr) : Json(preparation.written);
  return root.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace toposcope
