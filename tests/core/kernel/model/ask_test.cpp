// SPDX-License-Identifier: BSD-3-Clause
#include "model/ask.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "base/errors.h"
#include "model/read_model.h"
#include "model/show_model.h"
#include "support/schemas.h"

namespace toposcope {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::UnorderedElementsAre;

const Model& lung() {
  static const Model model = read_model(std::filesystem::path(TOPOSCOPE_SOURCE_DIR) / "models/left-lung.yaml", nullptr);
  return model;
}

AbstractAnswer asked(const std::string& question) {
  return answer(read_query(question, lung()), lung());
}

/// What was found, without the name of the lung.
std::vector<std::string> found(const std::string& question) {
  std::vector<std::string> names;
  for (const AbstractAnswer::Found& each : asked(question).found) {
    std::string name = lung().abstract.objects[each.consequence.object].name;
    if (const std::size_t end = name.rfind("-of-left-lung"); end != std::string::npos) name.resize(end);
    names.push_back(name);
  }
  return names;
}

std::string refused(const std::string& question, const Model& model = lung()) {
  try {
    read_query(question, model);
  } catch (const UsageError& error) {
    return error.what();
  }
  return "none";
}

// ---- ten questions about the left lung, and what an anatomist would answer ----

TEST(AskTheLeftLung, WhatBoundsTheUpperLobe) {
  EXPECT_THAT(found("what bounds the upper lobe?"),
              UnorderedElementsAre("costal-surface-of-upper-lobe", "mediastinal-surface-of-upper-lobe",
                                   "interlobar-surface-of-upper-lobe", "oblique-fissure", "anterior-border",
                                   "cardiac-notch", "apex"));
}
TEST(AskTheLeftLung, WhichSurfacesBoundTheLowerLobe) {
  EXPECT_THAT(found("which surfaces bound the lower lobe?"),
              UnorderedElementsAre("costal-surface-of-lower-lobe", "mediastinal-surface-of-lower-lobe",
                                   "diaphragmatic-surface-of-lower-lobe", "interlobar-surface-of-lower-lobe"));
}
TEST(AskTheLeftLung, WhatAreThePartsOfTheLeftLung) {
  EXPECT_THAT(found("what are the parts of the left lung?"),
              UnorderedElementsAre("upper-lobe", "lower-lobe", "lingula"));
}
TEST(AskTheLeftLung, WhatIsTheHilumPartOf) {
  EXPECT_THAT(found("what is the hilum part of?"), ElementsAre("mediastinal-surface", "surface"));
}
TEST(AskTheLeftLung, WhatIsTheUpperLobeAdjacentTo) {
  EXPECT_THAT(found("what is the upper lobe adjacent to?"), ElementsAre("lower-lobe"));
  EXPECT_THAT(found("what is adjacent to the costal surface of the upper lobe?"),
              UnorderedElementsAre("costal-surface-of-lower-lobe", "interlobar-surface-of-upper-lobe",
                                   "interlobar-surface-of-lower-lobe", "mediastinal-surface"))
      << "they have the fissure, or the anterior border, in common";
}
TEST(AskTheLeftLung, WhatLiesAboveTheDiaphragmaticSurface) {
  EXPECT_THAT(found("what is above the diaphragmatic surface?"), ElementsAre("hilum", "apex"));
}
TEST(AskTheLeftLung, IsTheApexSuperiorToTheHilum) {
  EXPECT_EQ(asked("is the apex superior to the hilum?").verdict, Verdict::yes);
  EXPECT_EQ(asked("is the apex below the diaphragmatic surface?").verdict, Verdict::no);
  EXPECT_EQ(asked("is the apex in front of the hilum?").verdict, Verdict::unsaid);
}
TEST(AskTheLeftLung, WhatLiesBehindTheAnteriorBorder) {
  EXPECT_THAT(found("what lies behind the anterior border?"),
              ElementsAre("cardiac-impression", "hilum", "posterior-border"));
}
TEST(AskTheLeftLung, WhatDoesTheInferiorBorderBound) {
  EXPECT_THAT(found("which surfaces does the inferior border bound?"),
              UnorderedElementsAre("costal-surface", "mediastinal-surface", "diaphragmatic-surface",
                                   "costal-surface-of-lower-lobe"));
}
TEST(AskTheLeftLung, IsTheHilumPartOfTheLeftLung) {
  EXPECT_EQ(asked("is the hilum part of the surface of the left lung?").verdict, Verdict::yes);
  const AbstractAnswer no = asked("is the hilum part of the left lung?");
  EXPECT_EQ(no.verdict, Verdict::no) << "a surface is no part of a volume";
  EXPECT_THAT(to_text(no, lung()), HasSubstr("no: a surface is never part-of a volume"));
  EXPECT_EQ(asked("does the hilum bound the left lung?").verdict, Verdict::yes);
  EXPECT_EQ(asked("is the left lung part of its upper lobe?").verdict, Verdict::no);
}

// ---- the form ----

TEST(Ask, TheSameQuestionInOtherWords) {
  const std::vector<std::string> bounds = found("what bounds the upper lobe?");
  for (const char* same :
       {"What is the upper lobe bounded by?", "upper-lobe bounded-by ?", "? boundary-of upperLobe", "bounds upper lobe",
        "what is a boundary of upper-lobe-of-left-lung", "which bound the Upper Lobe of the Left Lung"})
    EXPECT_EQ(found(same), bounds) << same;
  EXPECT_EQ(found("left-lung has-part ?"), found("what is part of the left lung"));
  EXPECT_EQ(found("what is the apex of the left lung above"), found("apex up ?"));
  EXPECT_EQ(asked("apex up hilum").verdict, Verdict::yes);
  EXPECT_EQ(found("what is to the left of the mediastinal surface?"), (std::vector<std::string>{"costal-surface"}))
      << "the left of a name is no direction";
}

TEST(Ask, WhatSomethingIs) {
  const AbstractAnswer all = asked("what is the hilum?");
  EXPECT_TRUE(all.query.relation.empty());
  const std::string text = to_text(all, lung());
  EXPECT_THAT(text, AllOf(HasSubstr("hilum-of-left-lung (surface)\n"), HasSubstr("  boundary-of  left-lung "),
                          HasSubstr("  down         apex-of-left-lung ")));
}

TEST(Ask, NamesWhatTheAnswerFollowsFrom) {
  EXPECT_THAT(to_text(asked("is the apex above the diaphragmatic surface?"), lung()),
              HasSubstr("yes: apex-of-left-lung up hilum-of-left-lung up diaphragmatic-surface-of-left-lung\n"));
  EXPECT_THAT(to_text(asked("what bounds the apex?"), lung()), HasSubstr("nothing that the model says"));
  EXPECT_THAT(to_text(asked("which points bound the upper lobe?"), lung()),
              AllOf(HasSubstr("apex-of-left-lung  point"), ::testing::Not(HasSubstr("surface  line"))));
}

TEST(Ask, ItsJsonKeepsToTheSchema) {
  for (const char* question : {"what bounds the upper lobe?", "is the apex above the hilum?", "what is the hilum?",
                               "is the hilum part of the left lung?", "apex front hilum", "what bounds the apex?"})
    EXPECT_EQ(test::schema_faults("answer", to_json(asked(question), lung())), "") << question;
}

TEST(Ask, RefusesWhatItCannotRead) {
  EXPECT_THAT(refused("what bounds the uper lobe?"),
              AllOf(HasSubstr("'uper-lobe'"), HasSubstr("'upper-lobe-of-left-lung'?")));
  EXPECT_THAT(refused("what bounds the liver?"), AllOf(HasSubstr("'liver'"), HasSubstr("known are: left-lung")));
  EXPECT_THAT(refused("what is the lobe part of?"),
              AllOf(HasSubstr("any of upper-lobe-of-left-lung, lower-lobe-of-left-lung"), HasSubstr("say more")));
  EXPECT_THAT(refused(""), HasSubstr("ask as in"));
  EXPECT_THAT(refused("?"), HasSubstr("ask as in"));
  EXPECT_THAT(refused("what bounds what?"), HasSubstr("'what'"));
  EXPECT_THAT(refused("what bounds?"), HasSubstr("no object is named"));
  EXPECT_NE(refused(std::string(20000, 'x')), "none");
  EXPECT_LT(refused(std::string(20000, 'x') + " up of hilum").size(), 45000u);
  const Model bare =
      model_from_text("schema: toposcope.model/1\nname: bare\nfeatures: {rim: {worksets: [convex], shape: circle}}\n",
                      "bare.yaml", nullptr);
  EXPECT_THAT(refused("what bounds the rim?", bare), AllOf(HasSubstr("bare.yaml"), HasSubstr("no abstract part")));
}

}  // namespace
}  // namespace toposcope
