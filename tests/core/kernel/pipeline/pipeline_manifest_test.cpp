// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/pipeline_manifest.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/errors.h"
#include "core/kernel/plugin/plugin_folder.h"
#include "plugin/option_check.h"
#include "support/plugins.h"

namespace toposcope {
namespace {

using test::PluginFolderFixture;
using ::testing::AllOf;
using ::testing::HasSubstr;

/// Manifests of every kind beside empty libraries: reading a pipeline loads nothing.
class Pipeline : public ::testing::Test {
 protected:
  Pipeline() {
    add("refine", PluginKind::filters, {{"max_edge", OptionType::real, "diagonals", "0.02", "0", "1", "longest edge"}});
    add("curvature", PluginKind::worksets, {{"rings", OptionType::integer, "", "2", "1", "8", "neighbourhood"}});
    add("circle", PluginKind::shapes,
        {{"method", OptionType::text, "", "robust", "", "", "how to fit", "robust|powell"},
         {"restarts", OptionType::integer, "", "3", "0", "", "how often"}});
    add("plane", PluginKind::shapes, {});
    add("parallel", PluginKind::relations, {{"tolerance", OptionType::real, "deg", "10", "0", "90", "largest angle"}});
    add("least-error", PluginKind::labelers, {{"order", OptionType::text, "", "", "", "", "has no default"}});
    add("exact", PluginKind::labelers, {{"nodes", OptionType::integer, "", "1000", "1", "", "node limit"}});
    folder.write("shapes/broken.plugin.json", "{");
  }

  void add(const std::string& id, PluginKind kind, const std::vector<OptionRow>& options) const {
    PluginManifest manifest = PluginFolderFixture::manifest(id);
    manifest.kind = kind;
    if (kind != PluginKind::shapes) manifest.dimension = -1;
    manifest.options = options;
    if (kind == PluginKind::relations) manifest.unit = "deg", manifest.min_arity = manifest.max_arity = 2;
    if (kind == PluginKind::worksets) manifest.provides = {{"convex", 0, "convex points"}};
    const std::string stem = std::string(to_string(kind)) + "/" + id;
    folder.write(stem + ".plugin.json", manifest_to_json(manifest));
    folder.write(stem + library_suffix(), "");
  }

  PluginCatalog catalog() const { return PluginCatalog({{folder.path, true}}); }

  PipelineManifest read(const std::string& text) const {
    folder.write("p.yaml", text);
    return read_pipeline(folder.path / "p.yaml", catalog());
  }
  std::string error_of(const std::string& text) const {
    try {
      read(text);
      return "";
    } catch (const UsageError& error) {
      return error.what();
    }
  }
  std::string at(int line, int column) const {
    return (folder.path / "p.yaml").string() + ":" + std::to_string(line) + ":" + std::to_string(column) + ": ";
  }
  std::string set_error(const std::string& setting) const {
    PipelineManifest pipeline = read(whole);
    try {
      apply_override(pipeline, setting, catalog());
      return "";
    } catch (const UsageError& error) {
      return error.what();
    }
  }

