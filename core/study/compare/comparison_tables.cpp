// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "compare/comparison.h"
#include "table/table.h"

namespace toposcope {
namespace {

using Json = nlohmann::ordered_json;

std::string words(const std::vector<std::pair<std::string, Index>>& labeling) {
  std::string text;
  for (const auto& [feature, candidate] : labeling)
    text += fmt::format("{}{}={}", text.empty() ? "" : " ", feature, candidate == 0 ? "-" : std::to_string(candidate));
  return text;
}

Cell right_of(std::size_t right, std::size_t of) {
  return fmt::format("{}/{}", right, of);
}

/// A column of numbers that is so wide as text.
Column number(const char* name, std::size_t width, const char* format = "{:.3g}") {
  Column column(name, "number", "", format);
  column.width = width;
  return column;
}

Column labeler_column() {
  Column column("labeler");
  column.width = 8;
  return column;
}

// What is no finite number is written as null.
Json as_json(const Entry& entry) {
  Json labeling = Json::object();
  for (const auto& [feature, candidate] : entry.labeling) labeling[feature] = candidate == 0 ? Json() : Json(candidate);
  Json json = {{"labeler", entry.labeler},
               {"class", entry.class_name},
               {"labeling", labeling},
               {"cost", entry.cost},
               {"bound", entry.bound},
               {"gap", entry.gap()},
               {"proven", entry.proven},
               {"posterior", entry.posterior},
               {"time_ms", entry.time_ms},
               {"nodes", entry.nodes},
               {"right", entry.right ? Json(*entry.right) : Json()},
               {"of", entry.of ? Json(*entry.of) : Json()},
               {"guarantee", entry.guarantee}};
  if (!entry.error.empty()) json["error"] = entry.error;
  return json;
}

Json as_json(const Total& total) {
  return {{"labeler", total.labeler},
          {"meshes", total.meshes},
          {"proven", total.proven},
          {"unsound", total.unsound},
          {"mean_gap", total.mean_gap},
          {"worst_gap", total.worst_gap},
          {"mean_posterior", total.mean_posterior},
          {"median_ms", total.median_ms},
          {"worst_ms", total.worst_ms},
          {"nodes", total.nodes},
          {"right", total.of > 0 ? Json(total.right) : Json()},
          {"of", total.of > 0 ? Json(total.of) : Json()}};
}

/// Labelers that agree share a letter, the cheapest labelling first in the order met.
std::vector<char> letters(const Comparison& comparison) {
  std::vector<const Entry*> distinct;
  std::vector<char> result;
  for (const Entry& entry : comparison.entries) {
    std::size_t at = 0;
    while (at < distinct.size() &&
           (distinct[at]->labeling != entry.labeling || distinct[at]->class_name != entry.class_name))
      ++at;
    if (at == distinct.size()) distinct.push_back(&entry);
    result.push_back(at < 26 ? static_cast<char>('A' + at) : '?');
  }
  return result;
}

}  // namespace

std::string to_text(const Comparison& comparison) {
  Column letter_column("");
  letter_column.width = 1;
  Table table{.title = comparison.mesh,
              .columns = {labeler_column(), letter_column, number("cost", 10, "{:.2f}"), number("gap", 8),
                          number("posterior", 9), number("ms", 9, "{:.2f}"), number("nodes", 8), number("right", 5),
                          "guarantee"}};
  const std::vector<char> letter = letters(comparison);
  std::string legend;
  for (std::size_t i = 0; i < comparison.entries.size(); ++i) {
    const Entry& entry = comparison.entries[i];
    table.rows.push_back({entry.labeler, std::string(1, letter[i]), entry.cost,
                          entry.proven ? Cell(0.0) : Cell(entry.gap()), entry.posterior, entry.time_ms, entry.nodes,
                          entry.of ? right_of(*entry.right, *entry.of) : Cell(), entry.guarantee});
    if (std::find(letter.begin(), letter.begin() + static_cast<std::ptrdiff_t>(i), letter[i]) ==
        letter.begin() + static_cast<std::ptrdiff_t>(i))
      legend += fmt::format("  {}  {}: {}\n", letter[i], entry.class_name, words(entry.labeling));
  }
  return to_text(table) + legend + "\n";
}

std::string to_text(const std::vector<Total>& totals) {
  if (totals.empty()) return "";
  Table table{.title = fmt::format("all {} meshes", totals[0].meshes),
              .columns = {labeler_column(), number("optimal", 7), number("unsound", 7), number("mean gap", 8),
                          number("worst", 8), number("posterior", 9, "{:.3f}"), number("median ms", 9, "{:.2f}"),
                          number("worst ms", 9, "{:.2f}"), number("nodes", 9), number("right", 8)}};
  for (const Total& total : totals)
    table.rows.push_back({total.labeler, total.proven, total.unsound, total.mean_gap, total.worst_gap,
                          total.mean_posterior, total.median_ms, total.worst_ms, total.nodes,
                          total.of > 0 ? right_of(total.right, total.of) : Cell()});
  return to_text(table);
}

std::string to_markdown(const std::vector<Total>& totals) {
  Table table{.columns = {"labeler", "optimal", number("unsound", 0), number("mean gap", 0), number("worst gap", 0),
                          number("posterior", 0, "{:.3f}"), number("median ms", 0, "{:.2f}"),
                          number("worst ms", 0, "{:.2f}"), number("nodes", 0), "right"}};
  for (const Total& total : totals)
    table.rows.push_back({"`" + total.labeler + "`", fmt::format("{} of {}", total.proven, total.meshes), total.unsound,
                          total.mean_gap, total.worst_gap, total.mean_posterior, total.median_ms, total.worst_ms,
                          total.nodes, total.of > 0 ? Cell(fmt::format("{} of {}", total.right, total.of)) : Cell()});
  return to_markdown(table);
}

std::string to_json(const std::vector<Comparison>& comparisons) {
  Json root = {{"schema", "toposcope.comparison/1"}, {"meshes", Json::array()}, {"totals", Json::array()}};
  for (const Comparison& comparison : comparisons) {
    Json entries = Json::array();
    for (const Entry& entry : comparison.entries) entries.push_back(as_json(entry));
    root["meshes"].push_back({{"mesh", comparison.mesh}, {"labelers", entries}});
  }
  for (const Total& total : totals(comparisons)) root["totals"].push_back(as_json(total));
  return root.dump() + "\n";
}

std::string to_csv(const std::vector<Comparison>& comparisons) {
  const Cell none;
  Table table{.columns = {"mesh", "labeler", "class", "labeling", number("cost", 0, "{:.10g}"),
                          number("gap", 0, "{:.10g}"), "proven", number("posterior", 0, "{:.10g}"),
                          number("time_ms", 0, "{:.4f}"), number("nodes", 0), number("right", 0), number("of", 0),
                          "guarantee"}};
  for (const Comparison& comparison : comparisons)
    for (const Entry& entry : comparison.entries)
      table.rows.push_back({comparison.mesh, entry.labeler, entry.class_name, words(entry.labeling), entry.cost,
                            entry.proven ? Cell(0.0) : Cell(entry.gap()), entry.proven ? "yes" : "no", entry.posterior,
                            entry.time_ms, entry.nodes, entry.right, entry.of, entry.guarantee});
  for (const Total& total : totals(comparisons))
    table.rows.push_back({"", total.labeler, "", "", none, total.mean_gap,
                          fmt::format("{} of {}", total.proven, total.meshes), total.mean_posterior, total.median_ms,
                          total.nodes, total.of > 0 ? Cell(total.right) : none, total.of > 0 ? Cell(total.of) : none,
                          "mean gap and posterior, median time, sums of nodes and right"});
  return to_csv(table);
}

}  // namespace toposcope
