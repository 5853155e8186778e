// What a room brings to scripts: here a test room with a fountain, which has jets as its parts, and a step
// that finishes the scene. Nothing outside this file knows them.
#include "scene/script/scene_builder.h"

#include <gtest/gtest.h>

#include "scene/script/test_fountains.h"

namespace parvis::scene {
namespace {

using SceneBuilderTest = FountainTest;

const std::string three =
    "fountain(name=a, position=\"1 0 0\") { jet(height=1) jet(height=2) }\n"
    "group(name=g, position=\"10 0 0\") { fountain(name=b) { jet(height=3) } }\n"
    "fountain(name=c) { jet(height=4) }\n";

TEST_F(SceneBuilderTest, ItemsStandInTheOrderOfTheScript) {
  load(three);
  EXPECT_EQ(heights(), (std::vector{1.0f, 2.0f, 3.0f, 4.0f}));
  EXPECT_EQ(scene_.objects.size(), 3u);
  EXPECT_EQ(scene_.items<Jet>()[2].foot, glm::vec3(10, 0, 0));
}

TEST_F(SceneBuilderTest, AChangeReplacesExactlyWhatTheNodeMade) {
  load(three);
  live_.set(*live_.find("g"), "position", glm::vec3(20, 0, 0));
  EXPECT_TRUE(live_.refresh(scene_).empty());
  EXPECT_EQ(heights(), (std::vector{1.0f, 2.0f, 3.0f, 4.0f}));
  EXPECT_EQ(scene_.items<Jet>()[2].foot, glm::vec3(20, 0, 0));
  EXPECT_EQ(scene_.items<Jet>()[0].foot, glm::vec3(1, 0, 0));
  ASSERT_EQ(scene_.objects.size(), 3u);
  EXPECT_EQ(scene_.objects[1].world_from_model[3].x, 20.0f);
}

TEST_F(SceneBuilderTest, WhatAStepGaveToAnObjectIsReplacedWithIt) {
  load(three);
  const auto places = [&] {
    std::vector<float> xs;
    for (std::size_t i = 0; i < scene_.items<Slab>().size(); ++i) {
      EXPECT_EQ(scene_.items<Slab>()[i].number, int(i % 2));
      xs.push_back(scene_.items<Slab>()[i].x);
    }
    return xs;
  };
  EXPECT_EQ(places(), (std::vector{1.0f, 1.0f, 10.0f, 10.0f, 0.0f, 0.0f}));
  live_.set(*live_.find("g"), "position", glm::vec3(20, 0, 0));
  EXPECT_TRUE(live_.refresh(scene_).empty());
  EXPECT_EQ(places(), (std::vector{1.0f, 1.0f, 20.0f, 20.0f, 0.0f, 0.0f}));
  live_.set(*live_.find("a"), "position", glm::vec3(2000, 0, 0));
  EXPECT_EQ(live_.refresh(scene_).size(), 1u);
  EXPECT_EQ(places(), (std::vector{1.0f, 1.0f, 20.0f, 20.0f, 0.0f, 0.0f})) << "a step that fails";
}

TEST_F(SceneBuilderTest, AChangedPartBuildsTheNodeAroundItAgain) {
  load(three);
  live_.set(*std::next(live_.find("a")->children.begin()), "height", 7.0);
  EXPECT_TRUE(live_.refresh(scene_).empty());
  EXPECT_EQ(heights(), (std::vector{1.0f, 7.0f, 3.0f, 4.0f}));
}

TEST_F(SceneBuilderTest, WhatCannotBeRebuiltStaysAsItWas) {
  load(three);
  live_.set(*std::next(live_.find("a")->children.begin()), "height", 0.0);
  const Errors errors = live_.refresh(scene_);
  ASSERT_EQ(errors.size(), 1u);
  EXPECT_NE(errors[0].message.find("without water"), std::string::npos);
  EXPECT_EQ(heights(), (std::vector{1.0f, 2.0f, 3.0f, 4.0f}));
  EXPECT_EQ(std::next(live_.find("a")->children.begin())->number("height"), 2.0);
}

TEST_F(SceneBuilderTest, AValueThatCannotBeBuiltLeavesTheOthersOfItsMoment) {
  load(three);
  const Node& fountain = *live_.find("a");
  live_.set(fountain.children.back(), "height", 7.0);
  live_.set(fountain.children.front(), "height", 0.0);
  live_.set(fountain, "position", glm::vec3(4, 0, 0));
  const Errors errors = live_.refresh(scene_);
  ASSERT_EQ(errors.size(), 1u);
  EXPECT_NE(errors[0].message.find("without water"), std::string::npos);
  EXPECT_EQ(heights(), (std::vector{1.0f, 7.0f, 3.0f, 4.0f}));
  EXPECT_EQ(fountain.children.front().number("height"), 1.0);
  EXPECT_EQ(fountain.vec3("position"), glm::vec3(4, 0, 0));
  EXPECT_TRUE(live_.refresh(scene_).empty()) << "nothing is left to be tried again";
}

TEST_F(SceneBuilderTest, FinishStepsSeeTheWholeSceneOnce) {
  load(three);
  EXPECT_EQ(scene_.data<WaterNeed>().metres_of_jets, 10.0f);
  live_.set(*live_.find("c"), "position", glm::vec3(1));
  EXPECT_TRUE(live_.refresh(scene_).empty());
  EXPECT_EQ(scene_.data<WaterNeed>().metres_of_jets, 10.0f);
  std::string much = "fountain() {";
  for (int i = 0; i < 12; ++i) much += " jet(height=9)";
  const Result<LoadedScene> refused = ScriptTest::load(much + " }");
  ASSERT_FALSE(refused);
  EXPECT_NE(to_string(refused.errors()).find("not so much water"), std::string::npos);
}

TEST_F(SceneBuilderTest, ANodeStandsInAnotherRoomsNodeWhereThatRoomAllowsIt) {
  const std::string inside = "fountain() { camera(name=wet) }";
  const Result<LoadedScene> refused = ScriptTest::load(inside);
  ASSERT_FALSE(refused);
  EXPECT_NE(to_string(refused.errors()).find("camera does not stand in fountain, which takes jet"),
            std::string::npos);
  registries_.get<NodeRegistry>().allow("camera", "fountain");
  EXPECT_EQ(registries_.get<NodeRegistry>().children_of("fountain"),
            (std::vector<std::string>{"camera", "jet"}));
}

}  // namespace
}  // namespace parvis::scene