  static inline const std::string head = "schema: toposcope.pipeline/1\nname: test\n";
  static inline const std::string whole = head +
                                          "summary: A test\n"
                                          "filters: [{plugin: refine, max_edge: 0.5}, {plugin: refine}]\n"
                                          "worksets: {plugin: curvature, rings: 3}\n"
                                          "shapes: {circle: {method: powell}}\n"
                                          "relations: {parallel: {tolerance: 5}}\n"
                                          "labeler: {plugin: least-error, order: detectability}\n"
                                          "probability: {max_candidates: 7}\n";
  PluginFolderFixture folder;
};

TEST_F(Pipeline, ReadsEveryStation) {
  const PipelineManifest pipeline = read(whole);
  EXPECT_EQ(pipeline.name, "test");
  EXPECT_EQ(pipeline.summary, "A test");
  ASSERT_EQ(pipeline.filters.size(), 2);
  EXPECT_EQ(Options(pipeline.filters[0].options).real("max_edge"), 0.5);
  EXPECT_EQ(Options(pipeline.filters[1].options).real("max_edge"), 0.02);
  EXPECT_EQ(Options(pipeline.worksets[0].options).integer("rings"), 3);
  EXPECT_EQ(pipeline.labeler.plugin, "least-error");
  EXPECT_EQ(Options(pipeline.labeler.options).text("order"), "detectability");
  EXPECT_EQ(Options(pipeline.probability).integer("max_candidates"), 7);
  EXPECT_EQ(Options(pipeline.probability).real("fit_error_scale"), 0.82);
  const auto circle = plugin_options(pipeline, catalog(), PluginKind::shapes, "circle");
  EXPECT_EQ(Options(circle).text("method"), "powell");
  EXPECT_EQ(Options(circle).integer("restarts"), 3);
}

TEST_F(Pipeline, WhatMakesTheProbabilitiesIsAStationOfItsOwn) {
  EXPECT_FALSE(read(whole).marginals);
  PipelineManifest pipeline = read(whole + "marginals: {plugin: exact, nodes: 5}\n");
  ASSERT_TRUE(pipeline.marginals);
  EXPECT_EQ(pipeline.marginals->plugin, "exact");
  EXPECT_EQ(Options(pipeline.marginals->options).integer("nodes"), 5);
  EXPECT_EQ(pipeline.labeler.plugin, "least-error");
  apply_override(pipeline, "marginals.nodes=6", catalog());
  EXPECT_EQ(Options(pipeline.marginals->options).integer("nodes"), 6);
  set_labeler(pipeline, "exact", catalog());
  EXPECT_EQ(Options(pipeline.labeler.options).integer("nodes"), 1000);
  EXPECT_EQ(Options(pipeline.marginals->options).integer("nodes"), 6) << "another labeler changes the labelling alone";
  EXPECT_THAT(error_of(whole + "marginals: {plugin: exat}\n"), AllOf(HasSubstr(at(10, 21)), HasSubstr("'exact'?")));
  EXPECT_THAT(error_of(whole + "marginals: {plugin: circle}\n"), HasSubstr("'circle' is a shape"));
  EXPECT_THAT(error_of(whole + "marginals: {plugin: exact, nodes: 0}\n"), HasSubstr(at(10, 28)));
  EXPECT_THAT(error_of(whole + "marginals: {nodes: 5}\n"), HasSubstr("plugin"));
  EXPECT_THAT(set_error("marginals.nodes=6"), AllOf(HasSubstr("no station 'marginals'"), HasSubstr("posterior")));
  EXPECT_THAT(set_error("marginal.nodes=6"), HasSubstr("'marginals'?"));
}

TEST_F(Pipeline, ShapesAndRelationsNotNamedTakeTheirDefaults) {
  const PipelineManifest pipeline = read(head + "worksets: {plugin: curvature}\nlabeler: {plugin: exact}\n");
  EXPECT_TRUE(pipeline.filters.empty());
  EXPECT_EQ(Options(plugin_options(pipeline, catalog(), PluginKind::shapes, "circle")).text("method"), "robust");
  EXPECT_TRUE(plugin_options(pipeline, catalog(), PluginKind::shapes, "plane").empty());
  EXPECT_EQ(Options(plugin_options(pipeline, catalog(), PluginKind::relations, "parallel")).real("tolerance"), 10);
  EXPECT_THROW(plugin_options(pipeline, catalog(), PluginKind::shapes, "sphere"), UsageError);
}

TEST_F(Pipeline, ErrorsNameThePlaceAndTheNearestName) {
  const std::string tail = "labeler: {plugin: exact}\n";
  EXPECT_THAT(error_of(head + "worksets: {plugin: curvture}\n" + tail),
              AllOf(HasSubstr(at(3, 20)), HasSubstr("did you mean 'curvature'?")));
  EXPECT_THAT(error_of(head + "worksets: {plugin: curvature, ring: 3}\n" + tail),
              AllOf(HasSubstr(at(3, 31)), HasSubstr("no option 'ring'"), HasSubstr("'rings'?")));
  EXPECT_THAT(error_of(head + "worksets:\n  plugin: curvature\n  rings: 9\n" + tail),
              AllOf(HasSubstr(at(5, 3)), HasSubstr("'9'"), HasSubstr("from 1 to 8")));
  EXPECT_THAT(error_of(head + "worksets: {plugin: circle}\n" + tail), HasSubstr("'circle' is a shape"));
  EXPECT_THAT(error_of(head + "worksets: {plugin: curvature}\nlabeler: {plugin: least-error}\n"),
              AllOf(HasSubstr(at(4, 10)), HasSubstr("'order' is not given")));
  EXPECT_THAT(error_of(head + "worksets: {plugin: curvature}\nprobability: {max_candidates: 0}\n" + tail),
              AllOf(HasSubstr(at(4, 15)), HasSubstr("max_candidates")));
  EXPECT_THAT(error_of(head + "worksets: {plugin: curvature}\nshapes: {cirlce: {}}\n" + tail),
              AllOf(HasSubstr(at(4, 10)), HasSubstr("'circle'?")));
}

TEST_F(Pipeline, AllErrorsAreReportedAtOnce) {
  const std::string error = error_of(head +
                                     "worksets: {plugin: curvature, rings: 0}\n"
                                     "shapes: {circle: {method: simplex, restarts: x}}\n"
                                     "labeler: {plugin: exat}\n");
  EXPECT_THAT(error, AllOf(HasSubstr(at(3, 31)), HasSubstr(at(4, 19)), HasSubstr(at(4, 36)), HasSubstr(at(5, 19))));
}

TEST_F(Pipeline, FormErrors) {
  EXPECT_THAT(
      error_of("schema: toposcope.pipeline/2\nname: x\nworksets: {plugin: curvature}\nlabeler: {plugin: exact}"),
      HasSubstr(at(1, 9)));
  EXPECT_THAT(error_of(head + "labeler: {plugin: exact}\n"), HasSubstr("worksets"));
  EXPECT_THAT(error_of(whole + "lableer: {}\n"), AllOf(HasSubstr(at(10, 1)), HasSubstr("'labeler'?")));
  EXPECT_THAT(error_of(whole + "worksets: {plugin: curvature}\n"), HasSubstr("given twice"));
  EXPECT_THAT(error_of(head + "worksets: curvature\nlabeler: {plugin: exact}\n"), HasSubstr(at(3, 11)));
  EXPECT_THAT(error_of(head + "worksets: {plugin: curvature, rings: [2]}\nlabeler: {plugin: exact}\n"),
              HasSubstr(at(3, 38)));
  EXPECT_THAT(error_of("worksets: {"), HasSubstr("not YAML"));
  EXPECT_NE(error_of(""), "");
  EXPECT_THROW(read_pipeline(folder.path / "absent.yaml", catalog()), UsageError);
  EXPECT_THROW(read_pipeline(folder.path, catalog()), UsageError);
}

TEST_F(Pipeline, APluginWithAProblemIsNotABadPipeline) {
  EXPECT_THROW(read(whole + "# see below\n").shapes.at("broken"), std::out_of_range);
  EXPECT_THROW(read(head + "worksets: {plugin: curvature}\nlabeler: {plugin: exact}\nshapes: {broken: {}}\n"),
               PluginError);
}

TEST_F(Pipeline, OverridesOneValue) {
  PipelineManifest pipeline = read(whole);
  for (const char* setting : {"filters.refine.max_edge=0.25", "worksets.rings=4", "shapes.circle.restarts=9",
                              "relations.parallel.tolerance=1", "labeler.order=a=b", "probability.fit_error_scale=3"})
    apply_override(pipeline, setting, catalog());
  EXPECT_EQ(Options(pipeline.filters[0].options).real("max_edge"), 0.25);
  EXPECT_EQ(Options(pipeline.filters[1].options).real("max_edge"), 0.25);
  EXPECT_EQ(Options(pipeline.worksets[0].options).integer("rings"), 4);
  EXPECT_EQ(Options(pipeline.shapes["circle"]).integer("restarts"), 9);
  EXPECT_EQ(Options(pipeline.shapes["circle"]).text("method"), "powell") << "the others stay";
  EXPECT_EQ(Options(pipeline.relations["parallel"]).real("tolerance"), 1);
  EXPECT_EQ(Options(pipeline.labeler.options).text("order"), "a=b");
  EXPECT_EQ(Options(pipeline.probability).real("fit_error_scale"), 3);
  EXPECT_EQ(Options(pipeline.probability).integer("max_candidates"), 7);
}

TEST_F(Pipeline, OverridesAPluginThatThePipelineDoesNotName) {
  PipelineManifest pipeline = read(head + "worksets: {plugin: curvature}\nlabeler: {plugin: exact}\n");
  apply_override(pipeline, "shapes.circle.method=powell", catalog());
  EXPECT_EQ(Options(pipeline.shapes["circle"]).text("method"), "powell");
  EXPECT_EQ(Options(pipeline.shapes["circle"]).integer("restarts"), 3);
}

TEST_F(Pipeline, HasOneClassifierOrSeveral) {
  add("watershed", PluginKind::worksets, {{"depth", OptionType::real, "", "0.5", "0", "1", "least depth"}});
  const std::string tail = "labeler: {plugin: exact}\n";
  PipelineManifest pipeline =
      read(head + "worksets: [{plugin: curvature, rings: 4}, {plugin: watershed}, {plugin: curvature}]\n" + tail);
  ASSERT_EQ(pipeline.worksets.size(), 3);
  EXPECT_EQ(Options(pipeline.worksets[0].options).integer("rings"), 4);
  EXPECT_EQ(pipeline.worksets[1].plugin, "watershed");
  apply_override(pipeline, "worksets.curvature.rings=5", catalog());
  apply_override(pipeline, "worksets.watershed.depth=0.25", catalog());
  EXPECT_EQ(Options(pipeline.worksets[0].options).integer("rings"), 5) << "every one of that id";
  EXPECT_EQ(Options(pipeline.worksets[2].options).integer("rings"), 5);
  EXPECT_EQ(Options(pipeline.worksets[1].options).real("depth"), 0.25);
  const auto refusal = [&](const char* setting) -> std::string {
    try {
      apply_override(pipeline, setting, catalog());
    } catch (const UsageError& error) {
      return error.what();
    }
    return "none";
  };
  EXPECT_THAT(refusal("worksets.rings=3"),
              AllOf(HasSubstr("several classifiers"), HasSubstr("worksets.curvature.rings"),
                    HasSubstr("curvature, watershed")));
  EXPECT_THAT(refusal("worksets.watersheds.depth=1"), AllOf(HasSubstr("no classifier"), HasSubstr("'watershed'?")));
  PipelineManifest single = read(whole);
  apply_override(single, "worksets.curvature.rings=6", catalog());
  EXPECT_EQ(Options(single.worksets[0].options).integer("rings"), 6);
  EXPECT_THAT(error_of(head + "worksets: []\n" + tail), HasSubstr(at(3, 11)));
  EXPECT_THAT(error_of(head + "worksets: [{plugin: curvature}, {rings: 2}]\n" + tail),
              AllOf(HasSubstr(at(3, 33)), HasSubstr("plugin")));
  EXPECT_THAT(error_of(head + "worksets: [{plugin: curvature}, {plugin: curvature, rings: 9}]\n" + tail),
              AllOf(HasSubstr(at(3, 53)), HasSubstr("from 1 to 8")));
}

TEST_F(Pipeline, WrongOverrides) {
  EXPECT_THAT(set_error("worksets.rings"), HasSubstr("is no assignment"));
  EXPECT_THAT(set_error("rings=3"), HasSubstr("does not name station and option"));
  EXPECT_THAT(set_error("workset.rings=3"), AllOf(HasSubstr("no station 'workset'"), HasSubstr("'worksets'?")));
  EXPECT_THAT(set_error("shapes.method=powell"), HasSubstr("name one"));
  EXPECT_THAT(set_error("worksets.curvatur.rings=3"), AllOf(HasSubstr("no classifier"), HasSubstr("'curvature'?")));
  EXPECT_THAT(set_error("worksets.rings=99"), AllOf(HasSubstr("'99'"), HasSubstr("from 1 to 8")));
  EXPECT_THAT(set_error("worksets.=3"), HasSubstr("does not name"));
  EXPECT_THAT(set_error("shapes.cirlce.method=powell"), HasSubstr("'circle'?"));
  EXPECT_THAT(set_error("filters.smooth.x=1"), AllOf(HasSubstr("no filter 'smooth'"), HasSubstr("refine")));
  EXPECT_THAT(set_error("probability.max_candidate=1"), HasSubstr("'max_candidates'?"));
}

TEST_F(Pipeline, AnotherLabelerTakesItsDefaults) {
  PipelineManifest pipeline = read(whole);
  set_labeler(pipeline, "least-error", catalog());
  EXPECT_EQ(Options(pipeline.labeler.options).text("order"), "detectability") << "its own labeler keeps its options";
  set_labeler(pipeline, "exact", catalog());
  EXPECT_EQ(Options(pipeline.labeler.options).integer("nodes"), 1000);
  EXPECT_THROW(set_labeler(pipeline, "exatc", catalog()), UsageError);
}

TEST(ShippedPipelines, AreValidUnderTheBuiltPlugins) {
  int count = 0;
  for (const auto& entry :
       std::filesystem::directory_iterator(std::filesystem::path(TOPOSCOPE_SOURCE_DIR) / "pipelines")) {
    if (entry.path().extension() != ".yaml") continue;
    ++count;
    PipelineManifest pipeline;
    EXPECT_NO_THROW(pipeline = read_pipeline(entry.path(), test::host().catalog()));
    EXPECT_EQ(pipeline.name, entry.path().stem());
  }
  EXPECT_GE(count, 2);
}

}  // namespace
}  // namespace toposcope
