// Shadow maps that follow what begins to move, moves and vanishes: as those of a renderer that is made for
// each moment.
#include "graphics/light/sun_shadow_maps.h"

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include "graphics/gl/test_context.h"
#include "graphics/light/sun_and_sky.h"
#include "graphics/render/frame_views.h"
#include "graphics/render/renderer.h"
#include "scene/data/test_scene.h"

namespace parvis::light {
namespace {

using scene::add, scene::box, scene::ground, scene::matt, scene::model_of;

class ShadowMapsInMotion : public gl::ContextTest {
 protected:
  ShadowMapsInMotion() {
    add(scene_, model_of(ground(30), matt(glm::vec3(0.5f))));
    wall_ = add(scene_, model_of(box({-8, -0.2f, 0}, {8, 0, 4}), matt(glm::vec3(0.5f))));
    guest_ = add(scene_, model_of(box({-1, -1, 0}, {1, 1, 3}), matt(glm::vec3(0.9f))), true);
    scene_.sun.direction_to_sun = glm::normalize(glm::vec3(0.3f, -0.5f, 0.6f));
    camera_.world_from_camera = look_at({-14, -16, 9}, {0, 0, 1});
  }
  std::unique_ptr<render::Renderer> renderer() const {
    Result<std::unique_ptr<render::Renderer>> made = render::Renderer::create(scene_, {}, sun_and_sky);
    EXPECT_TRUE(made) << to_string(made.errors());
    return *std::move(made);
  }
  std::vector<float> drawn(render::Renderer& renderer) const {
    EXPECT_TRUE(render::draw_frame(renderer, scene_, {camera_, 200, 150}));
    return renderer.read_radiance().pixels;
  }
  scene::Object& object(int index) { return scene_.objects[std::size_t(index)]; }

  scene::Scene scene_;
  Camera camera_;
  int wall_ = 0, guest_ = 0;
};

TEST_F(ShadowMapsInMotion, AreThoseOfAFreshRendererAtEachMoment) {
  object(guest_).is_visible = false;  // the maps are drawn while nothing moves
  const auto seeing = renderer();
  std::vector<float> before;
  const auto expect_as_fresh = [&](const char* what) {
    const std::vector<float> now = drawn(*seeing);
    EXPECT_NE(now, before) << what;
    EXPECT_EQ(now, drawn(*renderer())) << what;
    before = now;
  };
  expect_as_fresh("nothing moves");
  object(wall_).is_visible = false;
  expect_as_fresh("a wall vanishes where nothing moves");
  object(guest_).is_visible = true;
  expect_as_fresh("something appears that moves");
  object(guest_).world_from_model = glm::translate(glm::mat4(1.0f), {6, 3, 0});
  expect_as_fresh("it moves: where it stood is light");
  object(wall_).is_visible = true;
  expect_as_fresh("a wall appears beside it");
  object(guest_).is_visible = false;
  expect_as_fresh("it vanishes");
  scene_.sun.direction_to_sun = glm::normalize(glm::vec3(-0.4f, -0.5f, 0.6f));
  expect_as_fresh("a new sun while nothing moves");
  object(guest_).is_visible = true;
  expect_as_fresh("it is back");
}

TEST_F(ShadowMapsInMotion, HeldThingsShadeEachOtherUntilTheyAreLetGo) {
  const auto seeing = renderer();
  scene::Scene held;
  add(held, model_of(box({-4, -8, 0}, {4, -3, 0.1f}), matt(glm::vec3(0.5f))));
  const int plate = add(held, model_of(box({-1, -6, 2}, {1, -5, 2.1f}), matt(glm::vec3(0.5f))));
  const auto shown = [&](bool has_plate, bool draws_map = false) {
    held.objects[std::size_t(plate)].is_visible = has_plate;
    drawn(*seeing);
    Camera far_away;
    far_away.world_from_camera = look_at({300, 0, 2}, {310, 0, 2});
    if (draws_map) seeing->begin_still_frame(scene_, far_away);
    seeing->relight_main_view(scene_, camera_);
    EXPECT_TRUE(seeing->draw_over(held, false));
    return seeing->read_radiance().pixels;
  };
  const std::vector<float> with = shown(true), without = shown(false);
  long darker = 0;
  for (std::size_t i = 0; i < with.size(); ++i) darker += with[i] < 0.5f * without[i];
  EXPECT_GT(darker, 100) << "the plate's shadow on the slab";
  EXPECT_EQ(shown(true, true), with) << "a map of reflections, drawn behind the frame, takes no light away";
  EXPECT_EQ(drawn(*seeing), drawn(*renderer())) << "nothing of it stays in the maps";
}

}  // namespace
}  // namespace parvis::light
