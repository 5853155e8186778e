// Scenarios of the paper's city, there and back.
#include <gtest/gtest.h>

#include "base/files.h"
#include "base/test_folder.h"
#include "graphics/gl/context.h"
#include "places/paper_city/paper_city.h"
#include "rooms/rooms.h"
#include "stage/stage.h"

namespace parvis::rooms {
namespace {

constexpr int scenario_width = 320, scenario_height = 180;
constexpr int settling_frames = 3;  // coarse shadow maps and reflections follow over some frames

/// A project by day, and the same evening: objects that go and come, light, the sky.
constexpr const char* project = R"(
include(file="paper.xp")
scenario(name="project") {
  override(of="tree 1", visible=0)
  override(of="tree 2", position="-66 30 0")
  model(name="oak 1", file="park_tree.glb", position="-69.3 96 0", heading_deg=10)
}
scenario(name="evening", extends="project") {
  override(of="%sun", azimuth_deg=250, elevation_deg=15)
  override(of="%sky", heading_deg=90, intensity=0.6)
  override(of="%exposure", value=1.3)
}
)";

TEST(Scenarios, ThereAndBackGivesTheSamePictureOfThePapersCity) {
  const TestFolder folder;
  const Status city = city::write_paper_city(folder.path(), 1);
  ASSERT_TRUE(city) << to_string(city.errors());
  ASSERT_TRUE(write_file(folder.path() / "project.xp", project));
  const Result<gl::Context> context = gl::Context::create_headless();
  ASSERT_TRUE(context) << to_string(context.errors());
  Result<stage::Simulation> simulation =
      stage::open_simulation(rooms::all_registries(), folder.path() / "project.xp", {});
  ASSERT_TRUE(simulation) << to_string(simulation.errors());
  simulation->advance(2.0);
  Result<std::unique_ptr<stage::Stage>> stage = stage::Stage::create(*std::move(simulation));
  ASSERT_TRUE(stage) << to_string(stage.errors());
  const Result<Camera> camera = (*stage)->camera("street");
  ASSERT_TRUE(camera) << to_string(camera.errors());
  const auto picture_of = [&](const std::string& scenario) {
    const Status chosen = (*stage)->choose_scenario(scenario);
    EXPECT_TRUE(chosen) << to_string(chosen.errors());
    for (int frame = 0; frame < settling_frames; ++frame)
      (*stage)->draw(*camera, scenario_width, scenario_height);
    return (*stage)->picture().pixels;
  };
  const auto base = picture_of(""), project_by_day = picture_of("project"), evening = picture_of("evening");
  EXPECT_NE(base, project_by_day);
  EXPECT_NE(project_by_day, evening);
  EXPECT_EQ(picture_of("project"), project_by_day);
  EXPECT_EQ(picture_of(""), base);
}

}  // namespace
}  // namespace parvis::rooms
