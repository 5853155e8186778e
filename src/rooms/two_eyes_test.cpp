// Every method of reflection draws the eyes of one frame as it draws each alone.
#include <gtest/gtest.h>

#include <array>

#include "graphics/gl/test_context.h"
#include "reflections/reference_maps/test_square.h"
#include "rooms/rooms.h"

namespace parvis::rooms {
namespace {

using render::EyeView;

/// Some methods draw a part of their maps in each frame.
constexpr int frames = 4;

/// An eye before the mirror of reference_maps::tower_square.
EyeView eye_at(glm::vec3 position) {
  Camera camera;
  camera.world_from_camera = look_at(position, {1.5f, 0.5f, 1.6f});
  return {camera, 160, 120};
}

/// The picture of each eye after some frames of all of them; a method that is not named reflects the sky
/// alone.
std::vector<ImageF> seen_by(const std::vector<EyeView>& eyes, const std::string& method) {
  scene::Scene scene = reference_maps::tower_square();
  scene::add(scene,
             scene::model_of(scene::box({-2.6f, 0.2f, 0.2f}, {-1.2f, 2.2f, 1.8f}),
                             reference_maps::lamp({0.85f, 0.1f, 0.05f})),
             true);
  if (!method.empty()) {
    methods::settings(scene).method = method;
    EXPECT_TRUE(method_registry().prepare(scene));
  }
  Result<std::unique_ptr<render::Renderer>> renderer =
      render::Renderer::create(scene, {}, light::sun_and_sky);
  EXPECT_TRUE(renderer) << to_string(renderer.errors());
  std::unique_ptr<methods::Reflections> reflections;
  if (!method.empty()) {
    Result<std::unique_ptr<methods::Reflections>> made = method_registry().make(scene, **renderer);
    EXPECT_TRUE(made) << to_string(made.errors());
    reflections = *std::move(made);
    EXPECT_TRUE((*renderer)->set_reflection(reflections.get()));
  }
  for (int frame = 0; frame < frames; ++frame)
    EXPECT_TRUE(methods::draw_frame(**renderer, scene, reflections.get(), eyes));
  std::vector<ImageF> pictures;
  for (std::size_t eye = 0; eye < eyes.size(); ++eye) {
    (*renderer)->select_eye(eye);
    pictures.push_back((*renderer)->read_radiance());
  }
  return pictures;
}

class TwoEyesTest : public gl::ContextTest {};

TEST_F(TwoEyesTest, EveryMethodDrawsEachEyeAsAlone) {
  const EyeView left = eye_at({-2.5f, -3.5f, 2.2f}), right = eye_at({6.0f, -2.0f, 2.4f});
  const ImageF sky_alone = seen_by({left}, "").front();
  for (const std::string& method : method_registry().names()) {
    if (method == "none") continue;
    const std::vector<ImageF> both = seen_by({left, right}, method);
    const ImageF left_alone = seen_by({left}, method).front(), right_alone = seen_by({right}, method).front();
    EXPECT_EQ(both[0].pixels, left_alone.pixels) << method << ", left eye";
    EXPECT_EQ(both[1].pixels, right_alone.pixels) << method << ", right eye";
    EXPECT_NE(both[0].pixels, sky_alone.pixels) << method << " reflects nothing";
  }
}

}  // namespace
}  // namespace parvis::rooms
