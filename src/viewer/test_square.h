// A small square with something of everything that the panel shows, for this room's tests: boxes for houses
// and trees, two vehicles on a street, a camera, a tour, a scenario.
#pragma once

#include <gtest/gtest.h>

#include <memory>

#include "base/test_folder.h"
#include "formats/gltf/gltf_writer.h"
#include "graphics/gl/test_context.h"
#include "rooms/rooms.h"
#include "scene/data/test_scene.h"
#include "viewer/visit.h"

namespace parvis::viewer {

inline constexpr const char* square_script = R"(
sun(azimuth_deg=215, elevation_deg=42)
exposure(value=1.1)
reflection(method=none)
model(name=pavement, file="ground.glb")
group(name=houses) {
  model(name=corner, file="house.glb", position="-9 12 0")
  model(name=hotel, file="hotel.glb", position="6 14 0")
}
group(name=trees, position="0 5 0") {
  model(name=oak, file="tree.glb", position="-3 0 0")
  model(name=plane, file="tree.glb", position="4 0 0", visible=0) { material(preset=paint, target="part") }
}
road(path="-60 0, 60 0")
traffic(vehicles=2, seed=3) { model(file="car.glb") }
camera(name=street, position="-7 -11 1.7", target="0 4 2.2", fov_deg=70)
camera(name=roof, position="12 -16 14", heading_deg=325, pitch_deg=-28)
tour(name=arrival) { stop(time_s=0, camera=roof) stop(time_s=4, camera=street) }
scenario(name=green, title="Two trees, low sun") {
  override(of=plane, visible=1)
  override(of="%sun", elevation_deg=18)
}
scenario(name=bare) { override(of=trees, visible=0) }
)";

/// A visit to that square. Needs OpenGL.
class SquareTest : public gl::ContextTest {
 protected:
  void SetUp() override {
    gl::ContextTest::SetUp();
    if (IsSkipped() || HasFatalFailure()) return;
    open(square_script);
  }

  void open(const std::string& script) {
    const auto write = [this](const char* name, const Mesh& mesh, glm::vec3 colour) {
      EXPECT_TRUE(scene::write_gltf(folder_.path() / name, *scene::model_of(mesh, scene::matt(colour))));
    };
    write("ground.glb", scene::ground(60), {0.28f, 0.27f, 0.25f});
    write("house.glb", scene::box({-4, -3, 0}, {4, 3, 9}), {0.60f, 0.38f, 0.15f});
    write("hotel.glb", scene::box({-6, -3, 0}, {6, 3, 7}), {0.55f, 0.50f, 0.42f});
    write("tree.glb", scene::sphere({0, 0, 3}, 1.6f), {0.10f, 0.25f, 0.06f});
    write("car.glb", scene::box({-2.1f, -0.9f, 0.2f}, {2.1f, 0.9f, 1.4f}), {0.40f, 0.05f, 0.04f});
    Result<stage::Simulation> simulation =
        stage::open_simulation(rooms::all_registries(), folder_.write("square.xp", script), {});
    ASSERT_TRUE(simulation) << to_string(simulation.errors());
    Result<std::unique_ptr<stage::Stage>> stage = stage::Stage::create(*std::move(simulation));
    ASSERT_TRUE(stage) << to_string(stage.errors());
    stage_ = *std::move(stage);
    const Result<Camera> start = stage_->camera("");
    ASSERT_TRUE(start) << to_string(start.errors());
    visit_ = std::make_unique<Visit>(*stage_, *start, PicturePlace{folder_.path() / "pictures", "square"});
  }

  /// Lets time pass in which nobody touches anything.
  void wait(float seconds = 1.0f / 30.0f) { visit_->step({}, seconds); }

  const scene::Node& node(const std::string& name) { return *visit_->live().find(name); }
  bool sees(const std::string& name) const {
    for (const scene::Object& object : visit_->scene().objects)
      if (object.name == name) return object.is_visible;
    ADD_FAILURE() << "no object " << name;
    return false;
  }
  /// All notices that the visitor sees now.
  std::string told() const {
    std::string all;
    for (const Notice& notice : visit_->notices()) all += notice.text + "\n";
    return all;
  }

  TestFolder folder_;
  std::unique_ptr<stage::Stage> stage_;
  std::unique_ptr<Visit> visit_;
};

}  // namespace parvis::viewer
