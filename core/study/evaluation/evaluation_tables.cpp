// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "evaluation/evaluation.h"

namespace toposcope {
namespace {

/// More meshes than this are told in sums.
constexpr std::size_t most_rows = 60;

/// In the order in which they are met.
template <class Key>
std::vector<std::string> distinct(const std::vector<const MeshEvaluation*>& meshes, Key key) {
  std::vector<std::string> values;
  for (const MeshEvaluation* mesh : meshes)
    if (std::find(values.begin(), values.end(), key(*mesh)) == values.end()) values.push_back(key(*mesh));
  return values;
}

std::string percent(std::size_t part, std::size_t all) {
  return all == 0 ? "-" : fmt::format("{:.1f} %", 100.0 * static_cast<double>(part) / static_cast<double>(all));
}

std::string word(const FeatureJudgement& judged, const Judgement& scale) {
  if (judged.verdict == Verdict::right) return fmt::format("{:.2f}", judged.distance / scale.mean_edge);
  if (judged.verdict == Verdict::wrong) return fmt::format("wrong {:.1f}", judged.distance / scale.mean_edge);
  if (judged.verdict == Verdict::absent) return "none";
  return std::string(to_string(judged.verdict));
}

/// Distances of the meshes of one object and variant for one feature.
std::string cell(const std::vector<const MeshEvaluation*>& meshes, const std::string& feature) {
  if (meshes.empty()) return "";
  if (meshes.size() == 1) {
    for (const FeatureJudgement& judged : meshes[0]->judgement.features)
      if (judged.feature == feature) return word(judged, meshes[0]->judgement);
    return "";
  }
  for (const FeatureSummary& summary : summarize(meshes))
    if (summary.name == feature)
      return fmt::format("{:.2f} ({} of {})", summary.edges, summary.right + summary.absent, summary.all());
  return "";
}

std::vector<const MeshEvaluation*> select(const std::vector<const MeshEvaluation*>& meshes, const std::string& object,
                                          const std::string& variant) {
  std::vector<const MeshEvaluation*> selected;
  for (const MeshEvaluation* mesh : meshes)
    if (mesh->object == object && mesh->variant == variant) selected.push_back(mesh);
  return selected;
}

/// The shape of the dissertation's Table 6.1: per object its features, a column per resolution.
Table distance_table(const std::vector<const MeshEvaluation*>& meshes) {
  Table table{"Mean distance from the marks to the labelled shape, in mean edges", {"object", "feature"}, {}, ""};
  const auto objects = distinct(meshes, [](const MeshEvaluation& m) { return m.object; });
  const auto variants = distinct(meshes, [](const MeshEvaluation& m) { return m.variant; });
  for (const std::string& variant : variants) table.columns.push_back(variant.empty() ? "distance" : variant);
  const std::vector<FeatureSummary> features = summarize(meshes);
  for (const std::string& object : objects)
    for (std::size_t f = 0; f + 1 < features.size(); ++f) {
      std::vector<Cell> row = {f == 0 ? object : "", features[f].name};
      bool any = false;
      for (const std::string& variant : variants) {
        const std::string distance = cell(select(meshes, object, variant), features[f].name);
        any = any || !distance.empty();
        row.push_back(distance);
      }
      if (any) table.rows.push_back(std::move(row));
    }
  table.note =
      "wrong: labelled too far away; missed: not labelled; none: absent, and so reported; spurious: labelled though "
      "absent.";
  return table;
}

/// The shape of Table 6.3: which relationships hold, and the class.
Table class_table(const std::vector<const MeshEvaluation*>& meshes) {
  Table table{"Relationships satisfied, and classification", {"mesh"}, {}, ""};
  std::set<std::string> satisfied;
  for (const MeshEvaluation* mesh : meshes) satisfied.insert(mesh->satisfied.begin(), mesh->satisfied.end());
  std::vector<std::string> names(satisfied.begin(), satisfied.end());
  std::sort(names.begin(), names.end(), [](const std::string& a, const std::string& b) {
    return a.size() != b.size() ? a.size() < b.size() : a < b;
  });
  table.columns.insert(table.columns.end(), names.begin(), names.end());
  table.columns.insert(table.columns.end(), {"class", "probability", ""});
  for (const MeshEvaluation* mesh : meshes) {
    std::vector<Cell> row = {mesh->name};
    for (const std::string& name : names)
      row.push_back(std::find(mesh->satisfied.begin(), mesh->satisfied.end(), name) != mesh->satisfied.end() ? "•"
                                                                                                             : "");
    row.push_back(mesh->found_class.empty() ? "unknown" : mesh->found_class);
    row.push_back(fmt::format("{:.3f}", mesh->class_probability));
    row.push_back(!mesh->class_known() || mesh->class_right() ? "" : "is " + mesh->expected_class);
    table.rows.push_back(std::move(row));
  }
  return table;
}

Table confusion_table(const std::vector<const MeshEvaluation*>& meshes) {
  Table table{"Confusion: what it is, and what it was taken for", {"class"}, {}, ""};
  const auto counts = confusion(meshes);
  std::set<std::string> found;
  for (const auto& [expected, row] : counts)
    for (const auto& [name, n] : row) found.insert(name);
  table.columns.insert(table.columns.end(), found.begin(), found.end());
  table.columns.push_back("right");
  for (const auto& [expected, row] : counts) {
    std::vector<Cell> cells = {expected};
    std::size_t all = 0;
    for (const std::string& name : found) {
      const auto at = row.find(name);
      cells.push_back(at == row.end() ? "" : std::to_string(at->second));
      all += at == row.end() ? 0 : at->second;
    }
    const auto at = row.find(expected);
    cells.push_back(percent(at == row.end() ? 0 : at->second, all));
    table.rows.push_back(std::move(cells));
  }
  return table;
}

Table feature_table(const std::vector<const MeshEvaluation*>& meshes) {
  Table table{"Features",
              {"feature", "right", "of", "", "wrong", "missed", "spurious", "absent", "distance", "mean edges", "worst",
               "% of diagonal"},
              {},
              ""};
  for (const FeatureSummary& s : summarize(meshes))
    table.rows.push_back({s.name, std::to_string(s.right + s.absent), std::to_string(s.all()),
                          percent(s.right + s.absent, s.all()), std::to_string(s.wrong), std::to_string(s.missed),
                          std::to_string(s.spurious), std::to_string(s.absent), fmt::format("{:.4g}", s.distance),
                          fmt::format("{:.2f}", s.edges), fmt::format("{:.2f}", s.worst_edges),
                          fmt::format("{:.2f}", 100 * s.diagonal)});
  table.note =
      "Distances: mean over the features found, in the meshes' own unit, in mean edges, in parts of the diagonal.";
  return table;
}

Table reliability_table(const std::vector<const MeshEvaluation*>& meshes) {
  const Reliability all = reliability(meshes);
  Table table{"Probabilities", {"reported", "count", "mean", "right", ""}, {}, ""};
  for (std::size_t b = 0; b < all.bins.size(); ++b) {
    const ReliabilityBin& bin = all.bins[b];
    if (bin.count == 0) continue;
    const double right = static_cast<double>(bin.right) / static_cast<double>(bin.count);
    table.rows.push_back(
        {fmt::format("{:.1f} to {:.1f}", 0.1 * static_cast<double>(b), 0.1 * static_cast<double>(b + 1)),
         std::to_string(bin.count), fmt::format("{:.3f}", bin.probability), fmt::format("{:.3f}", right),
         std::string(static_cast<std::size_t>(std::lround(20 * right)), '#')});
  }
  table.note = fmt::format("Expected calibration error {:.3f} over {} probabilities.", all.expected_calibration_error,
                           all.count);
  return table;
}

std::string failure(const MeshEvaluation& mesh) {
  if (!mesh.error.empty()) return mesh.error;
  std::string text;
  const auto add = [&](const std::string& part) { text += (text.empty() ? "" : ", ") + part; };
  if (mesh.class_known() && !mesh.class_right())
    add(fmt::format("class {} ({:.2f})", mesh.found_class.empty() ? "unknown" : mesh.found_class,
                    mesh.class_probability));
  for (const FeatureJudgement& judged : mesh.judgement.features)
    if (!is_right(judged.verdict))
      add(fmt::format("{} {} ({:.2f}{})", judged.feature, word(judged, mesh.judgement), judged.probability,
                      judged.offered > 1 ? ", not offered" : ""));
  return text;
}

Table failure_table(const Evaluation& evaluation) {
  Table table{"What is not right, with its probability; not offered: no candidate was right", {"mesh", ""}, {}, ""};
  std::size_t more = 0;
  for (const MeshEvaluation& mesh : evaluation.meshes) {
    if (evaluation.right(mesh)) continue;
    if (table.rows.size() < most_rows)
      table.rows.push_back({mesh.name, failure(mesh)});
    else
      ++more;
  }
  if (more > 0) table.note = fmt::format("... and {} more.", more);
  return table;
}

}  // namespace

std::string headline(const Evaluation& evaluation) {
  std::size_t right = 0;
  std::vector<double> times;
  for (const MeshEvaluation& mesh : evaluation.meshes) {
    right += evaluation.right(mesh);
    times.push_back(mesh.time_ms);
  }
  const std::vector<const MeshEvaluation*> meshes = all_of(evaluation);
  std::string text = fmt::format("{}: ", evaluation.dataset);
  if (meshes.empty()) return text + "no meshes";
  const FeatureSummary all = summarize(meshes).back();
  if (evaluation.by_class)
    text += fmt::format("{} of {} classified right ({})", right, meshes.size(), percent(right, meshes.size()));
  else
    text += fmt::format(
        "{} of {} features right ({}), {} of {} meshes wholly; mean distance {:.2f} mean edges, worst {:.2f}",
        all.right + all.absent, all.all(), percent(all.right + all.absent, all.all()), right, meshes.size(), all.edges,
        all.worst_edges);
  std::sort(times.begin(), times.end());
  return text + fmt::format("; calibration error {:.3f}; median {:.0f} ms, worst {:.0f} ms a mesh, {:.0f} s in all",
                            reliability(meshes).expected_calibration_error, times[times.size() / 2], times.back(),
                            evaluation.seconds);
}

std::vector<Table> tables(const Evaluation& evaluation) {
  const std::vector<const MeshEvaluation*> meshes = all_of(evaluation);
  std::vector<Table> all;
  if (meshes.empty()) return all;
  const bool features = summarize(meshes).back().all() > 0;
  const bool classes = !confusion(meshes).empty();
  if (features) all.push_back(distance_table(meshes));
  if (classes && meshes.size() <= most_rows) all.push_back(class_table(meshes));
  if (classes) all.push_back(confusion_table(meshes));
  if (features) all.push_back(feature_table(meshes));
  if (reliability(meshes).count > 0) all.push_back(reliability_table(meshes));
  if (Table failures = failure_table(evaluation); !failures.rows.empty()) all.push_back(std::move(failures));
  return all;
}

}  // namespace toposcope
