// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "base/errors.h"
#include "base/json_text.h"
#include "evaluation/evaluation.h"

namespace toposcope {
namespace {

using Json = nlohmann::ordered_json;

// What is no finite number is written as null.
Json as_json(const MeshEvaluation& mesh) {
  Json features = Json::object();
  for (const FeatureJudgement& judged : mesh.judgement.features)
    features[judged.feature] = {{"verdict", to_string(judged.verdict)},
                                {"distance", judged.distance},
                                {"distance_edges", judged.distance / mesh.judgement.mean_edge},
                                {"distance_diagonal", judged.distance / mesh.judgement.diagonal},
                                {"probability", judged.probability},
                                {"offered", judged.offered}};
  Json json = {{"name", mesh.name},   {"object", mesh.object},   {"variant", mesh.variant}, {"sha256", mesh.hash},
               {"faces", mesh.faces}, {"time_ms", mesh.time_ms}, {"features", features}};
  if (!mesh.error.empty()) json["error"] = mesh.error;
  if (mesh.class_known())
    json["class"] = {{"expected", mesh.expected_class},
                     {"found", mesh.found_class.empty() ? Json() : Json(mesh.found_class)},
                     {"probability", mesh.class_probability}};
  json["satisfied"] = mesh.satisfied;
  return json;
}

Json as_json(const Evaluation& evaluation) {
  const std::vector<const MeshEvaluation*> meshes = all_of(evaluation);
  Json features = Json::object();
  for (const FeatureSummary& s : summarize(meshes))
    features[s.name] = {{"right", s.right},           {"wrong", s.wrong},
                        {"missed", s.missed},         {"absent", s.absent},
                        {"spurious", s.spurious},     {"mean_distance", s.distance},
                        {"mean_edges", s.edges},      {"worst_edges", s.worst_edges},
                        {"mean_diagonal", s.diagonal}};
  const Reliability reliable = reliability(meshes);
  Json bins = Json::array();
  for (const ReliabilityBin& bin : reliable.bins)
    bins.push_back({{"count", bin.count}, {"right", bin.right}, {"mean_probability", bin.probability}});
  Json json = {{"dataset", evaluation.dataset},
               {"summary", evaluation.summary},
               {"model", evaluation.model},
               {"model_sha256", evaluation.model_hash},
               {"pipeline", evaluation.pipeline},
               {"judge", evaluation.by_class ? "class" : "features"},
               {"seconds", evaluation.seconds},
               {"features", features},
               {"confusion", confusion(meshes)},
               {"calibration", {{"expected_error", reliable.expected_calibration_error}, {"bins", bins}}},
               {"absent_files", evaluation.absent},
               {"meshes", Json::array()}};
  for (const MeshEvaluation& mesh : evaluation.meshes) json["meshes"].push_back(as_json(mesh));
  return json;
}

/// What was said of a feature or class, before and now.
using Verdicts = std::map<std::string, std::string>;

Verdicts verdicts_of(const nlohmann::json& mesh) {
  Verdicts verdicts;
  for (const auto& [name, feature] : mesh.at("features").items())
    verdicts[name] = feature.at("verdict").get<std::string>();
  if (mesh.contains("class")) {
    const auto& found = mesh["class"].at("found");
    verdicts["class"] = found.is_null() ? "unknown" : found.get<std::string>();
  }
  return verdicts;
}

const nlohmann::json* find_named(const nlohmann::json& list, const char* key, const std::string& name) {
  for (const auto& each : list)
    if (each.at(key) == name) return &each;
  return nullptr;
}

}  // namespace

std::string to_json(const std::vector<Evaluation>& evaluations) {
  Json root = {{"schema", "toposcope.evaluation/1"}, {"datasets", Json::array()}};
  for (const Evaluation& evaluation : evaluations) root["datasets"].push_back(as_json(evaluation));
  return root.dump(1) + "\n";
}

std::string to_csv(const std::vector<Evaluation>& evaluations) {
  const auto number = [](const char* name) { return Column(name, "number", "", "{:.8g}"); };
  Table table{.columns = {"dataset", "mesh", "object", "variant", "faces", "feature", "verdict", number("distance"),
                          number("distance_edges"), number("distance_diagonal"), number("probability"),
                          Column("time_ms", "ms", "ms", "{:.3f}")}};
  for (const Evaluation& evaluation : evaluations)
    for (const MeshEvaluation& mesh : evaluation.meshes) {
      const auto add = [&](const std::string& feature, std::string_view verdict, const std::vector<Cell>& numbers) {
        std::vector<Cell> row = {evaluation.dataset, mesh.name, mesh.object, mesh.variant,
                                 mesh.faces,         feature,   verdict};
        row.insert(row.end(), numbers.begin(), numbers.end());
        row.push_back(mesh.time_ms);
        table.rows.push_back(std::move(row));
      };
      for (const FeatureJudgement& f : mesh.judgement.features)
        add(f.feature, to_string(f.verdict),
            {f.distance, f.distance / mesh.judgement.mean_edge, f.distance / mesh.judgement.diagonal, f.probability});
      if (mesh.class_known())
        add("class " + mesh.expected_class, mesh.class_right() ? "right" : "wrong",
            {Cell(), Cell(), Cell(), mesh.class_probability});
    }
  return to_csv(table);
}

std::vector<Table> changes(const Evaluation& evaluation, const std::string& baseline_json, const std::string& file) {
  Table table{"Changed since " + file, {"mesh", "", "before", "now"}, {}, ""};
  try {
    const nlohmann::json root = parse_json<nlohmann::json>(baseline_json, file);
    if (root.value("schema", "") != "toposcope.evaluation/1")
      throw UsageError(file + ": is no evaluation; --baseline takes the evaluation.json of an earlier one");
    const nlohmann::json* before = find_named(root.at("datasets"), "dataset", evaluation.dataset);
    if (!before) {
      table.note = "no data set '" + evaluation.dataset + "' there";
      return {table};
    }
    std::size_t better = 0, worse = 0, unknown = 0, other = 0;
    const auto good = [](const std::string& verdict, const std::string& expected) {
      return verdict == "right" || verdict == "absent" || (!expected.empty() && verdict == expected);
    };
    for (const MeshEvaluation& mesh : evaluation.meshes) {
      const nlohmann::json* old = find_named(before->at("meshes"), "name", mesh.name);
      if (!old) {
        ++unknown;
        continue;
      }
      const auto* hash = old->at("sha256").get_ptr<const std::string*>();
      other += mesh.error.empty() && hash && !hash->empty() && *hash != mesh.hash;
      const Verdicts was = verdicts_of(*old), is = verdicts_of(nlohmann::json(as_json(mesh)));
      for (const auto& [name, verdict] : is) {
        const auto at = was.find(name);
        if (at == was.end() || at->second == verdict) continue;
        const std::string expected = name == "class" ? mesh.expected_class : "";
        better += good(verdict, expected) && !good(at->second, expected);
        worse += !good(verdict, expected) && good(at->second, expected);
        table.rows.push_back({mesh.name, name, at->second, verdict});
      }
    }
    const std::vector<FeatureSummary> summaries = summarize(all_of(evaluation));
    const auto& all = before->at("features").at("all");
    table.note = fmt::format(
        "{} better, {} worse; mean distance {:.3f} mean edges, was {:.3f}; calibration error {:.3f}, was {:.3f}",
        better, worse, summaries.back().edges, all.at("mean_edges").get<double>(),
        reliability(all_of(evaluation)).expected_calibration_error,
        before->at("calibration").at("expected_error").get<double>());
    if (unknown > 0) table.note += fmt::format("; {} meshes are new", unknown);
    if (other > 0) table.note += fmt::format("; {} meshes are not what they were then", other);
    if (before->at("model_sha256") != evaluation.model_hash) table.note += "; the model is not what it was then";
  } catch (const nlohmann::json::exception& error) {
    throw UsageError(file + ": is no evaluation (" + json_fault(error) +
                     "); --baseline takes the evaluation.json of an earlier one");
  }
  return {table};
}

}  // namespace toposcope
