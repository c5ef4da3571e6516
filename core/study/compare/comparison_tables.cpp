// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "base/csv.h"
#include "compare/comparison.h"

namespace toposcope {
namespace {

using Json = nlohmann::ordered_json;

std::string number(double value, const char* format) {
  return std::isfinite(value) ? fmt::format(fmt::runtime(format), value) : "-";
}

std::string words(const std::vector<std::pair<std::string, Index>>& labelling) {
  std::string text;
  for (const auto& [feature, candidate] : labelling)
    text += fmt::format("{}{}={}", text.empty() ? "" : " ", feature, candidate == 0 ? "-" : std::to_string(candidate));
  return text;
}

std::string right_of(const Entry& entry) {
  return entry.of ? fmt::format("{}/{}", *entry.right, *entry.of) : "-";
}

std::string gap_of(const Entry& entry) {
  return entry.proven ? "0" : number(entry.gap(), "{:.3g}");
}

// What is no finite number is written as null.
Json as_json(const Entry& entry) {
  Json labelling = Json::object();
  for (const auto& [feature, candidate] : entry.labelling)
    labelling[feature] = candidate == 0 ? Json() : Json(candidate);
  return {{"labeler", entry.labeler},
          {"class", entry.class_name},
          {"labelling", labelling},
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
           (distinct[at]->labelling != entry.labelling || distinct[at]->class_name != entry.class_name))
      ++at;
    if (at == distinct.size()) distinct.push_back(&entry);
    result.push_back(at < 26 ? static_cast<char>('A' + at) : '?');
  }
  return result;
}

std::size_t name_width(const std::vector<std::string>& names) {
  std::size_t width = 8;
  for (const std::string& name : names) width = std::max(width, name.size());
  return width + 2;
}

}  // namespace

std::string to_text(const Comparison& comparison) {
  std::vector<std::string> names;
  for (const Entry& entry : comparison.entries) names.push_back(entry.labeler);
  const std::size_t width = name_width(names);
  std::string text = fmt::format("{}\n  {:<{}}{:<3}{:>10} {:>9} {:>10} {:>10} {:>9} {:>6}  {}\n", comparison.mesh,
                                 "labeler", width, "", "cost", "gap", "posterior", "ms", "nodes", "right", "guarantee");
  const std::vector<char> letter = letters(comparison);
  std::string legend;
  for (std::size_t i = 0; i < comparison.entries.size(); ++i) {
    const Entry& entry = comparison.entries[i];
    text += fmt::format("  {:<{}}{:<3}{:>10} {:>9} {:>10} {:>10.2f} {:>9} {:>6}  {}\n", entry.labeler, width, letter[i],
                        number(entry.cost, "{:.2f}"), gap_of(entry), number(entry.posterior, "{:.3g}"), entry.time_ms,
                        entry.nodes, right_of(entry), entry.guarantee);
    if (std::find(letter.begin(), letter.begin() + static_cast<std::ptrdiff_t>(i), letter[i]) ==
        letter.begin() + static_cast<std::ptrdiff_t>(i))
      legend += fmt::format("  {}  {}: {}\n", letter[i], entry.class_name, words(entry.labelling));
  }
  return text + legend + "\n";
}

std::string to_text(const std::vector<Total>& totals) {
  if (totals.empty()) return "";
  std::vector<std::string> names;
  for (const Total& total : totals) names.push_back(total.labeler);
  const std::size_t width = name_width(names);
  std::string text = fmt::format("all {} meshes\n  {:<{}}{:>7} {:>8} {:>9} {:>9} {:>10} {:>10} {:>10} {:>10} {:>9}\n",
                                 totals[0].meshes, "labeler", width, "optimal", "unsound", "mean gap", "worst",
                                 "posterior", "median ms", "worst ms", "nodes", "right");
  for (const Total& total : totals)
    text += fmt::format("  {:<{}}{:>7} {:>8} {:>9} {:>9} {:>10} {:>10.2f} {:>10.2f} {:>10} {:>9}\n", total.labeler,
                        width, total.proven, total.unsound, number(total.mean_gap, "{:.3g}"),
                        number(total.worst_gap, "{:.3g}"), number(total.mean_posterior, "{:.3f}"), total.median_ms,
                        total.worst_ms, total.nodes, total.of > 0 ? fmt::format("{}/{}", total.right, total.of) : "-");
  return text;
}

std::string to_markdown(const std::vector<Total>& totals) {
  std::string text =
      "| labeler | optimal | unsound | mean gap | worst gap | posterior | median ms | worst ms | nodes | right |\n"
      "|---|---|---|---|---|---|---|---|---|---|\n";
  for (const Total& total : totals)
    text +=
        fmt::format("| `{}` | {} of {} | {} | {} | {} | {} | {:.2f} | {:.2f} | {} | {} |\n", total.labeler,
                    total.proven, total.meshes, total.unsound, number(total.mean_gap, "{:.3g}"),
                    number(total.worst_gap, "{:.3g}"), number(total.mean_posterior, "{:.3f}"), total.median_ms,
                    total.worst_ms, total.nodes, total.of > 0 ? fmt::format("{} of {}", total.right, total.of) : "-");
  return text;
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
  const auto plain = [](double value) { return std::isfinite(value) ? fmt::format("{:.10g}", value) : std::string(); };
  std::string text = "mesh,labeler,class,labelling,cost,gap,proven,posterior,time_ms,nodes,right,of,guarantee\n";
  for (const Comparison& comparison : comparisons)
    for (const Entry& entry : comparison.entries)
      text += fmt::format("{},{},{},{},{},{},{},{},{:.4f},{},{},{},{}\n", csv_field(comparison.mesh),
                          csv_field(entry.labeler), csv_field(entry.class_name), csv_field(words(entry.labelling)),
                          plain(entry.cost), entry.proven ? "0" : plain(entry.gap()), entry.proven ? "yes" : "no",
                          plain(entry.posterior), entry.time_ms, entry.nodes,
                          entry.right ? std::to_string(*entry.right) : "", entry.of ? std::to_string(*entry.of) : "",
                          csv_field(entry.guarantee));
  for (const Total& total : totals(comparisons))
    text += fmt::format(",{},,,,{},{} of {},{},{:.4f},{},{},{},{}\n", csv_field(total.labeler), plain(total.mean_gap),
                        total.proven, total.meshes, plain(total.mean_posterior), total.median_ms, total.nodes,
                        total.of > 0 ? std::to_string(total.right) : "", total.of > 0 ? std::to_string(total.of) : "",
                        csv_field("mean gap and posterior, median time, sums of nodes and right"));
  return text;
}

}  // namespace toposcope
