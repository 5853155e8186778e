// One register_room function; then scripts name the node and the method, messages reach the process, and
// parvis's loop runs the bake step.
#include "rooms/test_room/room.h"

#include <gtest/gtest.h>

#include "base/files.h"
#include "base/test_folder.h"
#include "graphics/gl/test_context.h"
#include "graphics/light/sun_and_sky.h"
#include "graphics/render/bake_steps.h"
#include "rooms/rooms.h"
#include "stage/baking.h"
#include "stage/stage.h"

namespace parvis::rooms {
namespace {
namespace fs = std::filesystem;

constexpr const char* script = R"(
camera(name=front, position="0 -8 2", target="0 0 2", fov_deg=30)
balloon(name=red, position="0 0 2", radius=1)
timer(onTime="0.5, red, rise 2")
reflection(method=balloon_glow, glow=0.5)
scenario(name=small) {
  override(of=red, radius=0.5)
}
)";

class TestRoomTest : public gl::ContextTest {
 protected:
  Result<stage::Simulation> simulation() {
    return stage::open_simulation(registries_, folder_.write("scene.xp", script), {});
  }

  const Registries registries_ = make_registries(std::array{RegisterRoom(test_room::register_room)});
  TestFolder folder_;
};

TEST_F(TestRoomTest, AMessageReachesItsProcess) {
  Result<stage::Simulation> simulation = this->simulation();
  ASSERT_TRUE(simulation) << to_string(simulation.errors());
  const auto height = [&] { return simulation->scene.objects.at(0).world_from_model[3].z; };
  simulation->advance(0.25);
  EXPECT_EQ(height(), 2.0f);
  simulation->advance(1.25);
  EXPECT_NEAR(height(), 4.0f, 0.05f) << "a second at 2 m/s";
  EXPECT_EQ(simulation->clock.find("balloons")->status(), "1 rise");
}

TEST_F(TestRoomTest, ItsReflectionMethodIsDrawnAndCanBeChanged) {
  Result<stage::Simulation> simulation = this->simulation();
  ASSERT_TRUE(simulation) << to_string(simulation.errors());
  Result<std::unique_ptr<stage::Stage>> stage = stage::Stage::create(*std::move(simulation));
  ASSERT_TRUE(stage) << to_string(stage.errors());
  const Result<Camera> camera = (*stage)->camera("front");
  ASSERT_TRUE(camera) << to_string(camera.errors());
  (*stage)->draw(*camera, 64, 64);
  const ImageF glowing = (*stage)->renderer().read_radiance();
  const float* middle = glowing.at(32, 32);
  EXPECT_LT(glm::distance(glm::vec3(middle[0], middle[1], middle[2]), glm::vec3(0, 0.5f, 0)), 0.01f)
      << "the glow, and what a white metal reflects of the sun";

  methods::Settings none = methods::settings((*stage)->scene());
  none.method = "none";
  ASSERT_TRUE((*stage)->set_reflection(none));
  (*stage)->draw(*camera, 64, 64);
  EXPECT_GT((*stage)->renderer().read_radiance().at(32, 32)[0], 0.01f) << "the mean light of the sky";
}

TEST_F(TestRoomTest, ItsBakeStepRunsForEachStateAndForgetsOthers) {
  Result<stage::Simulation> simulation = this->simulation();
  ASSERT_TRUE(simulation) << to_string(simulation.errors());
  const auto volumes = [&] {
    std::set<std::string> found;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder_.path() / "scene.baked/balloons"))
      found.insert(*read_file(entry.path()));
    return found;
  };
  stage::Baking both(registries_);
  ASSERT_TRUE(both.bake(simulation->scene));
  ASSERT_TRUE(simulation->live().choose(simulation->scene, "small"));
  simulation->advance(0.1);
  ASSERT_TRUE(both.bake(simulation->scene));
  both.forget_other_states(simulation->scene);
  EXPECT_EQ(volumes(), (std::set<std::string>{"0.524\n", "4.189\n"}));

  stage::Baking small_alone(registries_);
  ASSERT_TRUE(small_alone.bake(simulation->scene));
  small_alone.forget_other_states(simulation->scene);
  EXPECT_EQ(volumes(), std::set<std::string>{"0.524\n"});
}

int lights_made = 0;

Result<std::unique_ptr<render::LightSource>> counted_light(const scene::Scene& scene, const Bounds& fixed) {
  ++lights_made;
  return light::sun_and_sky(scene, fixed);
}

/// Its only bake step asks for a renderer.
void register_step_with_renderer(Registries& registries) {
  registries.get<render::Lights>().make = counted_light;
  registries.get<render::BakeSteps>().add({.name = "nothing",
                                           .run = [](render::BakeInput& input) -> Result<render::Baked> {
                                             const Result<render::Renderer*> renderer = input.renderer();
                                             if (!renderer) return renderer.errors();
                                             return render::Baked{};
                                           },
                                           .forget_others = [](const scene::Scene&, const auto&) {}});
}

TEST_F(TestRoomTest, WhatIsBakedIsLitAsPicturesAre) {
  const Registries registries = make_registries(std::array{RegisterRoom(register_step_with_renderer)});
  Result<stage::Simulation> simulation =
      stage::open_simulation(registries, folder_.write("scene.xp", "camera(name=front)"), {});
  ASSERT_TRUE(simulation) << to_string(simulation.errors());
  ASSERT_TRUE(stage::Baking(registries).bake(simulation->scene));
  EXPECT_EQ(lights_made, 1);
}

TEST_F(TestRoomTest, WithoutItNothingOfItIsKnown) {
  const Result<stage::Simulation> simulation =
      stage::open_simulation(all_registries(), folder_.write("scene.xp", script), {});
  ASSERT_FALSE(simulation);
  EXPECT_NE(to_string(simulation.errors()).find("balloon"), std::string::npos);
}

}  // namespace
}  // namespace parvis::rooms
