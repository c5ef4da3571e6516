// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <initializer_list>
#include <limits>
#include <set>

#include "index/index_document.h"
#include "index/json_values.h"
#include "table/table_json.h"

namespace toposcope {
namespace {

constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

/// A number of the features that were found; nothing where none was.
Cell measured(const FeatureSummary& summary, double value) {
  return summary.measured > 0 ? Cell(value) : Cell();
}

Cell text_or_none(const std::string& text) {
  return text.empty() ? Cell() : Cell(text);
}

double median_ms(const Evaluation& evaluation) {
  std::vector<double> times;
  for (const MeshEvaluation& mesh : evaluation.meshes) times.push_back(mesh.time_ms);
  if (times.empty()) return no_number;
  std::nth_element(times.begin(), times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2), times.end());
  return times[times.size() / 2];
}

Table datasets_table(const std::vector<Evaluation>& evaluations) {
  Table table{.title = "Data sets", .id = "datasets"};
  table.columns = {"data set",
                   "model",
                   {"meshes", "number"},
                   {"wholly right", "number"},
                   {"meshes right", "percent"},
                   {"features right", "number"},
                   {"of", "number"},
                   {"part right", "percent"},
                   {"distance", "number", "mean edges"},
                   {"worst", "number", "mean edges"},
                   {"calibration error", "number"},
                   {"median", "ms", "ms"}};
  for (const Evaluation& evaluation : evaluations) {
    const auto meshes = all_of(evaluation);
    const FeatureSummary all = summarize(meshes).back();
    const auto right = static_cast<std::size_t>(std::count_if(
        meshes.begin(), meshes.end(), [&](const MeshEvaluation* mesh) { return evaluation.right(*mesh); }));
    const Reliability reliable = reliability(meshes);
    table.rows.push_back({evaluation.dataset, evaluation.model, meshes.size(), right, share(right, meshes.size()),
                          all.right + all.absent, all.all(), share(all.right + all.absent, all.all()),
                          measured(all, all.edges), measured(all, all.worst_edges),
                          reliable.count > 0 ? reliable.expected_calibration_error : no_number, median_ms(evaluation)});
  }
  return table;
}

/// Of a mesh: what is known of one of its features.
const FeatureJudgement* judged(const MeshEvaluation& mesh, const std::string& feature) {
  for (const FeatureJudgement& each : mesh.judgement.features)
    if (each.feature == feature) return &each;
  return nullptr;
}

std::string found_class(const MeshEvaluation& mesh) {
  return mesh.found_class.empty() ? "unknown" : mesh.found_class;
}

/// Cells of one mesh: the verdict of each feature; how far off they are and how sure the least sure is.
void add_features(const MeshEvaluation& mesh, const std::vector<std::string>& features, std::vector<Cell>& row) {
  double least = no_number;
  for (const std::string& feature : features) {
    const FeatureJudgement* each = judged(mesh, feature);
    row.push_back(each ? Cell(to_string(each->verdict)) : Cell());
    if (each && !(each->probability >= least)) least = each->probability;
  }
  if (features.empty()) return;
  const FeatureSummary all = summarize({&mesh}).back();
  row.push_back(measured(all, all.edges));
  row.push_back(least);
}

Table meshes_table(const Evaluation& evaluation, const std::vector<MeshCard>& cards) {
  Table table{.title = evaluation.dataset + ": meshes", .id = evaluation.dataset + "-meshes"};
  std::vector<std::string> features;
  for (const FeatureSummary& summary : summarize(all_of(evaluation))) features.push_back(summary.name);
  features.pop_back();  // "all"
  const bool classes = !confusion(all_of(evaluation)).empty();
  const auto add = [&](std::initializer_list<Column> more) {
    table.columns.insert(table.columns.end(), more.begin(), more.end());
  };
  add({"mesh", {"faces", "number"}});
  if (classes) add({"class", "taken for", {"probability", "percent"}});
  for (const std::string& feature : features) add({{feature, "verdict"}});
  if (!features.empty()) add({{"distance", "number", "mean edges"}, {"least probability", "percent"}});
  add({{"time", "ms", "ms"}, "error"});
  for (std::size_t m = 0; m < evaluation.meshes.size(); ++m) {
    const MeshEvaluation& mesh = evaluation.meshes[m];
    std::vector<Cell> row = {mesh.name, mesh.faces};
    if (classes) {
      row.push_back(text_or_none(mesh.expected_class));
      row.push_back(mesh.error.empty() ? Cell(found_class(mesh)) : Cell());
      row.push_back(mesh.class_probability);
    }
    add_features(mesh, features, row);
    row.push_back(mesh.error.empty() ? mesh.time_ms : no_number);
    row.push_back(text_or_none(mesh.error));
    table.rows.push_back(std::move(row));
    table.links.push_back(cards[m].report);
  }
  return table;
}

Table features_table(const Evaluation& evaluation) {
  Table table{.title = evaluation.dataset + ": features", .id = evaluation.dataset + "-features"};
  table.columns = {"feature",
                   {"right", "number"},
                   {"of", "number"},
                   {"part right", "percent"},
                   {"wrong", "number"},
                   {"missed", "number"},
                   {"spurious", "number"},
                   {"absent", "number"},
                   {"distance", "number", "mean edges"},
                   {"worst", "number", "mean edges"},
                   {"of the diagonal", "percent"}};
  for (const FeatureSummary& s : summarize(all_of(evaluation)))
    table.rows.push_back({s.name, s.right + s.absent, s.all(), share(s.right + s.absent, s.all()), s.wrong, s.missed,
                          s.spurious, s.absent, measured(s, s.edges), measured(s, s.worst_edges),
                          measured(s, s.diagonal)});
  return table;
}

SceneJson card_json(const Evaluation& evaluation, const MeshEvaluation& mesh, const MeshCard& card) {
  SceneJson verdicts = SceneJson::object();
  for (const FeatureJudgement& each : mesh.judgement.features) verdicts[each.feature] = to_string(each.verdict);
  if (mesh.class_known()) verdicts["class"] = mesh.class_right() ? "right" : "wrong";
  SceneJson probability = nullptr;
  if (evaluation.by_class) probability = finite(mesh.class_probability);
  return {{"name", mesh.name},
          {"dataset", evaluation.dataset},
          {"thumbnail", data_uri(card.thumbnail)},
          {"verdicts", std::move(verdicts)},
          {"report", text_or_null(card.report)},
          {"probability", std::move(probability)}};
}

SceneJson reliability_json(const std::string& name, const std::vector<const MeshEvaluation*>& meshes) {
  const Reliability all = reliability(meshes);
  if (all.count == 0) return nullptr;
  SceneJson bins = SceneJson::array();
  const auto width = 1 / static_cast<double>(all.bins.size());
  for (std::size_t b = 0; b < all.bins.size(); ++b)
    if (all.bins[b].count > 0)
      bins.push_back({{"from", width * static_cast<double>(b)},
                      {"to", width * static_cast<double>(b + 1)},
                      {"count", all.bins[b].count},
                      {"right", all.bins[b].right},
                      {"mean_probability", all.bins[b].probability}});
  return {{"name", name}, {"bins", std::move(bins)}, {"ece", all.expected_calibration_error}};
}

SceneJson confusion_json(const std::vector<const MeshEvaluation*>& meshes) {
  const auto counts = confusion(meshes);
  if (counts.empty()) return nullptr;
  std::vector<std::string> classes, answers;
  std::set<std::string> others;
  for (const auto& [expected, row] : counts) {
    classes.push_back(expected);
    for (const auto& [found, count] : row)
      if (!counts.contains(found)) others.insert(found);
  }
  answers = classes;
  answers.insert(answers.end(), others.begin(), others.end());
  SceneJson rows = SceneJson::array();
  for (const auto& [expected, row] : counts) {
    SceneJson cells = SceneJson::array();
    for (const std::string& answer : answers) cells.push_back(row.contains(answer) ? row.at(answer) : 0);
    rows.push_back(std::move(cells));
  }
  return {{"classes", classes}, {"answers", answers}, {"counts", std::move(rows)}};
}

}  // namespace

