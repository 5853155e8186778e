#include "viewer/visit.h"

#include "base/image_io.h"
#include "reflections/methods/settings.h"
#include "viewer/test_square.h"

namespace parvis::viewer {
namespace {

class VisitTest : public SquareTest {};

bool holds(const std::string& text, const std::string& piece) {
  return text.find(piece) != std::string::npos;
}

TEST_F(VisitTest, ScenariosAreSwitchedLive) {
  EXPECT_TRUE(sees("oak") && !sees("plane"));
  visit_->show_scenario("green");
  EXPECT_TRUE(sees("oak") && sees("plane"));
  EXPECT_NEAR(azimuth_and_elevation_deg(visit_->scene().sun.direction_to_sun).y, 18.0f, 1e-3f);
  visit_->show_next_scenario();
  EXPECT_EQ(visit_->live().scenario(), "bare");
  EXPECT_FALSE(sees("oak"));
  visit_->show_next_scenario();
  EXPECT_EQ(visit_->live().scenario(), "") << "after the last: the base scene";
  EXPECT_TRUE(sees("oak") && !sees("plane"));
  visit_->show_scenario("blue");
  EXPECT_TRUE(holds(told(), "no scenario \"blue\"")) << told();
}

TEST_F(VisitTest, WhatANodeReceivesIsSeenAStepLater) {
  EXPECT_TRUE(visit_->tell(node("oak"), "position 1 2 0"));
  wait();
  for (const scene::Object& object : visit_->scene().objects)
    if (object.name == "oak") {
      EXPECT_EQ(glm::vec3(object.world_from_model[3]), glm::vec3(1, 7, 0));
    }
}

TEST_F(VisitTest, BadValuesAreAnsweredByTheSchemaAndChangeNothing) {
  const glm::vec3 before = visit_->scene().sun.direction_to_sun;
  const Status status = visit_->tell(node("%sun"), "elevation_deg 200");
  ASSERT_FALSE(status);
  EXPECT_TRUE(holds(to_string(status.errors()), "from -90 to 90")) << to_string(status.errors());
  wait();
  EXPECT_EQ(visit_->scene().sun.direction_to_sun, before);
}

TEST_F(VisitTest, WhatCannotBeBuiltIsReportedAndTakenBack) {
  EXPECT_TRUE(visit_->tell(node("street"), "target -7 -11 1.7")) << "a right vector";
  wait();
  EXPECT_TRUE(holds(told(), "the target lies in the eye")) << told();
  EXPECT_EQ(node("street").vec3("target"), glm::vec3(0, 4, 2.2f));
}

TEST_F(VisitTest, LightChangesWithAndWithoutNodes) {
  for (const bool has_nodes : {true, false}) {
    if (!has_nodes) open("camera(name=eye)\n");
    visit_->set_sun(90, 30);
    visit_->set_exposure(2.5f);
    visit_->set_reflection("shared_cube_map");
    wait();
    const glm::vec2 sun = azimuth_and_elevation_deg(visit_->scene().sun.direction_to_sun);
    EXPECT_NEAR(sun.x, 90.0f, 1e-3f);
    EXPECT_NEAR(sun.y, 30.0f, 1e-3f);
    EXPECT_EQ(visit_->scene().exposure, 2.5f);
    EXPECT_EQ(methods::settings(visit_->scene()).method, "shared_cube_map");
    stage_->draw(visit_->camera(), 64, 48);
    EXPECT_EQ(told(), "");
  }
}

TEST_F(VisitTest, FollowsOneVehicleAfterTheOther) {
  ASSERT_EQ(visit_->vehicles().size(), 2u);
  visit_->set_mode(Mode::follow);
  EXPECT_EQ(visit_->mode(), Mode::fly) << "nothing to follow has been chosen";
  visit_->follow_next_vehicle();
  EXPECT_EQ(visit_->mode(), Mode::follow);
  EXPECT_EQ(visit_->followed(), visit_->vehicles()[0]);
  wait();
  const glm::vec3 car(visit_->scene().objects[std::size_t(visit_->followed())].world_from_model[3]);
  EXPECT_LT(glm::distance(visit_->camera().position_in_world(), car), 12.0f);
  visit_->follow_next_vehicle();
  EXPECT_EQ(visit_->followed(), visit_->vehicles()[1]);
  visit_->follow_next_vehicle();
  EXPECT_EQ(visit_->followed(), visit_->vehicles()[0]);

  open("camera(name=eye)\n");
  visit_->follow_next_vehicle();
  EXPECT_TRUE(holds(told(), "nothing in this scene moves")) << told();
}

TEST_F(VisitTest, FollowsTrafficRatherThanParkedCars) {
  open(R"(
road(path="-60 0, 60 0")
model(name="a parked car", file="car.glb", position="0 9 0", dynamic=1)
traffic(vehicles=1, seed=3) { model(file="car.glb") }
camera(name=chase, follows="vehicle 1", offset="-6 0 2")
)");
  EXPECT_EQ(visit_->vehicles().size(), 2u) << "nothing has moved yet";
  wait(0.5f);
  ASSERT_EQ(visit_->vehicles().size(), 1u);
  const auto car = [this] { return visit_->scene().objects[std::size_t(visit_->vehicles()[0])]; };
  EXPECT_EQ(car().name, "vehicle 1");

  visit_->look_from("chase");
  for (int second = 0; second < 3; ++second) {
    for (int frame = 0; frame < 10; ++frame) wait(0.1f);
    const glm::vec3 at(car().world_from_model[3]);
    EXPECT_NEAR(glm::distance(visit_->camera().position_in_world(), at), std::sqrt(40.0f), 0.2f)
        << "the view rides along";
  }
}

TEST_F(VisitTest, GoesToCamerasAndTakesTours) {
  visit_->look_from("roof");
  wait();
  EXPECT_NEAR(visit_->camera().position_in_world().z, 14.0f, 1e-4f);
  visit_->start_tour("arrival");
  wait();
  for (int frame = 0; frame < 150; ++frame) wait();
  EXPECT_NEAR(visit_->camera().position_in_world().z, 1.7f, 1e-3f) << "the last stop";
  visit_->step({.move = {1, 0, 0}}, 0.1f);
  EXPECT_GT(glm::distance(visit_->camera().position_in_world(), glm::vec3(-7, -11, 1.7f)), 0.1f)
      << "who moves leaves the tour";
  visit_->look_from("cellar");
  visit_->start_tour("departure");
  EXPECT_TRUE(holds(told(), "cellar") && holds(told(), "departure")) << told();
}

TEST_F(VisitTest, TrafficHaltsAndMovesByAStep) {
  const auto places = [this] {
    std::vector<glm::mat4> all;
    for (const int vehicle : visit_->vehicles())
      all.push_back(visit_->scene().objects[std::size_t(vehicle)].world_from_model);
    return all;
  };
  wait(0.5f);
  visit_->halt(true);
  wait();
  const auto halted = places();
  wait(0.5f);
  EXPECT_EQ(places(), halted);
  visit_->step_halted();
  wait();
  const auto stepped = places();
  EXPECT_NE(stepped, halted);
  visit_->halt(false);
  wait(0.5f);
  EXPECT_NE(places(), stepped);
}

TEST_F(VisitTest, PicturesAreNumberedAndNeverWrittenOver) {
  stage_->draw(visit_->camera(), 64, 48);
  visit_->take_picture();
  visit_->take_picture();
  const std::filesystem::path folder = folder_.path() / "pictures";
  for (const char* name : {"square-0001.png", "square-0002.png"}) {
    const Result<Image8> picture = read_image8(folder / name);
    ASSERT_TRUE(picture) << to_string(picture.errors());
    EXPECT_EQ(picture->width, 64);
    EXPECT_TRUE(holds(told(), name)) << told();
  }
}

TEST_F(VisitTest, AfterAHaltLifeGoesOnWhereItStopped) {
  const auto place = [this] {
    return glm::vec3(visit_->scene().objects[std::size_t(visit_->vehicles()[0])].world_from_model[3]);
  };
  const glm::vec3 before = place();
  visit_->step({.move = {1, 0, 0}}, 60.0f);
  EXPECT_LT(glm::distance(place(), before), 3.0f) << "no vehicle jumps";
  const float walked_m = glm::distance(visit_->camera().position_in_world(), glm::vec3(-7, -11, 1.7f));
  EXPECT_LT(walked_m, 2.0f);
  EXPECT_GT(walked_m, 1.0f) << "slow frames do not hold the visitor";
}

TEST_F(VisitTest, NoticesGoAfterAWhile) {
  visit_->notice("one");
  visit_->notice("one");
  EXPECT_EQ(visit_->notices().size(), 1u) << "said twice, read once";
  for (int i = 0; i < 20; ++i) visit_->notice(fmt::format("{}", i));
  EXPECT_LE(visit_->notices().size(), 6u) << "the picture stays in sight";
  wait(3.0f);
  EXPECT_FALSE(visit_->notices().empty());
  wait(3.0f);
  EXPECT_TRUE(visit_->notices().empty()) << "by the clock, however slow the frames";
}

}  // namespace
}  // namespace parvis::viewer
