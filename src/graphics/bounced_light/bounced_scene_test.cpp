// Bounced light of a scene that runs: it follows messages and scenarios that change what it comes from.
#include <gtest/gtest.h>

#include "formats/gltf/test_mesh_file.h"
#include "graphics/gl/test_context.h"
#include "graphics/render/frame_views.h"
#include "graphics/render/light_source.h"
#include "graphics/render/test_renderer.h"
#include "room_list.h"
#include "scene/script/live_scene.h"
#include "scene/script/test_script.h"

namespace parvis::bounced_light {
namespace {

class BouncedScene : public scene::ScriptTest<gl::ContextTest> {
 protected:
  BouncedScene() {
    for (const auto register_room : {script::register_room, gltf::register_room, meshes::register_room,
                                     light::register_room, bounced_light::register_room})
      register_room(registries_);
    scene::write_grey(folder_.path() / "ground.glb", scene::ground(24));
    scene::write_grey(folder_.path() / "west.glb", scene::box({-10, -20, 0}, {-6, 20, 9}));
    scene::write_grey(folder_.path() / "east.glb", scene::box({6, -20, 0}, {10, 20, 9}));
  }
  std::unique_ptr<render::Renderer> renderer_of(const scene::Scene& scene) const {
    return render::renderer_of(scene, registries_.get<render::Lights>().make);
  }
  /// The light in all cells when a frame has been drawn.
  static std::vector<glm::vec4> light_in(render::Renderer& renderer, const scene::Scene& scene) {
    EXPECT_TRUE(render::draw_frame(renderer, scene, {Camera{}, 16, 16}));
    const shading::BouncedLight* const bounced = renderer.drawn_light().bounced;
    EXPECT_NE(bounced, nullptr);
    return bounced ? bounced->lobes : std::vector<glm::vec4>();
  }
};

TEST_F(BouncedScene, FollowsScenariosAndMessagesAsIfItWereMadeThen) {
  auto loaded = load(
      "sun(azimuth_deg=250, elevation_deg=50)\nbouncedLight(spacing=4, rays=64)\nmodel(file=\"ground.glb\")\n"
      "model(file=\"west.glb\")\nmodel(name=\"east\", file=\"east.glb\")\n"
      "scenario(name=\"open\") { override(of=\"east\", visible=0) }\n");
  ASSERT_TRUE(loaded) << to_string(loaded.errors());
  scene::Scene& scene = loaded->scene;
  scene::LiveScene live(std::move(loaded->script));
  ASSERT_TRUE(live.prepare_scenarios(scene));
  const auto renderer = renderer_of(scene);
  const auto now = [&] { return light_in(*renderer, scene); };
  const auto made_then = [&] { return light_in(*renderer_of(scene), scene); };

  const std::vector<glm::vec4> street = now();
  ASSERT_FALSE(street.empty());
  EXPECT_EQ(now(), street) << "nothing has changed";
  ASSERT_TRUE(live.choose(scene, "open"));
  EXPECT_NE(now(), street) << "the wall that the sun shone on has gone";
  EXPECT_EQ(now(), made_then());
  ASSERT_TRUE(live.choose(scene, scene::base_scene));
  EXPECT_EQ(now(), street);

  const scene::Node* const sun = live.find("%sun");
  ASSERT_NE(sun, nullptr);
  const auto message = scene::parse_message(*sun->schema, "elevation_deg 12", {});
  ASSERT_TRUE(message);
  ASSERT_TRUE(live.receive(*sun, *message));
  ASSERT_TRUE(live.refresh(scene).empty());
  EXPECT_NE(now(), street) << "the sun has gone down";
  EXPECT_EQ(now(), made_then());
}

}  // namespace
}  // namespace parvis::bounced_light
