// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <optional>
#include <set>
#include <vector>

#include "mesh/mesh.h"
#include "model/read_model.h"
#include "pipeline/construct_features.h"
#include "pipeline/pipeline_manifest.h"
#include "pipeline/second_look.h"
#include "support/meshes.h"
#include "support/plugins.h"
#include "support/program.h"

namespace toposcope::test {

inline constexpr const char* two_bars = R"(
schema: toposcope.model/1
name: bars
features:
  bar: {worksets: [convex], shape: lgrp1}
  rod: {worksets: [convex], shape: lgrp1}
relationships:
  r1: {features: [bar, rod], type: parallel}
)";

/// Rows of a flat grid of 20 x `rows` quads, one apart.
struct Rows {
  Rows(const char* text, int rows) : mesh(make_grid(20, rows, 20, rows), "grid") {
    const TemporaryFolder folder;  // tests run side by side
    const std::filesystem::path path = folder / "second_look.yaml";
    write_text(path, text);
    model = read_model(path, &host().catalog());
    const std::filesystem::path pipeline = std::filesystem::path(TOPOSCOPE_SOURCE_DIR) / "pipelines/default.yaml";
    stations = make_stations(host(), read_pipeline(pipeline, host().catalog()), model);
    sets.type_names = {"convex"};
  }

  void first_look() {
    sets = MeasuredWorkingSets(std::move(sets), {"convex"}, mesh.view(), context(2));
    features = construct_features(run(), sets);
  }

  ModelRun run() const { return {mesh.view(), model, stations, context(2)}; }

  void add_rows(double first, double last) {
    const double low = mesh.view().positions.front().y();
    for (Index v = 0; v < mesh.view().vertex_count(); ++v) {
      const double row = mesh.view().positions[v].y() - low;
      if (row > first - 0.5 && row < last + 0.5) sets.vertices.push_back(v);
    }
    sets.types.push_back(0);
    sets.saliency.push_back(1);
    sets.offsets.push_back(static_cast<Index>(sets.vertices.size()));
  }

  std::set<std::vector<Index>> groups_of(Index feature) const {
    std::set<std::vector<Index>> groups;
    for (Index c : features.of_feature[feature].constructed) groups.insert(features.all[c].sets);
    return groups;
  }

  /// The candidate of a feature that is made of these sets.
  Index candidate(Index feature, const std::vector<Index>& of_sets) const {
    for (Index c : features.of_feature[feature].constructed)
      if (features.all[c].sets == of_sets) return c;
    ADD_FAILURE() << "no such candidate";
    return 0;
  }

  bool look(std::vector<std::optional<Index>> labelled) {
    labelled.resize(model.features.size());
    return look_again(run(), sets, labelled, features);
  }

  Mesh mesh;
  Model model;
  Stations stations;
  MeasuredWorkingSets sets;  ///< measured by the first look
  ConstructedFeatures features;
};

}  // namespace toposcope::test
