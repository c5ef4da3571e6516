// SPDX-License-Identifier: BSD-3-Clause
#include "model/show_model.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "core/kernel/plugin/plugin_folder.h"
#include "model/read_model.h"

namespace toposcope {
namespace {

using ::testing::HasSubstr;

const std::string nasty = R"yaml(schema: toposcope.model/1
name: cup
summary: 'says "hello" \N and \ ends with \'
citation: "two\nlines <b>&amp;</b>"
objects: {cup: volume, wall: surface, rim: line, tip: point}
topology: {cup: [wall], wall: [rim], rim: [tip]}
associations:
  - {from: rim, adjacent-to: wall, up: tip}
features:
  top: {realises: rim, worksets: [convex, concave], shape: lgrp2, ranges: {length: 0 < l < bb(O).a},
        max_fit_error: bb(O).a/9, detectability: 0.5}
  side: {realises: wall, worksets: [planar], shape: {plugin: plane, note: 'a "quoted" \ word'}}
  base: {realises: cup, worksets: [planar], shape: plane}
relationships:
  r1: {features: [top, side], type: parallel}
  r2: {features: [top, side, base], type: spread, max: bb(O).c/4, tolerance: 20}
classes:
  plain: [r1]
)yaml";

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

TEST(ShowModel, TextTellsEveryLinkWithItsInverse) {
  const std::string text = model_as_text(model_from_text(nasty, "m.yaml", nullptr));
  for (const char* line :
       {"Abstract model, root cup\n", "  cup   volume   bounded-by wall\n",
        "  wall  surface  boundary-of cup\n                 bounded-by rim\n", "                 adjacent-to rim\n",
        "                 up tip\n", "                 down rim\n",
        "  top   line-group (segments 2) on convex + concave, detectability 0.5, realises rim\n"
        "        0 < length < bb(O).a\n        fit error < bb(O).a/9\n",
        "  r2  spread(top, side, base): max bb(O).c/4, tolerance 20\n", "  plain  r1\n"})
    EXPECT_THAT(text, HasSubstr(line));
}

TEST(ShowModel, DotDrawsEveryNetworkFeatureAndRelationship) {
  const std::string dot = model_as_dot(model_from_text(nasty, "m.yaml", nullptr));
  for (const char* cluster : {"cluster_topology", "cluster_parts", "cluster_associations", "cluster_working"})
    EXPECT_EQ(count(dot, cluster), 1u) << cluster;
  EXPECT_EQ(count(dot, "topology_0 -> topology_1"), 1u);
  EXPECT_EQ(count(dot, "topology_2 -> feature_0"), 1u) << "a feature is drawn at the object that it realises";
  EXPECT_EQ(count(dot, "-> feature_"), 3u);
  EXPECT_EQ(count(dot, "-> relationship_0"), 2u);
  EXPECT_EQ(count(dot, "-> relationship_1"), 3u) << "over three features";
  EXPECT_EQ(count(dot, "{"), count(dot, "}"));
  EXPECT_THAT(dot, HasSubstr(R"(says \"hello\" \\N and \\ ends with \\\ntwo\nlines)")) << "escaped";
}

TEST(ShowModel, GraphvizReadsIt) {
  if (std::system("dot -V >/dev/null 2>&1") != 0) GTEST_SKIP() << "Graphviz (dot) is not installed";
  const test::PluginFolderFixture folder;
  const auto models = std::filesystem::path(TOPOSCOPE_SOURCE_DIR) / "models";
  std::vector<std::string> graphs = {model_as_dot(model_from_text(nasty, "m.yaml", nullptr))};
  for (const char* name : {"cup", "airplane", "pipe-fitting", "left-lung", "neal-1999/pipe-fitting"})
    graphs.push_back(model_as_dot(read_model(models / (std::string(name) + ".yaml"), nullptr)));
  for (const std::string& graph : graphs) {
    folder.write("model.dot", graph);
    const std::string file = (folder.path / "model").string();
    // dot warns on standard error of what it had to guess.
    ASSERT_EQ(std::system(("dot -Tsvg " + file + ".dot -o " + file + ".svg 2>" + file + ".err").c_str()), 0) << graph;
    EXPECT_EQ(std::filesystem::file_size(file + ".err"), 0u) << graph;
    EXPECT_GT(std::filesystem::file_size(file + ".svg"), 1000u);
  }
}

}  // namespace
}  // namespace toposcope
