#include "planning/design/session.h"

#include <gtest/gtest.h>

#include "base/colour.h"
#include "base/files.h"
#include "planning/design/design_file.h"
#include "planning/design/shape_models.h"
#include "planning/design/test_design.h"
#include "planning/design/test_random_commands.h"

namespace parvis::design {
namespace {

TEST_F(DesignTest, WhatIsTypedStandsThere) {
  open();
  run("insert bench_stone 12.345,3.05 heading 90");
  const PlacedObject bench = object("bench_stone_1");
  EXPECT_EQ(bench.position, glm::dvec3(12.345, 3.05, 0.0));
  EXPECT_EQ(bench.heading_deg, 90.0);
  EXPECT_EQ(bench.size_m, glm::dvec3(2.0, 0.5, 0.45));
  EXPECT_NEAR(bench.outline.front().y, 3.05 + 1.0, 1e-9) << "its front looks to the east";
  ASSERT_EQ(visible(), 1);
  EXPECT_NEAR(glm::distance(glm::vec3(scene_.objects[0].world_from_model[3]), glm::vec3(12.345f, 3.05f, 0)),
              0, 1e-6);
  const Bounds box = bounds(*scene_.objects[0].model);
  EXPECT_NEAR(box.size().x, 2.0f, 1e-5f);
  EXPECT_NEAR(box.size().z, 0.45f, 1e-5f);
}

TEST_F(DesignTest, EveryKindOfTheCatalogueStands) {
  open();
  int at = 0;
  for (const Kind& kind : shipped_kinds()) {
    run(fmt::format("insert {} {},0", kind.name, 20 * at++));
    const PlacedObject made = object(kind.name + "_1");
    EXPECT_EQ(made.size_m, kind.size_m) << kind.name;
    EXPECT_FALSE(kind.label_fr.empty());
    if (kind.shape.empty()) continue;
    const glm::vec3 size = bounds(shape_model(kind.shape, {glm::vec3(kind.size_m), kind.colour, ""})).size();
    for (int axis = 0; axis < 3; ++axis)
      EXPECT_NEAR(size[axis], float(kind.size_m[axis]), 0.16f * float(kind.size_m[axis]) + 0.02f)
          << kind.name << " along axis " << axis;
  }
}

TEST_F(DesignTest, WhatRestsRestsAgainWhereverItGoes) {
  double kerb_m = 0.15;
  open("camera(name=eye)", [&](glm::dvec2 at, const Names&) { return at.x > 10.0 ? kerb_m : 0.0; });
  run("insert bollard 8,0");
  run("insert bollard 8,2,0.8");
  run("move bollard_1,bollard_2 by 4,0");
  EXPECT_EQ(object("bollard_1").position, glm::dvec3(12.0, 0.0, 0.15));
  EXPECT_EQ(object("bollard_2").position.z, 0.8) << "a height that was given stays";
  const std::string text = session_->done().back().text;
  run("duplicate bollard_1 by -6,0");
  EXPECT_EQ(object("bollard_3").position, glm::dvec3(6.0, 0.0, 0.0));
  run("move bollard_1 by 1,0,0.5");
  EXPECT_EQ(object("bollard_1").position.z, 0.65);
  run("insert bench_wood 0,5");
  run("turn bench_wood_1 by 90 about 20,5");
  EXPECT_EQ(object("bench_wood_1").position.z, 0.15);
  run("row planter from 5,9 to 15,9 count 3");
  run("move planter_2 to 12,9");
  EXPECT_EQ(object("planter_2").position.z, 0.15);
  run("space planter_1,planter_2,planter_3");
  EXPECT_EQ(object("planter_2").position, glm::dvec3(10.0, 9.0, 0.0));
  run("surface gravel 0,0 4,0 4,4");
  run("move surface_1 by 20,0");
  EXPECT_EQ(object("surface_1").position.z, 0.15);
  // Done again elsewhere, a step is the same.
  kerb_m = 0.3;
  open(
      "design(name=d) { placed(name=bollard_1, kind=bollard, position=\"8 0 0\")\n"
      "placed(name=bollard_2, kind=bollard, position=\"8 2 0.8\") }");
  run(text);
  EXPECT_EQ(object("bollard_1").position, glm::dvec3(12.0, 0.0, 0.15)) << text;
}

TEST_F(DesignTest, AStepSaysOnWhatAnObjectStands) {
  open("camera(name=eye)", [](glm::dvec2, const Names&) { return 0.74; });
  run("insert table 0,0,0");
  const double top = object("table_1").size_m.z;
  run(fmt::format("insert bin 0.1,0,{}", top));
  EXPECT_EQ(session_->done().back().sentence, "inserted bin_1 on table_1");
  run("insert bin 3,0,0");
  EXPECT_EQ(session_->done().back().sentence, "inserted bin_2");
}

TEST_F(DesignTest, ViewsAreCamerasOfTheDesign) {
  open();
  run("view square_1 1,2,30 heading 90 pitch -90 parallel 24");
  const scene::NamedCamera* kept = scene_.find_camera("square_1");
  ASSERT_NE(kept, nullptr);
  ASSERT_TRUE(kept->camera.parallel);
  EXPECT_EQ(kept->camera.parallel->height_m, 24.0f);
  EXPECT_EQ(kept->camera.position_in_world(), glm::vec3(1, 2, 30));
  const KeepView again = view_of(kept->camera, "square_1");
  EXPECT_EQ(again.heading_deg, 90.0);
  EXPECT_EQ(again.pitch_deg, -90.0);
  EXPECT_EQ(again.parallel_m, 24.0);

  run("view square_1 4,5,1.7 heading -30 pitch 5 fov 60");
  kept = scene_.find_camera("square_1");
  EXPECT_FALSE(kept->camera.parallel) << "the view of that name is replaced";
  EXPECT_NEAR(view_of(kept->camera, "").fov_deg, 60.0, 0.02);
  EXPECT_NEAR(view_of(kept->camera, "").heading_deg, -30.0, 0.02);
  EXPECT_TRUE(session_->objects().empty()) << "a view is no object";

  run("insert bench_stone 0,0 name bench");
  EXPECT_NE(refusal("view bench 0,0,1.7").find("another name"), std::string::npos);
  EXPECT_FALSE(refusal("view flat 0,0,1.7 parallel -1").empty());
  run("undo"), run("undo"), run("undo");
  EXPECT_EQ(scene_.find_camera("square_1"), nullptr);
}

TEST_F(DesignTest, IsWrittenBesideASceneThatIsNamedWithoutAFolder) {
  open();
  run("insert bench_stone 0,0");
  const std::filesystem::path before = std::filesystem::current_path();
  std::filesystem::current_path(folder_.path());
  const Status written = save(*session_, "scene.xp", "design.xp");
  const Status elsewhere = save(*session_, "scene.xp", std::filesystem::path("..") / "design.xp");
  std::filesystem::current_path(before);
  EXPECT_TRUE(written) << to_string(written.errors());
  EXPECT_TRUE(std::filesystem::exists(folder_.path() / "design.xp"));
  EXPECT_FALSE(elsewhere);
}

TEST_F(DesignTest, IsWrittenOverNothingElse) {
  const std::filesystem::path script = folder_.write("mine.xp", "// Mine\ncamera(name=eye)\n"),
                              other = folder_.write("other.xp", "camera(name=another)\n");
  open();
  run("insert bench_stone 0,0");
  EXPECT_FALSE(save(*session_, script, other));
  EXPECT_EQ(*read_file(other), "camera(name=another)\n");
  const Status written = save(*session_, script, script);
  ASSERT_TRUE(written) << to_string(written.errors());
  const std::string text = *read_file(script);
  EXPECT_TRUE(text.starts_with("// Mine\ncamera(name=eye)\n")) << "behind all else: " << text;
  EXPECT_NE(text.find("bench_stone_1"), std::string::npos);
}

TEST_F(DesignTest, AScriptThatPutsTwoInOnePlaceIsWarnedOfIt) {
  const auto warnings_of = [&](const char* second) {
    const auto loaded = ScriptTest::load(fmt::format(
        "design(name=d) {{ placed(name=one, kind=bin, position=\"0 -8 0\") placed(name=two, kind=bin, "
        "position=\"{}\") }}",
        second));
    EXPECT_TRUE(loaded);
    return loaded ? to_string(loaded->warnings) : "";
  };
  EXPECT_NE(warnings_of("0 -8 0").find("\"two\" stands where \"one\" stands"), std::string::npos);
  EXPECT_EQ(warnings_of("0 -7 0").find("stands where"), std::string::npos);
}

TEST_F(DesignTest, NamesOfGroupsAndWordsOfCommandsAreKnown) {
  open();
  run("row umbrella from 0,0 to 12,0 count 3");
  run("group umbrella_1,umbrella_2 as suns");
  run("ungroup suns");
  EXPECT_EQ(object("umbrella_1").group, "");
  EXPECT_NE(refusal("insert bin 0,5 name none").find("word of commands"), std::string::npos);
  EXPECT_NE(refusal("surface paving 0,0 4,0 0,4 4,4").find("crosses itself"), std::string::npos);
}

TEST_F(DesignTest, CommandsChangeWhatTheySay) {
  open();
  run("row umbrella from 0,0 to 12,0 count 4");
  EXPECT_EQ(object("umbrella_2").position, glm::dvec3(4, 0, 0));
  run("move umbrella_2 by 0.5,1");
  run("align umbrella_1,umbrella_2 y");
  EXPECT_EQ(object("umbrella_2").position, glm::dvec3(4.5, 0, 0));
  run("space umbrella_1,umbrella_2,umbrella_3,umbrella_4");
  EXPECT_EQ(object("umbrella_2").position, glm::dvec3(4, 0, 0));
  run("resize umbrella_1 width 4 height 3");
  run("colour umbrella_1 #C04030");
  run("apply umbrella_1 to umbrella_*");
  EXPECT_EQ(object("umbrella_3").size_m, glm::dvec3(4, 4, 3));
  EXPECT_NEAR(object("umbrella_3").colour.x, linear_from_srgb8(0xC0, 0x40, 0x30).x, 1e-6f);
  run("group umbrella_1,umbrella_2 as corner");
  run("select group corner");
  EXPECT_EQ(session_->selected(), (Names{"umbrella_1", "umbrella_2"}));
  run("turn selected by 90 about 0,0");
  EXPECT_NEAR(glm::distance(object("umbrella_2").position, glm::dvec3(0, -4, 0)), 0.0, 1e-6) << "clockwise";
  run("duplicate selected by 0,10");
  EXPECT_EQ(session_->selected().size(), 2u);
  run("select box -1,-1 1,1");
  EXPECT_EQ(session_->selected(), (Names{"umbrella_1"}));
  run("swap selected for bollard");
  EXPECT_EQ(object("umbrella_1").size_m, glm::dvec3(0.2, 0.2, 0.96));
  run("surface paving 0,0 8,0 8,6 0,6 name court");
  EXPECT_NEAR(signed_area_m2(object("court").outline), 48.0, 1e-9);
  run("select like umbrella_3");
  EXPECT_EQ(session_->selected().size(), 5u) << "three of the row and two copies";
  run("delete selected");
  EXPECT_EQ(session_->objects().size(), 2u);
}

TEST_F(DesignTest, ACommandThatCannotBeDoneSaysWhyAndChangesNothing) {
  open();
  run("insert bench_wood 1,1");
  EXPECT_EQ(refusal("insert bench_wod 1,1").substr(0, 58),
            "the catalogue has no kind \"bench_wod\"; did you mean \"bench");
  EXPECT_NE(refusal("insert bench_wood 1e30,0").find("km from the scene's origin"), std::string::npos);
  EXPECT_NE(refusal("insert bench_wood 1,1").find("stands there already"), std::string::npos);
  EXPECT_NE(refusal("insert bench_wood 1").find("X,Y or X,Y,Z"), std::string::npos);
  EXPECT_NE(refusal("resize bench_wood_1 width 9").find("0.6 to 6 m"), std::string::npos);
  EXPECT_NE(refusal("resize bench_wood_1 depth 1").find("is fixed"), std::string::npos);
  EXPECT_NE(refusal("move selected to 3").find("X,Y"), std::string::npos);
  EXPECT_NE(refusal("move bench_wood_2 by 1,1").find("no object \"bench_wood_2\""), std::string::npos);
  EXPECT_NE(refusal("surface paving 0,0 1,0").find("three corners"), std::string::npos);
  EXPECT_NE(refusal("surface paving 0,0 1,0 2,0").find("no area"), std::string::npos);
  EXPECT_NE(refusal("mov bench_wood_1 by 1,1").find("did you mean \"move\""), std::string::npos);
  run("lock bench_wood_1");
  EXPECT_NE(refusal("delete bench_wood_1").find("is locked"), std::string::npos);
  run("select none");
  EXPECT_NE(refusal("delete selected").find("nothing is selected"), std::string::npos);
  EXPECT_NE(refusal("redo").find("nothing to do again"), std::string::npos);
}

TEST_F(DesignTest, TextFormsAreReadAsTheSameCommand) {
  for (const char* text : {"insert bench_wood 12.345,3.05,0.15 heading 90 width 2.4 colour #804020 name b",
                           "move a,b by 0.5,-1,0",
                           "move a to 3,4,0",
                           "turn a by 15 about 1,2",
                           "turn a to 90",
                           "resize a by 1.5",
                           "resize a width 3 height 1",
                           "delete a,b",
                           "duplicate a by 1,0,0",
                           "move a,b by 1,2 heights 0.15,0",
                           "row bollard from 0,0 to 10,0 spacing 2.5 heading 0",
                           "space a,b,c",
                           "align a,b heading",
                           "group a as g",
                           "ungroup a",
                           "lock a",
                           "unlock a",
                           "colour a #102030",
                           "material a stone",
                           "swap a for b",
                           "apply a to b,c",
                           "surface lawn 0,0,0 1,0,0 1,1,0 name s",
                           "rename a as b"}) {
    const Result<Command> command = parse_command(text);
    ASSERT_TRUE(command) << text << to_string(command.errors());
    EXPECT_EQ(text_of(*command), text);
    EXPECT_FALSE(sentence_of(*command).empty());
  }
}

TEST_F(DesignTest, EveryStepCanBeUndoneAndDoneAgain) {
  open("design(name=d) { placed(name=old, kind=bench_wood, position=\"5 5 0\") }");
  const std::string before = session_->script();
  Random random(11);
  std::vector<std::string> scripts{before};
  for (int i = 0; i < 600; ++i) (void)session_->run(random_command(random, *session_));
  EXPECT_GT(session_->done().size(), 100u);
  const std::string after = session_->script();
  const std::size_t steps = session_->done().size();
  for (std::size_t i = 0; i < steps; ++i) ASSERT_TRUE(session_->undo());
  EXPECT_EQ(session_->script(), before);
  for (std::size_t i = 0; i < steps; ++i) ASSERT_TRUE(session_->redo());
  EXPECT_EQ(session_->script(), after);
  // What is to be seen is what a scene shows that is loaded with this design.
  const int shown = visible();
  open("design(name=d) { " + after + " }");
  EXPECT_EQ(visible(), shown);
}

}  // namespace
}  // namespace parvis::design