std::string evaluation_index(const std::vector<Evaluation>& evaluations,
                             const std::vector<std::vector<MeshCard>>& cards, const std::string& program) {
  SceneJson root = {{"schema", "toposcope.index/1"}, {"title", "Evaluation"}, {"program", program}};
  root["tables"] = SceneJson::array({to_json(datasets_table(evaluations))});
  root["meshes"] = SceneJson::array();
  root["reliability"] = SceneJson::array();
  std::vector<const MeshEvaluation*> all;
  for (std::size_t e = 0; e < evaluations.size(); ++e) {
    const auto meshes = all_of(evaluations[e]);
    all.insert(all.end(), meshes.begin(), meshes.end());
    if (summarize(meshes).back().all() > 0) root["tables"].push_back(to_json(features_table(evaluations[e])));
    root["tables"].push_back(to_json(meshes_table(evaluations[e], cards[e])));
    for (std::size_t m = 0; m < meshes.size(); ++m)
      root["meshes"].push_back(card_json(evaluations[e], *meshes[m], cards[e][m]));
    if (SceneJson curve = reliability_json(evaluations[e].dataset, meshes); !curve.is_null())
      root["reliability"].push_back(std::move(curve));
  }
  if (evaluations.size() == 1) root["title"] = "Evaluation · " + evaluations[0].dataset;
  if (evaluations.size() > 1)
    if (SceneJson curve = reliability_json("all", all); !curve.is_null())
      root["reliability"].push_back(std::move(curve));
  if (SceneJson matrix = confusion_json(all); !matrix.is_null()) root["confusion"] = std::move(matrix);
  return root.dump(-1, ' ', false, SceneJson::error_handler_t::replace) + "\n";
}

}  // namespace toposcope
